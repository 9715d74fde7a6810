// Rigid bodies that are not free to move in every way: btRigidBody::setLinearFactor, setAngularFactor.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <Eigen/Core>
#include <optional>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// What an impulse on the body at its centre [N s], and one of rotation about it [N m s], change of its
/// velocity and spin, world axes, when a factor is not 1; nothing where all are. Symmetric: the factors act
/// on what turns the body and on how it turns, so that an axis that is locked has no part in either.
std::optional<Eigen::Matrix<double, 6, 6>> lockedMobility(const btRigidBody& body);

RUBBLE_ABI_END
}  // namespace rubble::bullet
