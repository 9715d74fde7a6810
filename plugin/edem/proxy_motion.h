// How the copies of the host's rigid bodies come into a tick and move through its substeps.
#pragma once

#include <span>
#include <vector>

#include "edem/books.h"
#include "edem/rigid_contact.h"
#include "edem/rigid_proxy.h"

namespace rubble::edem {

/// Gives it an impulse and one of rotation about its centre of mass [N s], [N m s].
void pushProxy(RigidProxy& proxy, const Wrench& impulse);

RigidPose poseOf(const RigidProxy& proxy);
void setPose(RigidProxy& proxy, const RigidPose& pose);
/// Of its surface, beside a drift [m/s].
double speedOf(const RigidProxy& proxy, const Eigen::Vector3d& drift);

/// Makes the proxies of a new tick ready to collect. `states` becomes theirs: what their contacts remember is
/// taken from `before`, that of the last tick, by their keys; not of one that the application has put further
/// away than `leap` [m]. What rounding alone moves, and weighs less than `light` [kg], is where that left it.
void takeProxies(std::span<RigidProxy> proxies, std::span<RigidState> before, double leap, double light,
                 std::vector<RigidState>& states);

/// Moves the proxies (symplectic Euler) by the forces in their states and books what passed between them and
/// the elements.
void moveProxies(std::span<RigidProxy> proxies, std::span<RigidState> states, double kick, double step,
                 Books& books);

}  // namespace rubble::edem
