#include "edem/cell_ray.h"

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
  std::optional<CellEntry> first;
  const std::uint32_t end = cells.firstFace[element + 1];
  for (std::uint32_t f = cells.firstFace[element]; f < end; ++f) {
    const CellFaces::Face& face = cells.faces[f];
    for (std::uint32_t k = 0; k < face.triangleCount; ++k) {
      const auto& corners = cells.triangles[face.firstTriangle + k];
      const Eigen::Vector3d a = cells.vertices[corners[0]] - near, b = cells.vertices[corners[1]] - near,
                            c = cells.vertices[corners[2]] - near;
      const Eigen::Vector3d twice = (b - a).cross(c - a);
      const double facing = twice.dot(along);
      if (!(facing < 0)) continue;
      // Twice the areas, seen along the ray, of the triangles that the line makes with each edge.
      const double outside = -kEdge * facing;
      if (a.cross(b).dot(along) > outside || b.cross(c).dot(along) > outside ||
          c.cross(a).dot(along) > outside)
        continue;
      const double t = middle + twice.dot(a) / facing;
      if (t < 0 || t > limit) continue;
      limit = t;
      first = {t, twice.normalized()};
    }
  }
  return first;
}

}  // namespace rubble::edem
