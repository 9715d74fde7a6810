// Links of Bullet's multibodies: how they move, and what an impulse on one moves.
#pragma once

#include <Eigen/Geometry>

#include "edem/rigid_proxy.h"
#include "rubble/abi.h"

class btMultiBodyLinkCollider;

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// What an impulse on the link [N s], and one of rotation about its centre [N m s], change of its velocity
/// and spin: (velocity, spin) per (impulse, rotation), world axes.
using LinkMobility = Eigen::Matrix<double, 6, 6>;
/// Velocity of its centre and spin, or their changes [m/s], [rad/s].
using LinkMotion = Eigen::Matrix<double, 6, 1>;

bool isMoved(const btMultiBodyLinkCollider& link);  ///< by forces: awake, or to be woken by an impulse
LinkMotion motionOf(const btMultiBodyLinkCollider& link);
/// As Bullet has it in this tick, of all the multibody as it hangs together.
LinkMobility mobilityOf(const btMultiBodyLinkCollider& link);
/// The same, of what an impulse on `pushed` changes of `moved`, another link of the multibody.
LinkMobility mobilityOf(const btMultiBodyLinkCollider& pushed, const btMultiBodyLinkCollider& moved);
/// By gravity and the application's forces on all links, which Bullet has in its velocities already when its
/// constraints are solved [m/s^2], [rad/s^2]. 0 while it sleeps.
LinkMotion accelerationOf(const btMultiBodyLinkCollider& link);
/// Makes a link's copy one that moves: from the velocity before this tick's forces, as a part of its
/// multibody. To be called while Bullet solves its constraints, when all of that is in its caches.
void take(const btMultiBodyLinkCollider& link, double dt, edem::RigidProxy& proxy);
/// Gives the link an impulse and one of rotation about its centre, and wakes it.
void push(btMultiBodyLinkCollider& link, const Eigen::Vector3d& impulse, const Eigen::Vector3d& rotation);
/// Moves the multibody as if the link's velocity had been another by what changes its place by `way` (and
/// turns it), for as far as its joints let it.
void shift(btMultiBodyLinkCollider& link, const LinkMotion& way);

RUBBLE_ABI_END
}  // namespace rubble::bullet
