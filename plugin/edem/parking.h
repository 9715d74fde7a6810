// A body lent to its host, which moves it as a whole while nothing strikes it. Its elements rest in its
// frame, cost nothing and touch nothing; what the host does to it is the host's exchange.
#pragma once

#include "edem/body.h"
#include "edem/books.h"

namespace rubble::edem {

/// How a body is lent: where its asset's frame is, velocity of its centre of mass [m/s], angular momentum
/// about that [kg m^2/s].
struct ParkedMotion {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angularMomentum = Eigen::Vector3d::Zero();
};

/// One that is awake, has all its elements, in one fragment, and all its anchors; it may have cracks.
template <class Real>
bool mayPark(const Body<Real>& body);

/// Lends a body that may be parked to the host, with its momenta. Its elements go to their rest shape
/// about the frame that follows them, what an anchor holds to the shape in which it was first parked, or
/// stays in its own once it has cracks; the energy that only elements have is booked as damped. Springs that
/// are broken stay so, and their pairs touch in that shape without force.
template <class Real>
ParkedMotion park(Body<Real>& body, Books& books);

/// Puts the asset's frame of a parked body at `place`. One that an anchor holds stays where it is.
template <class Real>
void placeParked(Body<Real>& body, const Eigen::Isometry3d& place);

/// Takes the body back, moving as a whole: velocity of the elements' centre of mass [m/s], angular momentum
/// about that [kg m^2/s].
template <class Real>
void unpark(Body<Real>& body, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angularMomentum,
            Books& books);

}  // namespace rubble::edem
