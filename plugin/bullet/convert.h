// Bullet's vectors and ours.
#pragma once

#include <LinearMath/btTransform.h>

#include <Eigen/Geometry>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

inline Eigen::Vector3d toEigen(const btVector3& v) {
  return {double(v.x()), double(v.y()), double(v.z())};
}
inline Eigen::Quaterniond toEigen(const btQuaternion& q) {
  return {double(q.w()), double(q.x()), double(q.y()), double(q.z())};
}
inline Eigen::Isometry3d toEigen(const btTransform& t) {
  return Eigen::Translation3d(toEigen(t.getOrigin())) * toEigen(t.getRotation()).normalized();
}
inline btVector3 toBullet(const Eigen::Vector3d& v) {
  return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())};
}
inline btQuaternion toBullet(const Eigen::Quaterniond& q) {
  return {btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())};
}
inline btTransform toBullet(const Eigen::Isometry3d& t) {
  return btTransform(toBullet(Eigen::Quaterniond(t.linear())), toBullet(Eigen::Vector3d(t.translation())));
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
