// What a tick holds of Bullet's bodies, as data.
#pragma once

#include <LinearMath/btTransform.h>

#include <cstdint>

#include "rubble/abi.h"

class btCollisionObject;
class btRigidBody;
class btMultiBodyLinkCollider;

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// A Bullet object that took part in this tick's substeps.
struct TouchedBody {
  btCollisionObject* object = nullptr;
  btRigidBody* rigid = nullptr;             ///< null unless dynamic
  btMultiBodyLinkCollider* link = nullptr;  ///< null unless that, and its joints let it move
  btVector3 deltaVelocity{0, 0, 0}, deltaSpin{0, 0, 0};
  btVector3 supported{0, 0, 0},
      supportedSpin{0, 0, 0};                  ///< of them, by Bullet's own contacts in the substeps
  bool given = false;                          ///< Bullet's solver has taken it
  bool held = false;                           ///< stood still through the substeps
  btVector3 velocity{0, 0, 0}, spin{0, 0, 0};  ///< before the tick
  btVector3 acceleration{0, 0, 0}, angularAcceleration{0, 0, 0};  ///< by gravity and the application
  /// Where the body would be at the end of the tick under its impulse as a whole.
  btTransform freeEnd = btTransform::getIdentity();
};

/// Where a dynamic body was when the tick was over.
struct LeftPlace {
  const btCollisionObject* body = nullptr;  ///< compared only
  btTransform at;
};

/// What held a body at rest in the last tick: Bullet's contacts and joints, as acceleration.
struct Reaction {
  const btCollisionObject* body = nullptr;  ///< compared only
  btVector3 linear{0, 0, 0}, angular{0, 0, 0};
  /// Of them, what its contacts did within the substeps and will do again.
  btVector3 supported{0, 0, 0}, supportedAngular{0, 0, 0};
  bool rests = true;  ///< else it moves, and anchors ride on it
};

/// Of the fragment with some lowest element.
struct FragmentSize {
  std::uint32_t elements = 0;
  double mass = 0;  ///< [kg]
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
