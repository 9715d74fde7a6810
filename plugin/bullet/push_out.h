// How fast Bullet's solver pushes whole bodies out of what they are in. It gives them the depth's share `erp`
// of a tick as velocity, in each tick and on top of restitution: what came in during a long tick leaves
// faster than it came in a short one, and what bounces fully leaves faster than it came.
#pragma once

#include <vector>

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

class PushOut {
 public:
  /// Before Bullet solves the contacts of a tick: at points of whole bodies it pushes no faster than it would
  /// have in the long ticks before, and not where restitution parts them as fast. What it lifts out by place
  /// alone bounces by so much less, and what friction would throw up as well (bounce.h).
  void limit(btDynamicsWorld& world, double dt);
  /// Whether a tick of `dt` seconds comes after a longer one, from which something may still overlap.
  bool isAfterLonger(const btContactSolverInfo& info, double dt) const { return longest(info, dt) > dt; }
  /// At the end of each tick.
  void note(const btContactSolverInfo& info, double dt);
  /// Once Bullet has solved them: the points are as Bullet made them.
  void restore(btDispatcher& dispatcher);

 private:
  double longest(const btContactSolverInfo& info, double dt) const;
  double m_longest = 0;  // tick that what still overlaps may have come in [s]
  struct Limited {
    const btManifoldPoint* point;  // compared only
    btScalar restitution, erp;     // that Bullet gave it
    int flags;
  };
  std::vector<Limited> m_limited;  // by point
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
