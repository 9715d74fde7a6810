// Bullet's vectors and ours.
#pragma once

#include <LinearMath/btTransform.h>

#include <Eigen/Geometry>

namespace rubble::bullet {

inline Eigen::Vector3d toEigen(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}
inline Eigen::Quaterniond toEigen(const btQuaternion& q) {
  return {static_cast<double>(q.w()), static_cast<double>(q.x()), static_cast<double>(q.y()),
          static_cast<double>(q.z())};
}
inline Eigen::Isometry3d toEigen(const btTransform& t) {
  return Eigen::Translation3d(toEigen(t.getOrigin())) * toEigen(t.getRotation()).normalized();
}
inline btVector3 toBullet(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
inline btQuaternion toBullet(const Eigen::Quaterniond& q) {
  return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
          static_cast<btScalar>(q.w())};
}

}  // namespace rubble::bullet
