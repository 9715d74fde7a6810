// An element on its way from the solver, which crushes it, to the debris and dust that it becomes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace rubble::base {

/// An element at the end of the substep in which eq. (4) crushed it.
struct CrushedElement {
  std::uint32_t body = 0;
  std::uint32_t element = 0;
  Eigen::Vector3d restCentre = Eigen::Vector3d::Zero();  ///< in the frame of the cell's faces [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();      ///< now [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< [rad/s]
  double mass = 0;                                     ///< [kg], > 0
  double inertia = 0;                                  ///< scalar, about the centre [kg m^2], >= 0
  double volume = 0;                                   ///< of its clipped cell [m^3], > 0
  double radius = 0;                                   ///< r [m], > 0
  double fractureEnergy = 0;                           ///< W_I of eq. (3) [J]
  double maxRadius = 0;                                ///< R_max of eq. (4) [m]
  /// What its springs released when it crushed, each spring counted once [J]: the cap on the energy of the
  /// debris.
  double releasedEnergy = 0;
};

}  // namespace rubble::base
