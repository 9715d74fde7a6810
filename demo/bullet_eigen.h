// Bullet's vectors as Eigen's floats.
#pragma once

#include <LinearMath/btQuaternion.h>
#include <LinearMath/btVector3.h>

#include <Eigen/Geometry>

namespace rubble::demo {

inline Eigen::Vector3f toEigen(const btVector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline Eigen::Quaternionf toEigen(const btQuaternion& q) {
  return {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
          static_cast<float>(q.z())};
}

}  // namespace rubble::demo
