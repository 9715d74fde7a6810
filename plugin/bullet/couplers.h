// Which couplers are in Bullet's world. Bullet looks through all constraints of the world for each island, so
// a whole body has its own there only while something may happen to it that has to be seen before the solver.
#pragma once

#include "rubble/destructible_body.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// No two points of two objects near each other faster [m/s].
struct ClosingSpeed {
  double now = 0;  ///< by the velocities that Bullet has
  double end = 0;  ///< by those that they have at the end of the tick, by forces
};

/// In a tick of `dt` seconds. Of a body of elements by its fastest element.
ClosingSpeed closingSpeed(const DestructibleBody& body, const btCollisionObject& other, double dt);

RUBBLE_ABI_END
}  // namespace rubble::bullet
