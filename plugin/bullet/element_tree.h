// Which elements of a body are near a box or a line: Bullet's tree of boxes, one leaf for each living
// element.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <vector>

#include "edem/solver.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Changes in follow() only: any number of threads may ask at once.
class ElementTree {
 public:
  /// Takes the living elements where they are now; to be called whenever they have moved.
  void follow(const edem::Solver& solver, std::uint32_t body);

  /// Elements whose reach may meet a box that is moved from `from` to `to`; `low` and `high` are its corners
  /// about the place that moves. In no order.
  std::vector<std::uint32_t> along(const btVector3& from, const btVector3& to, const btVector3& low,
                                   const btVector3& high) const;
  /// Elements whose reach may meet the box, in rising order.
  std::vector<std::uint32_t> in(const btVector3& low, const btVector3& high) const;

 private:
  btDbvt m_tree;
  std::vector<btDbvtNode*> m_leaves;  // by element; null once it is crushed
  std::vector<std::uint8_t> m_slept;  // those that slept when they were last looked at
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
