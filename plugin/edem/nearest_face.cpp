#include "edem/nearest_face.h"

#include <algorithm>

#include "edem/triangle.h"

namespace rubble::edem {
namespace {

// Least cosine between two sides that look the same way.
constexpr double kAlike = 0.99;

}  // namespace

NearestFace::NearestFace(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                         const Eigen::Vector3d& centre, double radius, std::span<const Eigen::Vector3d> sides,
                         double flush) {
  const auto isAlike = [&](const CellFaces::Face& face) {
    return std::any_of(sides.begin(), sides.end(),
                       [&](const Eigen::Vector3d& side) { return side.dot(face.normal) > kAlike; });
  };
  const std::span<const CellFaces::Face> faces = cells.of(element);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double above = faces[f].normal.dot(centre) - faces[f].offset;
    if (exposure.faces[cells.firstFace[element] + f])
      inside = inside && (above <= 0 || (above <= flush && isAlike(faces[f])));
    else
      beyond = std::max(beyond, above);
    if (!inside && !(radius > 0)) return;  // a point sees no face from outside
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!exposure.faces[cells.firstFace[element] + f]) continue;
    const CellFaces::Face& face = faces[f];
    const double height = face.normal.dot(centre) - face.offset;
    if (inside) {
      if (-height >= distance || isAlike(face)) continue;
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
