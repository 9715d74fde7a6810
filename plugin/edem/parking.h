// A body lent to its host, which moves it as a whole while nothing strikes it. Its elements rest in its
// frame, cost nothing and touch nothing; what the host does to it is the host's exchange.
#pragma once

#include "edem/body.h"
#include "edem/books.h"

namespace rubble::edem {

/// Lends an unbroken body of one fragment to the host, with its motion.
template <class Real>
void park(Body<Real>& body, Books& books);

/// Puts the asset's frame of a parked body at `place`. One that an anchor holds stays where it is.
template <class Real>
void placeParked(Body<Real>& body, const Eigen::Isometry3d& place);

/// Takes the body back, moving as a whole: velocity of the elements' centre of mass [m/s], angular momentum
/// about that [kg m^2/s].
template <class Real>
void unpark(Body<Real>& body, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angularMomentum,
            Books& books);

}  // namespace rubble::edem
