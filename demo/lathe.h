// Solids of revolution.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "rubble/cook.h"

namespace rubble::demo {

/// What turns about the y axis: points of radius (x, 0 or more) and height (y) [m].
using Profile = std::vector<Eigen::Vector2d>;

/// The solid that a profile sweeps when it turns about y, as a prism of `segments` (3 or more) flat strips.
/// The profile goes upwards on its outer side; its two ends, and no other point of it, lie on the axis.
SurfaceMesh latheMesh(const Profile& profile, std::uint32_t segments);

/// The same of a closed profile, counter-clockwise in (radius, height), that does not touch the axis: a ring.
SurfaceMesh ringMesh(const Profile& profile, std::uint32_t segments);

/// Radius 1/2 and height 1 about the origin, its axis along y.
SurfaceMesh unitCylinder(std::uint32_t segments);
/// Diameter 1 about the origin, of half as many bands as segments (which are even, 4 or more).
SurfaceMesh unitSphere(std::uint32_t segments);
/// A ring about y, `outer` m across and `tube` m thick (below half of `outer`), round in both directions.
SurfaceMesh torusMesh(double outer, double tube, std::uint32_t segments);

}  // namespace rubble::demo
