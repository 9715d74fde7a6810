// How much of its speed a body may part with after a hit with friction, by energy. Bullet sets the speed
// along the normal by itself; friction at an arm turns the body and pushes it along the normal as well, and
// then the two together can leave more energy than there was (Newton's restitution with Coulomb's friction).
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// The restitution, at most the point's own, at which a hit at this point alone leaves no more energy than it
/// finds [-].
btScalar boundedRestitution(const btPersistentManifold& manifold, const btManifoldPoint& point);

RUBBLE_ABI_END
}  // namespace rubble::bullet
