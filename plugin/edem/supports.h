// What the host's own contacts do to light rigid bodies within a tick: a crate between a slab that falls and
// the ground does not give way to the slab until the host's solver comes to it.
#pragma once

#include <span>

#include "edem/rigid_proxy.h"

namespace rubble::edem {

/// Changes the velocities of the proxies so that none closes in on what its supports hold it by, beyond their
/// gaps, in a step [s]: sequential impulses, with Coulomb's friction. Adds them up in supportImpulse and
/// supportAngularImpulse, and takes the way of the step off the gaps.
void holdProxies(std::span<RigidProxy> proxies, double step);

}  // namespace rubble::edem
