#include "edem/nearest_face.h"

#include <algorithm>

namespace rubble::edem {
namespace {

// Nearest point of a triangle [Ericson05, 5.1.5].
Eigen::Vector3d nearestOnTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

NearestFace::NearestFace(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                         const Eigen::Vector3d& centre, double radius, double slack) {
  const std::span<const CellFaces::Face> faces = cells.of(element);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double beyond = exposure.faces[cells.firstFace[element] + f] ? 0 : slack;
    inside = inside && faces[f].normal.dot(centre) <= faces[f].offset + beyond;
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!exposure.faces[cells.firstFace[element] + f]) continue;
    const CellFaces::Face& face = faces[f];
    const double height = face.normal.dot(centre) - face.offset;
    if (inside) {
      if (-height >= distance) continue;
      distance = -height;
      at = centre - height * face.normal;
      normal = face.normal;
      continue;
    }
    if (height <= 0 || height >= std::min(radius, distance)) continue;
    for (std::uint32_t t = 0; t < face.triangleCount; ++t) {
      const auto& corners = cells.triangles[face.firstTriangle + t];
      const Eigen::Vector3d q = nearestOnTriangle(cells.vertices[corners[0]], cells.vertices[corners[1]],
                                                  cells.vertices[corners[2]], centre);
      const double away = (q - centre).norm();
      if (away >= distance) continue;
      distance = away;
      at = q;
      normal = face.normal;
    }
  }
}

}  // namespace rubble::edem
