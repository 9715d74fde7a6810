// When a body that Bullet moves as a whole must become elements: the rule, on numbers.
#pragma once

#include <span>

#include "edem/rigid_proxy.h"
#include "edem/solver.h"
#include "rubble/abi.h"
#include "rubble/material.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Motion of a rigid body about a point of it.
struct RigidMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();                                    ///< [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();  ///< [m/s], [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< of the centre, by forces [m/s^2]
  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return velocity + spin.cross(x - centre); }
};

/// Closing speed from which a blow is left to the elements [m/s]: that of a stress rho c v of half the
/// tensile strength.
double strikingSpeed(const Material& material);

/// Whether something at `partner`'s surface strikes one of the elements within `dt` hard enough, forces on
/// the way there included. A light partner gives less: what it does is over before sound has crossed an
/// element.
bool strikes(const edem::Solver& solver, std::uint32_t body, const RigidMotion& own,
             const edem::RigidProxy& partner, double strikingSpeed, double dt);

/// The same for elements of another body that strike the rigid body `own`.
bool elementsStrike(const edem::Solver& solver, std::uint32_t striking, const edem::RigidProxy& own,
                    double strikingSpeed, double dt);

/// A point of something soft.
struct StrikingPoint {
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();  ///< [m], [m/s]
  double inverseMass = 0;                                                            ///< [1/kg]
};

/// The same for points of a soft body with this margin; an element of the rigid body weighs `elementMass`.
bool pointsStrike(std::span<const StrikingPoint> points, double margin, const edem::RigidProxy& own,
                  double elementMass, double strikingSpeed, double dt);

RUBBLE_ABI_END
}  // namespace rubble::bullet
