// An element and a rigid body that touch: the load of their contact. The element acts by the faces of its
// cell, or as a sphere where its body has none.
#pragma once

#include <span>

#include "edem/body.h"
#include "edem/corner_hits.h"
#include "edem/face_touch.h"
#include "edem/resting_loads.h"
#include "edem/rigid_contact.h"

namespace rubble::edem {

/// A rigid body and what its contacts have in common.
struct RigidSide {
  const RigidProxy& proxy;
  RigidState& state;
};

/// What one look at contacts has in common.
struct TouchWork {
  Steps steps;       ///< `moved` is 0 where a contact is looked at again at one instant
  double moved;      ///< the step before that instant all the same [s]
  FaceTouch& faces;  ///< scratch
  RestingLoads& resting;
};

/// An element in the frame of a rigid body.
template <class Real>
ElementPose poseOf(const Body<Real>& body, std::uint32_t element, const RigidProxy& proxy);

/// True where the element has come less far since it was last looked at than it was from the rigid body: it
/// touches nothing, nor do corners of the rigid body touch it.
template <class Real>
bool isApart(const RigidContact& contact, const Body<Real>& body, const RigidProxy& proxy);

/// Leaves the hits of corners of the rigid body in the element in `faces`.
template <class Real>
void findCorners(const Body<Real>& body, const RigidContact& contact, const RigidProxy& proxy,
                 FaceTouch& faces);

/// Brings a contact to the present instant; `corners` are those that press its element. False when it does
/// not touch; `out` has what its springs lost all the same.
template <class Real>
bool touchRigid(RigidContact& contact, const Body<Real>& body, const RigidSide& side,
                std::span<const CornerHit> corners, const TouchWork& work, RigidTouch& out);

}  // namespace rubble::edem
