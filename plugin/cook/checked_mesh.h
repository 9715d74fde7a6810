// The solid to cook: a surface mesh that passed every check, with its edges and neighbours.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "rubble/cook.h"

namespace rubble::cooking {

struct CheckedMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< those that a triangle uses
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Eigen::Vector3d> normals;                     ///< unit, one a triangle
  std::vector<std::array<std::uint32_t, 2>> edges;          ///< smaller vertex first
  std::vector<std::array<std::uint32_t, 3>> triangleEdges;  ///< side s runs from corner s to corner s + 1
  std::vector<std::array<std::uint32_t, 3>> neighbours;     ///< the triangle behind side s
  Eigen::AlignedBox3d bounds;
  double volume = 0;  ///< [m^3]

  double diagonal() const { return bounds.diagonal().norm(); }
};

/// Throws rubble::Error: empty, too large, not finite, too far from the origin, index out of range.
void checkNumbers(const SurfaceMesh& mesh);

/// Throws rubble::Error: what checkNumbers throws, a corner twice in a triangle, not closed, not manifold
/// (edges and vertices), not consistently oriented, oriented inwards, without volume.
CheckedMesh checkMesh(const SurfaceMesh& mesh);

}  // namespace rubble::cooking
