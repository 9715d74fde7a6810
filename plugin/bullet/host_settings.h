// What an application may set of a rigid body, and its elements put aside while they move it.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <optional>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Gravity that stands in a body whose gravity Rubble sees to, or nothing: minus zero, as nobody else gives
/// it.
inline btVector3 noGravity() {
  return {btScalar(-0.0), btScalar(-0.0), btScalar(-0.0)};
}
/// What the application gave the body in place of the world's [m/s^2]: by `setGravity`, zero included.
std::optional<btVector3> ownGravity(const btRigidBody& body, const btVector3& world);

struct HostSettings {
  btVector3 linearFactor{1, 1, 1}, angularFactor{1, 1, 1};
  btVector3 gravity = noGravity();      ///< its own [m/s^2]
  int flags = 0;                        ///< btRigidBodyFlags
  btScalar threshold = BT_LARGE_FLOAT;  ///< distance up to which its contacts count [m]
  bool staysAwake = false;
};

/// `world`: its gravity [m/s^2].
HostSettings settingsOf(const btRigidBody& body, const btVector3& world);
/// Gives them back, but the gravity, which may have been set since: the body's own, or the world's unless
/// that is switched off for it.
void restore(btRigidBody& body, const HostSettings& settings, const btVector3& world);

RUBBLE_ABI_END
}  // namespace rubble::bullet
