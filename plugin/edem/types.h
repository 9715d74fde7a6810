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

// By scalars, with the same bits as Eigen's: that works on pairs of doubles, and loads in pairs what has just
// been stored one by one, which waits for the store. For loops that every substep runs.

/// a . b
inline double scalarDot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}
/// a x b
inline Eigen::Vector3d scalarCross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}
/// Velocity at `at` of what moves with `centre` and turns with `spin` about the origin.
inline Eigen::Vector3d velocityAt(const Eigen::Vector3d& at, const Eigen::Vector3d& centre,
                                  const Eigen::Vector3d& spin) {
  const Eigen::Vector3d turned = scalarCross(spin, at);
  return {centre.x() + turned.x(), centre.y() + turned.y(), centre.z() + turned.z()};
}
/// sum += factor v
inline void addScaled(double factor, const Eigen::Vector3d& v, Eigen::Vector3d& sum) {
  sum.x() += factor * v.x();
  sum.y() += factor * v.y();
  sum.z() += factor * v.z();
}

/// (R - 1) d for the unit quaternion q = (s, e), without subtracting nearly equal numbers: 2 s (e x d) + 2 e
/// x (e x d).
template <class Real>
Vec3<Real> turned(const Quat<Real>& q, const Vec3<Real>& d) {
  const Vec3<Real> e = q.vec();
  const Vec3<Real> ed = e.cross(d);
  return Real(2) * (q.w() * ed + e.cross(ed));
}

}  // namespace rubble::edem
