// Packed cubes for the testing machine.
#pragma once

#include <map>

#include "edem/testing_machine.h"
#include "physics/bodies.h"
#include "rubble/cook.h"
#include "support/strict_cook.h"

namespace rubble::test {

inline constexpr double kCubeEdge = 0.3;  // [m]

/// A cube about the origin. Each is cooked once.
inline std::shared_ptr<const Asset> packedCube(std::size_t elements, std::uint64_t seed) {
  static std::map<std::pair<std::size_t, std::uint64_t>, std::shared_ptr<const Asset>> cooked;
  std::shared_ptr<const Asset>& asset = cooked[{elements, seed}];
  if (!asset) {
    CookOptions options;
    options.elements = elements;
    options.seed = seed;
    asset =
        std::make_shared<const Asset>(cookStrictly(boxMesh(Eigen::Vector3d::Constant(kCubeEdge)), options));
  }
  return asset;
}

using edem::Plates;

/// edem::strengthOf such a cube.
inline double strengthOf(const std::shared_ptr<const Asset>& cube, const Material& material, Plates plates,
                         double speed, double strainEnd) {
  return edem::strengthOf({cube, kCubeEdge}, material, plates, speed, strainEnd);
}

}  // namespace rubble::test
