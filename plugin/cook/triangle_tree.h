// Closest points on a triangle mesh, and the side of its surface: a bounding volume tree. Not for two threads
// at once: it counts its work.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

/// The point of the triangle nearest to `place` [Ericson05, 5.1.5].
Eigen::Vector3d closestOnTriangle(const Eigen::Vector3d& place, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Turns into axes along the long edges of the mesh, the last one along the longest, in which the boxes
/// around triangles hold least but them. Large architecture is mostly made so.
Eigen::Matrix3d axesAlongEdges(const CheckedMesh& mesh);

class TriangleTree {
 public:
  /// The mesh must outlive the tree.
  explicit TriangleTree(const CheckedMesh& mesh);

  struct Closest {
    Eigen::Vector3d point;
    std::uint32_t triangle;  ///< kNoElement: none within reach
    double squaredDistance;
  };
  /// Searches as far as `reach` [m]. The distance found may be too long by the factor 1 + `slack`: far from a
  /// finely divided surface, where many triangles are about as near, that shortens the search much.
  Closest closest(const Eigen::Vector3d& place, double reach = std::numeric_limits<double>::infinity(),
                  double slack = 0) const;

  /// Whether the place is inside the solid: parity of the triangles that a ray crosses. Wrong at
  /// most for places on the surface to rounding.
  bool holds(const Eigen::Vector3d& asked) const;

  /// Triangles measured or tried for a crossing since the tree was built.
  std::size_t trianglesTried() const { return m_trianglesTried; }

 private:
  // A triangle or a part of it. Long ones that lie aslant have boxes that hold mostly nothing, so they enter
  // in parts.
  struct Piece {
    Eigen::AlignedBox3d box;
    std::uint32_t triangle;
  };
  struct Node {
    Eigen::AlignedBox3d box;
    // Leaf: triangles [first, first + count). Inner node: count 0, children at this + 1 and `first`.
    std::uint32_t first, count;
  };
  std::vector<Piece> split() const;
  void build(std::vector<Piece>& pieces, std::uint32_t first, std::uint32_t count);
  bool crossesLine(std::uint32_t triangle, double y, double z) const;
  double crossing(std::uint32_t triangle, double y, double z) const;

  const CheckedMesh& m_mesh;
  const Eigen::Matrix3d m_turn;                           // into the tree's axes, in which the boxes are
  std::vector<Eigen::Vector3d> m_vertices;                // turned
  std::vector<std::array<Eigen::Vector3d, 3>> m_corners;  // of each triangle, as in the mesh
  Eigen::AlignedBox3d m_bounds;
  std::vector<std::uint32_t> m_order;  // triangle of each piece
  std::vector<Node> m_nodes;
  mutable std::size_t m_trianglesTried = 0;
};

}  // namespace rubble::cooking
