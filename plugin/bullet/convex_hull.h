// The convex hull of points.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct HullFace {
  Eigen::Vector3d normal;  ///< outwards, a unit vector
  double offset;           ///< normal . x of its plane [m]
  double area;             ///< [m^2]
};

struct ConvexHull {
  std::vector<Eigen::Vector3d> points;  ///< its corners [m]
  std::vector<HullFace> faces;          ///< those that have an area
  double volume = 0;                    ///< [m^3]; 0 of what is flat
};

ConvexHull convexHullOf(std::span<const Eigen::Vector3d> points);

RUBBLE_ABI_END
}  // namespace rubble::bullet
