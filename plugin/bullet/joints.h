// The application's joints to bodies of elements: Bullet solves them, the elements take what they do.
#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <Eigen/Geometry>
#include <vector>

#include "edem/host_load.h"
#include "edem/solver.h"
#include "rubble/destructible_body.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Impulse at a place [N s], and of rotation about it [N m s].
struct JointImpulse {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  /// Of rotation about another place, `arm` from there.
  Eigen::Vector3d about(const Eigen::Vector3d& arm) const { return angular + arm.cross(linear); }
};

/// One side of a joint, of a body of elements.
struct JointEnd {
  DestructibleBody* body = nullptr;    ///< null: something else
  std::uint32_t element = kNoElement;  ///< nearest to where it holds: it holds the fragment of that
  JointImpulse impulse;                ///< of the last tick, where it holds
  JointImpulse steady;                 ///< the same, smoothed: what is borne where it holds
  btTransform place = btTransform::getIdentity();  ///< of the rigid body when Bullet solved it
};

struct HeldJoint {
  btTypedConstraint* joint = nullptr;
  JointEnd ends[2];  ///< its A, its B
  btJointFeedback feedback{};
  bool lent = false;  ///< `feedback` is its feedback for this tick
};

/// Forces that give some elements of a body an impulse in `seconds`, as to one rigid body: `wrench` acts at
/// `at`. Written behind `loads`.
void spread(const edem::Solver& solver, std::uint32_t body, const std::vector<std::uint32_t>& elements,
            const Eigen::Vector3d& at, const JointImpulse& wrench, double seconds,
            std::vector<edem::HostLoad>& loads);

RUBBLE_ABI_END
}  // namespace rubble::bullet
