// The closed surfaces of a soup.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "cook/soup.h"

namespace rubble::cooking {

struct Shell {
  std::vector<std::uint32_t> triangles;
  Eigen::AlignedBox3d bounds;  ///< [m]
  double volume = 0;           ///< [m^3]; inwards below 0
  bool isCrossed = false;      ///< passes through itself; nobody has looked yet
};

struct Shells {
  std::vector<Shell> list;
  std::vector<std::uint32_t> of;  ///< a triangle
};

/// What hangs together by vertices.
Shells findShells(const Soup& soup);

/// Of the tetrahedron from a place to a triangle [m^3].
double volumeAbout(const Soup& soup, std::uint32_t triangle, const Eigen::Vector3d& origin);

/// Of a closed soup [m^3].
double volumeOf(const Soup& soup);

void appendSoup(const Soup& added, Soup& soup);

}  // namespace rubble::cooking
