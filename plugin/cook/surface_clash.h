// Where a closed surface passes through itself, or lies on itself.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "cook/checked_mesh.h"

namespace rubble::cooking {

struct Clash {
  enum class Kind {
    Crossing,  ///< one triangle goes through the other
    Doubled,   ///< both lie in the same place and face the same way
    Touching   ///< both lie in the same place and face each other, or away from each other
  };
  Kind kind;
  std::array<std::uint32_t, 2> triangles;  ///< the smaller first
  Eigen::Vector3d place;                   ///< [m]
};

/// Of the crossings and doublings deeper and wider than `depth` [m], above the rounding of the corners, that
/// with the first triangles. Either leaves places of which it cannot be said whether they are inside; what
/// merely touches does not. Nothing also where so many long triangles lie across each other that the search
/// would take long.
std::optional<Clash> findClash(const CheckedMesh& mesh, double depth);

/// Of all three kinds, the worst kind first.
std::optional<Clash> findContact(const CheckedMesh& mesh, double depth);

}  // namespace rubble::cooking
