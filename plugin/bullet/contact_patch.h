// Where and how one contact presses a whole body: Bullet's up to four points, taken together.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <optional>
#include <vector>

#include "bullet/sections.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// The force of a contact, uniform over the points' polygon shrunk about the centre of pressure until that is
/// its middle, as for the footing of an eccentric load [Meyerhof53]. Bullet's own share of each point is
/// arbitrary; only the sum is in balance.
struct ContactPatch {
  /// Corners of the polygon in their order, ends of a line, or one point [m].
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< centre of pressure [m]
  double area = 0;                                   ///< of the polygon [m^2]
  double halfRim = 0;  ///< half of the length around it: of a line its length [m]
  double press = 0;    ///< sum of the points' normal forces [N]
  Wrench load;         ///< on the body, about the origin

  /// The share of it that acts on what lies beyond a cut.
  Wrench beyond(const Section& cut) const;
};

/// On the body that is the manifold's second (else its first), in the axes of `frame` (in the world); none
/// without a force. Impulses are of a tick of `dt` seconds.
std::optional<ContactPatch> contactPatch(const btPersistentManifold& manifold, bool second,
                                         const Eigen::Isometry3d& frame, double dt);

RUBBLE_ABI_END
}  // namespace rubble::bullet
