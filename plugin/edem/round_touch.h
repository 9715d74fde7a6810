// What of solids of revolution meets the faces of a cell. Two convex bodies of which one is flat there touch
// between the ends of a line: of the deepest generator the ends are points of the rims, or where it crosses
// an edge of the face. Standing on a flat end, a rim is a ring of corners.
#pragma once

#include <array>
#include <span>

#include "edem/cell_faces.h"
#include "edem/collider.h"

namespace rubble::edem {

/// Stiffness over k_n of an edge of an exposed face, and of the deepest point of a rim: the two ends of what
/// lies are one contact.
inline constexpr double kEdgeWeight = 0.5, kRimWeight = 0.5;
/// Corners of a rim, which are one contact when all press.
inline constexpr int kRimCorners = 8;

/// A sharp circle of a collider, without its rounding; frame of the rigid body.
struct Rim {
  Eigen::Vector3d centre;  ///< [m]
  Eigen::Vector3d axis;    ///< unit, the same for all rims of a collider
  Eigen::Vector3d across;  ///< unit, to the first corner
  double radius;           ///< [m]
};

/// The rims of a collider: two of a cylinder, one of a cone.
class Rims {
 public:
  explicit Rims(const Collider& part);
  const Rim* begin() const { return m_rims.data(); }
  const Rim* end() const { return m_rims.data() + m_count; }

 private:
  std::array<Rim, 2> m_rims;
  std::size_t m_count = 0;
};

/// Whether points of faces press the collider: spheres and capsules are met by the faces' insides and edges.
inline bool pressesPoints(const Collider& part) {
  return part.kind != Collider::Kind::Sphere && part.kind != Collider::Kind::Capsule;
}

/// Whether it has corners, a tip or rims to press cells with.
inline bool hasCorners(const Collider& part) {
  return pressesPoints(part) && part.kind != Collider::Kind::Plane && part.kind != Collider::Kind::Mesh;
}

/// visit(face, from, to) for every edge of every exposed face of an element; one that two of them share comes
/// twice.
template <class Visit>
void visitEdges(const CellFaces& cells, const Exposure& exposure, std::uint32_t element, Visit&& visit) {
  const std::span<const CellFaces::Face> faces = cells.of(element);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!exposure.faces[cells.firstFace[element] + f]) continue;
    const auto triangles = std::span(cells.triangles).subspan(faces[f].firstTriangle, faces[f].triangleCount);
    // Between two triangles of the face there is no edge.
    const auto isInner = [&](std::uint32_t from, std::uint32_t to) {
      for (const auto& t : triangles)
        for (unsigned c = 0; c < 3; ++c)
          if (t[c] == to && t[(c + 1) % 3] == from) return true;
      return false;
    };
    for (const auto& t : triangles)
      for (unsigned c = 0; c < 3; ++c)
        if (!isInner(t[c], t[(c + 1) % 3])) visit(faces[f], t[c], t[(c + 1) % 3]);
  }
}

}  // namespace rubble::edem
