#include "edem/cell_ray.h"

#include <vector>

namespace rubble::edem {
namespace {

// A triangle is this share of itself wider than its edges: rounding must not let a ray pass between two that
// share one, in one cell or, a turn and a shift apart, in two. Doubles err by 1e-12 some kilometres away.
constexpr double kEdge = 1e-9;

}  // namespace

std::optional<CellEntry> firstEntry(const CellFaces& cells, std::uint32_t element,
                                    const Eigen::Vector3d& from, const Eigen::Vector3d& along, double limit) {
  // From where it is nearest to the centre, so that a far start costs no digits.
  const double middle = -from.dot(along) / along.squaredNorm();
  const Eigen::Vector3d near = from + middle * along;
  const double reach = cells.reach[element];
  if (near.squaredNorm() > reach * reach * (1 + kEdge)) return std::nullopt;
  // The vertices as the ray sees them: beside it, and along it in its own lengths.
  const Eigen::Vector3d ahead = along / along.squaredNorm();
  const Eigen::Vector3d right = along.unitOrthogonal(), up = along.normalized().cross(right);
  const std::uint32_t begin = cells.firstVertex[element];
  std::vector<Eigen::Vector3d> seen(cells.firstVertex[element + 1] - begin);
  for (std::uint32_t v = 0; v < seen.size(); ++v) {
    const Eigen::Vector3d at = cells.vertices[begin + v] - near;
    seen[v] = {at.dot(right), at.dot(up), at.dot(ahead)};
  }
  // Twice the area that the line makes with an edge; of a triangle that faces the ray all three are below 0.
  const auto area = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return p.x() * q.y() - q.x() * p.y();
  };
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t hit = kNone;
  const std::uint32_t last = cells.firstFace[element + 1] - 1;
  const std::uint32_t end = cells.faces[last].firstTriangle + cells.faces[last].triangleCount;
  for (std::uint32_t k = cells.faces[cells.firstFace[element]].firstTriangle; k < end; ++k) {
    const auto& corners = cells.triangles[k];
    const Eigen::Vector3d &a = seen[corners[0] - begin], &b = seen[corners[1] - begin],
                          &c = seen[corners[2] - begin];
    const double ab = area(a, b), bc = area(b, c), ca = area(c, a), facing = ab + bc + ca;
    const double outside = -kEdge * facing;
    if (!(facing < 0) || ab > outside || bc > outside || ca > outside) continue;
    const double t = middle + (bc * a.z() + ca * b.z() + ab * c.z()) / facing;
    if (t < 0 || t > limit) continue;
    limit = t;
    hit = k;
  }
  if (hit == kNone) return std::nullopt;
  const auto& corners = cells.triangles[hit];
  const Eigen::Vector3d& a = cells.vertices[corners[0]];
  return CellEntry{limit,
                   (cells.vertices[corners[1]] - a).cross(cells.vertices[corners[2]] - a).normalized()};
}

}  // namespace rubble::edem
