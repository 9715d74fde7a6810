// A slab with rectangular openings through its thickness: a wall with windows and doors.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rubble/cook.h"

namespace rubble::demo {

/// A rectangle [m] from the slab's lower left corner, seen from +z. One that begins or ends at an edge of the
/// slab is open there, as a door.
struct Opening {
  double left, bottom, width, height;
};

/// What is wrong with the openings, as "openings.1 must ...", or "". Each must lie in the slab, apart from
/// the others and, where it does not end at an edge, from the edges, by a thousandth of the slab; none may
/// cut it in two.
std::string wrongOpening(const Eigen::Vector3d& size, const std::vector<Opening>& openings);

/// About the origin, with the given full edge lengths [m], its thickness along z. `openings` that
/// `wrongOpening` has nothing against.
SurfaceMesh slabMesh(const Eigen::Vector3d& size, const std::vector<Opening>& openings);

}  // namespace rubble::demo
