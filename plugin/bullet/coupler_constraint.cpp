#include "bullet/coupler_constraint.h"

#include <BulletDynamics/ConstraintSolver/btSolverBody.h>

#include "bullet/body_impl.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

CouplerConstraint::CouplerConstraint(DestructibleBody& body, Destruction::Impl& world)
    : btTypedConstraint(MAX_CONSTRAINT_TYPE, body), m_body(body), m_world(world) {
  setDbgDrawSize(0);  // debugDrawConstraint does not know this type
}

void CouplerConstraint::buildJacobian() {
  implOf(m_body).inSolver = true;
  m_world.advance(double(m_world.world.getSolverInfo().m_timeStep));
}

void CouplerConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = 0;
  info->nub = 0;
}

void CouplerConstraint::solveConstraintObsolete(btSolverBody& own, btSolverBody&, btScalar) {
  // Solver bodies stand in one array at their companion ids.
  btSolverBody* base = &own - m_body.getCompanionId();
  for (TouchedBody& touched : m_world.touched) {
    if (touched.given || !touched.rigid || touched.rigid->getCompanionId() < 0) continue;
    btSolverBody& solver = base[touched.rigid->getCompanionId()];
    if (solver.m_originalBody != touched.rigid) continue;
    // What is locked of its motion the substeps have left out.
    solver.internalGetDeltaLinearVelocity() += touched.deltaVelocity;
    solver.internalGetDeltaAngularVelocity() += touched.deltaSpin;
    touched.given = true;
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
