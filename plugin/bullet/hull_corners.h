// Convex hulls of few corners.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "bullet/convex_hull.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Unit vectors, evenly over the sphere, along no axis (3 x count).
Eigen::Matrix3Xd directionsAround(int count);

/// The hull of at most `most` of the points, those by which it becomes largest; of all where so many are
/// enough.
ConvexHull hullOfFew(std::span<const Eigen::Vector3d> points, std::size_t most);

RUBBLE_ABI_END
}  // namespace rubble::bullet
