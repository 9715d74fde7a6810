// Places for elements at about equal distances all over a solid, so that its thin parts get theirs.
//
// Random places where a whole sphere has room leave thin parts empty, and places taken by volume alone leave
// them sparse: a leg a quarter of a spacing wide holds an element every sixteen spacings. So candidates come
// from the volume and from the surface, and of them a set is taken in which each is at least so far from
// the others that as many remain as wanted (Poisson disk sampling by throwing darts [Cook86]). No candidate
// is then farther from an element than that distance.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "cook/checked_mesh.h"
#include "cook/room.h"
#include "cook/signed_distance.h"

namespace rubble::cooking {

struct SpreadDef {
  std::size_t count = 0;
  double radius = 0;   ///< the room looked for [m]
  double spacing = 0;  ///< that the elements would have in a solid without thin parts [m]
  std::uint64_t seed = 0;
};

/// Exactly `count` places, each with the room found there. `distance` is fitted to the radius. `progress` is
/// told the share done. Throws rubble::Error where there are not so many: the solid has hardly an inside.
std::vector<Room> spread(const SignedDistance& distance, const CheckedMesh& mesh, const SpreadDef& def,
                         const std::function<void(double)>& progress);

}  // namespace rubble::cooking
