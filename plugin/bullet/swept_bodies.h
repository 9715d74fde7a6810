// Bullet objects that a destructible body does not reach when a tick begins, but may within it: a blow in the
// tick throws elements further than their bounds foresaw.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "rubble/abi.h"
#include "rubble/destructible_body.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Whether groups, masks, filters and ignore lists let a destructible body touch an object of its world.
bool mayTouch(btCollisionWorld& world, DestructibleBody& body, btCollisionObject& object);

/// Boxes that hold all that the elements of bodies which are awake may reach in the coming tick of `dt`
/// seconds; none of them meets another.
std::vector<Eigen::AlignedBox3d> reachedBoxes(std::span<DestructibleBody* const> bodies, double dt);

/// Adds to what each body that is awake has `near` the objects that its elements may reach in the coming tick
/// of `dt` seconds, by rising number in the broadphase. Groups, masks, filters and ignore lists hold. Looks
/// at nothing while nothing near is fast enough to throw an element out of its body's bounds.
void addSwept(btCollisionWorld& world, std::span<DestructibleBody* const> bodies, double dt);

RUBBLE_ABI_END
}  // namespace rubble::bullet
