// Elements that are held still for the rest of a tick, because no allowed substep would be stable for them.
#pragma once

#include "edem/world.h"

namespace rubble::edem {

/// Freezes elements, those first that need the shortest substep, until one of `shortest` [s] is stable, with
/// `safety` of it used. They stand still until the tick ends, as if the world held them: what pushes them
/// finds them rigid, their springs and contacts keep their energy, and the motion that they had is booked as
/// taken (Books::slept). False, and none of these is frozen, when more than a quarter of the elements that
/// are awake would have to be.
template <class Real>
bool freezeElements(World<Real>& w, double shortest);

/// All may move again: those that still must not are frozen anew.
template <class Real>
void thawElements(World<Real>& w);

/// Takes the velocity that an element has been given in this substep, with what it had before, and books it.
template <class Real>
void stop(Body<Real>& body, std::uint32_t element, const Vec3<Real>& velocityBefore,
          const Vec3<Real>& spinBefore, Books& books);

}  // namespace rubble::edem
