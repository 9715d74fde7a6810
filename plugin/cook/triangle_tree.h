// Closest points on a triangle mesh: a bounding volume tree.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

/// The point of the triangle nearest to `place` [Ericson05, 5.1.5].
Eigen::Vector3d closestOnTriangle(const Eigen::Vector3d& place, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

class TriangleTree {
 public:
  /// The mesh must outlive the tree.
  explicit TriangleTree(const CheckedMesh& mesh);

  struct Closest {
    Eigen::Vector3d point;
    std::uint32_t triangle;
    double squaredDistance;
  };
  /// `hint` is a triangle that may be near; a good one makes the search short.
  Closest closest(const Eigen::Vector3d& place, std::uint32_t hint = 0) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    // Leaf: triangles [first, first + count). Inner node: count 0, children at this + 1 and `first`.
    std::uint32_t first, count;
  };
  void build(std::uint32_t first, std::uint32_t count);

  const CheckedMesh& m_mesh;
  std::vector<std::uint32_t> m_order;  // triangles
  std::vector<Node> m_nodes;
};

}  // namespace rubble::cooking
