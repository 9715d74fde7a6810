// How fast contacts with rigid bodies are: what bounds the substep.
#pragma once

#include <span>

#include "edem/body.h"
#include "edem/face_touch.h"
#include "edem/rigid_contact.h"

namespace rubble::edem {

/// Takes the weights of what of an element may touch at once: every point of its exposed faces that looks at
/// the surface, the balls that are near, and its core. Faces that turn towards the surface count from the
/// next tick. `faces` is scratch.
template <class Real>
void weighFaces(RigidContact& contact, const Body<Real>& body, const RigidProxy& proxy, FaceTouch& faces);

/// Rates of the element in a contact; frequency2 is that of the contact alone [1/s^2].
template <class Real>
ElementRates ratesOf(const RigidContact& contact, const Body<Real>& body, const ContactLaw<double>& law,
                     double& frequency2);

/// Adds a contact to what the rigid body's rates are taken from.
template <class Real>
void addMobility(RigidContact& contact, const Body<Real>& body, const RigidProxy& proxy, RigidState& state);

/// Adds the edges of all contacts: each of their points presses one element, whichever it is near.
void addEdges(const RigidProxy& proxy, RigidState& state);

/// The laws of contacts with a rigid body, by the sides of the bodies, and its rates: of `share` of the
/// stiffness that the bodies ask for. Contacts of a light one are softer, so that none of its rates passes a
/// multiple of `frequency2`, that of the elements [1/s^2].
void setLaws(std::span<const ContactSide> sides, const RigidProxy& proxy, double frequency2, double share,
             RigidState& state);

}  // namespace rubble::edem
