// Where Bullet's joints of each kind keep the place at which they hold a body.
#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <Eigen/Core>
#include <optional>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// In the frame of the joint's body A, or of its B; none for kinds that hold no place (gears, other
/// people's).
std::optional<btTransform> frameOf(const btTypedConstraint& joint, bool ofA);
/// Where it holds that body, in its frame [m]; the origin for those.
Eigen::Vector3d pivotOf(const btTypedConstraint& joint, bool ofA);
/// Does nothing for those.
void setFrameOf(btTypedConstraint& joint, bool ofA, const btTransform& frame);

RUBBLE_ABI_END
}  // namespace rubble::bullet
