// What an application may set of a rigid body, and its elements put aside while they move it.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct HostSettings {
  btVector3 linearFactor{1, 1, 1}, angularFactor{1, 1, 1};
  btVector3 gravity{0, 0, 0};           ///< its own, where the world's is switched off [m/s^2]
  int flags = 0;                        ///< btRigidBodyFlags
  btScalar threshold = BT_LARGE_FLOAT;  ///< distance up to which its contacts count [m]
  bool staysAwake = false;
};

HostSettings settingsOf(const btRigidBody& body);
/// Gives them back, with the world's gravity [m/s^2] unless that is switched off for the body.
void restore(btRigidBody& body, const HostSettings& settings, const btVector3& gravity);

RUBBLE_ABI_END
}  // namespace rubble::bullet
