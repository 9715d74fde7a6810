// Signed distances of solids of revolution about y, in closed form.
#pragma once

#include "edem/collider.h"

namespace rubble::edem {

/// All points within `radius` of the segment from -half to half on y [m].
SurfacePoint nearestOnCapsule(double radius, double half, const Eigen::Vector3d& p);
/// From -half to half along y [m].
SurfacePoint nearestOnCylinder(double radius, double half, const Eigen::Vector3d& p);
/// Its base of `radius` at y = -half, its apex at half [m].
SurfacePoint nearestOnCone(double radius, double half, const Eigen::Vector3d& p);

}  // namespace rubble::edem
