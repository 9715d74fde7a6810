// The frames of a body: one for each fragment that no anchor holds, and frame 0 for the rest (see body.h).
#pragma once

#include "edem/body.h"

namespace rubble::edem {

/// Writes `rest`, and the rest vectors of unbroken springs, of the frames from `first` on.
template <class Real>
void turnRest(Body<Real>& body, std::size_t first);

/// Gives each fragment, as labelled, a frame of its own: a copy of the one it had. An anchored fragment stays
/// in frame 0, and crushed elements go there. Nothing moves; displacements and rotations of the living stay
/// the same bits.
template <class Real>
void splitFrames(Body<Real>& body);

/// Moves each frame but frame 0 to the best rigid motion of its elements (mean rotation, mean position;
/// mass-weighted) and expresses their displacements and rotations in it. Positions, velocities and energies
/// stay what they are, to the rounding of displacements in their scalar.
template <class Real>
void fitFrames(Body<Real>& body);

/// Moves frame 0 to where the base of the anchors is, and expresses what it holds in it, likewise.
template <class Real>
void followBase(Body<Real>& body);

/// Puts frame 0 elsewhere, with all that it holds and with the base; velocities stay.
template <class Real>
void moveFrame0(Body<Real>& body, const Frame& to);

/// Writes what springs take of the base's motion.
template <class Real>
void writeFarEnds(Body<Real>& body);

}  // namespace rubble::edem
