// Bullet's vectors as Eigen's floats.
#pragma once

#include <LinearMath/btQuaternion.h>
#include <LinearMath/btVector3.h>

#include <Eigen/Geometry>

namespace rubble::demo {

inline Eigen::Vector3f toEigen(const btVector3& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}
inline Eigen::Quaternionf toEigen(const btQuaternion& q) {
  return {float(q.w()), float(q.x()), float(q.y()), float(q.z())};
}

}  // namespace rubble::demo
