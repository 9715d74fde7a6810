#include "bullet/joint_frames.h"

#include <BulletDynamics/ConstraintSolver/btConeTwistConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/ConstraintSolver/btHingeConstraint.h>
#include <BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h>
#include <BulletDynamics/ConstraintSolver/btSliderConstraint.h>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// The kinds have no interface in common, but nearly all the same functions.
template <class Joint, class Visit>
auto as(const btTypedConstraint& joint, Visit&& visit) {
  return visit(static_cast<const Joint&>(joint));
}

}  // namespace

std::optional<btTransform> frameOf(const btTypedConstraint& joint, bool ofA) {
  const auto offset = [&](const auto& j) -> btTransform {
    return ofA ? j.getFrameOffsetA() : j.getFrameOffsetB();
  };
  switch (joint.getConstraintType()) {
    case POINT2POINT_CONSTRAINT_TYPE:
      return as<btPoint2PointConstraint>(joint, [&](const auto& j) {
        return btTransform(btQuaternion::getIdentity(), ofA ? j.getPivotInA() : j.getPivotInB());
      });
    case HINGE_CONSTRAINT_TYPE:
      return as<btHingeConstraint>(
          joint, [&](const auto& j) -> btTransform { return ofA ? j.getAFrame() : j.getBFrame(); });
    case CONETWIST_CONSTRAINT_TYPE:
      return as<btConeTwistConstraint>(joint, offset);
    case SLIDER_CONSTRAINT_TYPE:
      return as<btSliderConstraint>(joint, offset);
    case D6_CONSTRAINT_TYPE:
    case D6_SPRING_CONSTRAINT_TYPE:
      return as<btGeneric6DofConstraint>(joint, offset);
    case D6_SPRING_2_CONSTRAINT_TYPE:
    case FIXED_CONSTRAINT_TYPE:
      return as<btGeneric6DofSpring2Constraint>(joint, offset);
    default:
      return std::nullopt;
  }
}

Eigen::Vector3d pivotOf(const btTypedConstraint& joint, bool ofA) {
  const auto frame = frameOf(joint, ofA);
  return frame ? toEigen(frame->getOrigin()) : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

void setFrameOf(btTypedConstraint& joint, bool ofA, const btTransform& frame) {
  const auto set = [&](auto& j) {
    const btTransform a = j.getFrameOffsetA(), b = j.getFrameOffsetB();
    j.setFrames(ofA ? frame : a, ofA ? b : frame);
  };
  switch (joint.getConstraintType()) {
    case POINT2POINT_CONSTRAINT_TYPE: {
      auto& point = static_cast<btPoint2PointConstraint&>(joint);
      return ofA ? point.setPivotA(frame.getOrigin()) : point.setPivotB(frame.getOrigin());
    }
    case HINGE_CONSTRAINT_TYPE:
      return set(static_cast<btHingeConstraint&>(joint));
    case CONETWIST_CONSTRAINT_TYPE:
      return set(static_cast<btConeTwistConstraint&>(joint));
    case SLIDER_CONSTRAINT_TYPE:
      return set(static_cast<btSliderConstraint&>(joint));
    case D6_CONSTRAINT_TYPE:
    case D6_SPRING_CONSTRAINT_TYPE:
      return set(static_cast<btGeneric6DofConstraint&>(joint));
    case D6_SPRING_2_CONSTRAINT_TYPE:
    case FIXED_CONSTRAINT_TYPE:
      return set(static_cast<btGeneric6DofSpring2Constraint&>(joint));
    default:
      return;
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
