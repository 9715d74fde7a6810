// What the host does to a body of elements as one, between ticks: booked as the host's.
#pragma once

#include "edem/body.h"
#include "edem/books.h"

namespace rubble::edem {

/// Adds a rigid motion about the centre of mass of what is alive, or of the fragment `root` [m/s], [rad/s].
template <class Real>
void pushWhole(Body<Real>& body, std::uint32_t root, const Eigen::Vector3d& velocity,
               const Eigen::Vector3d& spin, Books& books);

/// Adds the host's loads to the forces of a substep; sleeping elements take none.
template <class Real>
void addHostLoads(Body<Real>& body, double kick, Books& books);
/// Their work after it.
template <class Real>
void bookHostLoads(const Body<Real>& body, double kick, Books& books);

/// Moves a body and its anchors, velocities turned with it; with its frames, so that no displacement changes
/// where nothing is turned.
template <class Real>
void moveWhole(Body<Real>& body, const Eigen::Isometry3d& by, Books& books);

/// Moves frame 0 with what it holds, whose velocities stay as they are.
template <class Real>
void moveHeld(Body<Real>& body, const Frame& to, Books& books);

}  // namespace rubble::edem
