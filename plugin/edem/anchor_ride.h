// Anchors that ride on a dynamic body of the host's: on its copy in the substeps. They push it as its
// contacts do, and their far ends are where it is. Between two ticks the host moves that body by its own
// contacts and joints; what the anchors hold is put where it goes with it, so that no spring is stretched by
// that, and has the change of its velocity as a blow.
#pragma once

#include <memory>
#include <span>

#include "edem/rigid_contacts.h"
#include "edem/rigid_motion.h"

namespace rubble::edem {

template <class Real>
bool isRiding(const Body<Real>& body) {
  return body.state.base.ride.on() && !body.state.asleep;
}

/// Begins a tick on the copy that the host named; false where none is, and the base goes its way.
template <class Real>
bool beginRide(Body<Real>& body, std::span<const RigidProxy> proxies);

/// Gives the copy what the anchors do to it in this substep.
template <class Real>
void pullRide(Body<Real>& body, double kick, RigidContacts<Real>& rigid, Books& books);

/// Puts the far ends where the copy has gone.
template <class Real>
void goWithRide(Body<Real>& body, std::span<const RigidProxy> proxies);

/// After the substeps and damping: gives the copy what that took of the elements.
template <class Real>
void endRide(Body<Real>& body, RigidContacts<Real>& rigid, Books& books);

/// What the anchors are as fast as, by the copy's mass and inertia; as ElementRates of an element.
template <class Real>
ElementRates rideRates(const Body<Real>& body, const RigidProxy& proxy);

/// Motion of a fragment and of what it rides on as one.
RigidMotion withBase(const RigidMotion& fragment, const AnchorBase& base);

}  // namespace rubble::edem
