// What of a body of elements Bullet sees, as one rigid body.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>

#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct Shown {
  std::uint32_t fragment = kNoElement;  ///< its lowest element; kNoElement: all that is alive
  std::uint32_t turning = kNoElement;   ///< the fragment whose rotation it has: the heaviest
  /// Bullet's frame in the asset's, as far as that follows what is seen.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  bool anchored = false;  ///< an anchor holds some of it
  /// Springs broken, elements crushed and given away when the fragments were last looked at; none: never.
  std::optional<std::array<std::uint32_t, 3>> damage;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
