// Fragments that lie still fall asleep, each with all that it touches: an island. Nothing of it is stepped
// until something comes at it; it holds up what lies on it all the same, for that is in the island or wakes
// it.
//
// A whole body that sleeps (Body::asleep) is its host's decision; this is the solver's own.
#pragma once

#include "edem/world.h"

namespace rubble::edem {

/// Lets fragments come to rest that have been slower than def.settleSpeed for def.settleTime: their
/// deformation is damped at def.settleRate, or at Body::massDamping, which all have, if that is more. What
/// is as slow under gravity for so long is borne by something: unless that moves, or it only ever gets
/// faster, it is braked as a whole, too. At the end of a tick of `dt` seconds.
template <class Real>
void settle(World<Real>& world, double dt);

/// Puts to sleep what has been slower than def.sleepSpeed for def.sleepTime and touches nothing that moves.
/// At the end of a tick of `dt` seconds; what motion is left is booked as slept.
template <class Real>
void putToSleep(World<Real>& world, double dt);

/// Wakes what a rigid body has come near that is not where it was, and what lay on one that is gone. With
/// lists of pairs that are new, before those of rigid bodies.
template <class Real>
void wakeDisturbed(World<Real>& world);

/// Wakes what something awake touches now; true if anything. The lists are stale then.
template <class Real>
bool wakeTouched(World<Real>& world);

/// Wakes an element's island. The lists are stale then.
template <class Real>
void wakeElement(World<Real>& world, std::uint32_t body, std::uint32_t element);

/// Wakes what touches the body at this place.
template <class Real>
void wakeNeighbours(World<Real>& world, std::uint32_t body);

/// All elements of all bodies.
template <class Real>
void wakeAll(World<Real>& world);

/// The body's elements count as awake: its host takes it over, or wakes it.
template <class Real>
void forgetSleep(Body<Real>& body);

}  // namespace rubble::edem
