// Short names for the small vectors of the element code. `Real` is the scalar of the elements' state: float
// or double.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace rubble::edem {

template <class Real>
using Vec3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Mat3 = Eigen::Matrix<Real, 3, 3>;
template <class Real>
using Quat = Eigen::Quaternion<Real, Eigen::DontAlign>;

/// A force and a torque, or what they give in a while.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N], [N s]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N m], [N m s]
};

/// (R - 1) d for the unit quaternion q = (s, e), without subtracting nearly equal numbers: 2 s (e x d) + 2 e
/// x (e x d).
template <class Real>
Vec3<Real> turned(const Quat<Real>& q, const Vec3<Real>& d) {
  const Vec3<Real> e = q.vec();
  const Vec3<Real> ed = e.cross(d);
  return Real(2) * (q.w() * ed + e.cross(ed));
}

}  // namespace rubble::edem
