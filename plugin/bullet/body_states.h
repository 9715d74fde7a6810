// What Bullet sees of a destructible body in each of its states.
#pragma once

#include "bullet/body_impl.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Bullet does not move it: shape and motion are the elements'.
void beElements(DestructibleBody& body);
/// Of the same: its place and motion as one.
void showInBullet(DestructibleBody& body, const btTransform& at, const btVector3& velocity,
                  const btVector3& spin);
/// A rigid body as any other, of the shape in DestructibleBody::Impl::whole.
void beRigid(DestructibleBody& body, const btTransform& at);
/// The same of a new body. One that anchors hold is dynamic still, without a degree of freedom: Bullet puts
/// it into the islands of what touches it, in whose ticks we look for blows.
void beNewRigid(DestructibleBody& body, const btTransform& at);
/// Takes Bullet's gyroscopic term from a whole body that turns by more than half a turn in a tick of `dt`
/// seconds, for that is one Newton step over the tick (a cylinder at 32 rad a tick got 180 times its energy),
/// and gives it back when it is slower; 0: in any case. Until then the body keeps its spin instead of its
/// momentum.
void limitGyroscopicTerm(DestructibleBody& body, double dt);

RUBBLE_ABI_END
}  // namespace rubble::bullet
