// A plane polygon without holes into triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace rubble::cooking {

struct FlatPoint {
  Eigen::Vector2d place;
  std::uint32_t id;
};
/// Counter-clockwise; bridges to holes repeat corners.
using FlatLoop = std::vector<FlatPoint>;

/// Twice the signed area; positive where a, b, c turn left.
inline double turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  const Eigen::Vector2d u = b.place - a.place;
  const Eigen::Vector2d v = c.place - a.place;
  return u.x() * v.y() - u.y() * v.x();
}

/// Appends triangles of ids that fill the loop and use each of its edges once, whatever its shape. Returns
/// how often a corner was compared with a possible triangle.
std::size_t clipEars(const FlatLoop& loop, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace rubble::cooking
