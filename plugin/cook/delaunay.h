// A door to CGAL: points in, tetrahedra out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rubble::cooking {

struct Tetrahedra {
  /// Point indices; (p1 - p0) x (p2 - p0) . (p3 - p0) > 0.
  std::vector<std::array<std::uint32_t, 4>> points;
  /// The tetrahedron behind the facet opposite to point k, or kNoElement outside the convex hull.
  std::vector<std::array<std::uint32_t, 4>> neighbours;
};

/// Delaunay tetrahedra of the points. Their order is not part of the promise: it may change with CGAL's
/// version.
Tetrahedra delaunay(std::span<const Eigen::Vector3d> points);

}  // namespace rubble::cooking
