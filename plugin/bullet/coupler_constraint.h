// The place in Bullet's solver where the substeps run: before contact rows, once a tick, so that a stack on a
// destructible body feels its support in the same tick. It has no rows of its own.
#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include "rubble/destruction.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

class CouplerConstraint : public btTypedConstraint {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  CouplerConstraint(DestructibleBody& body, Destruction::Impl& world);

  /// The first coupler that Bullet calls in a tick advances all destructible bodies.
  void buildJacobian() override;
  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2*) override {}
  /// First iteration only: gives the touched rigid bodies their impulses.
  void solveConstraintObsolete(btSolverBody& own, btSolverBody& fixed, btScalar dt) override;
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  DestructibleBody& m_body;
  Destruction::Impl& m_world;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
