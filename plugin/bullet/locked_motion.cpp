#include "bullet/locked_motion.h"

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

std::optional<Eigen::Matrix<double, 6, 6>> lockedMobility(const btRigidBody& body) {
  const Eigen::Vector3d linear = toEigen(body.getLinearFactor()), angular = toEigen(body.getAngularFactor());
  if (linear == Eigen::Vector3d::Ones() && angular == Eigen::Vector3d::Ones()) return {};
  Eigen::Matrix3d turns;
  for (int row = 0; row < 3; ++row) turns.row(row) = toEigen(body.getInvInertiaTensorWorld()[row]);
  Eigen::Matrix<double, 6, 6> mobility = Eigen::Matrix<double, 6, 6>::Zero();
  mobility.topLeftCorner<3, 3>() = double(body.getInvMass()) * linear.asDiagonal();
  mobility.bottomRightCorner<3, 3>() = angular.asDiagonal() * turns * angular.asDiagonal();
  return mobility;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
