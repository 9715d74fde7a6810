// The rigid motion that has the momenta of a set of elements.
#pragma once

#include <map>

#include "edem/body.h"

namespace rubble::edem {

struct RigidMotion {
  double mass = 0;                                     ///< [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of mass, world [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of it [m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();   ///< momentum about it [kg m^2/s]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();   ///< about it, world axes [kg m^2]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< [rad/s]

  Eigen::Vector3d at(const Eigen::Vector3d& world) const { return velocity + spin.cross(world - centre); }
  double kinetic() const { return 0.5 * (mass * velocity.squaredNorm() + spin.dot(angular)); }  ///< [J]
};

/// Of each fragment that does not sleep, by its lowest element.
template <class Real>
std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<Real>& body);

/// Of all that is alive.
template <class Real>
RigidMotion wholeMotion(const Body<Real>& body);

}  // namespace rubble::edem
