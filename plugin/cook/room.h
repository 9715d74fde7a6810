// Where a sphere finds room near a place of the solid.
#pragma once

#include <Eigen/Core>

#include "cook/signed_distance.h"

namespace rubble::cooking {

struct Room {
  Eigen::Vector3d place;
  double depth;  ///< below the surface [m], at most the radius asked for
};

/// Climbs from a place in the solid, away from the surface, until a sphere of this radius [m] fits; in
/// a wall thinner than that, to its middle. Never leaves the connected part of the solid.
/// `outOfCorners`: also where three sides meet sharply, in which a sphere would stay as it is.
Room findRoomNear(const SignedDistance& distance, const Eigen::Vector3d& start, double radius,
                  bool outOfCorners = false);

}  // namespace rubble::cooking
