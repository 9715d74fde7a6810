// Random places all over a surface.
#pragma once

#include <vector>

#include "cook/checked_mesh.h"
#include "cook/random.h"

namespace rubble::cooking {

struct SurfacePlace {
  Eigen::Vector3d place;   ///< [m]
  std::uint32_t triangle;  ///< of the mesh
};

double surfaceArea(const CheckedMesh& mesh);  ///< [m^2]

/// One place in each of `count` equal shares of the surface.
std::vector<SurfacePlace> sampleSurface(const CheckedMesh& mesh, std::size_t count, Random& random);

}  // namespace rubble::cooking
