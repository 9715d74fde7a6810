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

/// Of all that is alive, or of the fragment whose lowest element is `root`.
template <class Real>
RigidMotion wholeMotion(const Body<Real>& body, std::uint32_t root = kNoElement);

/// Where the asset's frame is, by the best rigid motion of what is alive of a fragment, or of all: mean
/// rotation and mean position, mass-weighted.
struct Placement {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();      ///< of its masses, world [m]
  Eigen::Vector3d restCentre = Eigen::Vector3d::Zero();  ///< the same at rest in the asset's frame [m]
  double mass = 0;                                       ///< [kg]; 0: nothing is alive
  bool anchored = false;                                 ///< an anchor holds some of it
};
template <class Real>
Placement placementOf(const Body<Real>& body, std::uint32_t root = kNoElement);

}  // namespace rubble::edem
