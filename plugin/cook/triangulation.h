// Plane polygons with holes into triangles, without new vertices.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rubble::cooking {

/// Vertex indices, counter-clockwise seen against the normal; holes clockwise.
using Loop = std::vector<std::uint32_t>;

/// Appends triangles that fill the loops. Uses every directed edge of the loops exactly once whatever their
/// shape: a crooked sliver gives crooked triangles, never a gap. Ear clipping; holes are joined to the rim by
/// bridges first.
void triangulate(std::span<const Loop> loops, const std::vector<Eigen::Vector3d>& positions,
                 const Eigen::Vector3d& normal, std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The same for one convex loop.
void triangulateFan(const Loop& loop, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace rubble::cooking
