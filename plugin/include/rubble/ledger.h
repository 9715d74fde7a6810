// What the simulation holds and has exchanged, with the error that each balance closes with.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace rubble {

/// Balances of one world of destructible bodies, since its start. Errors are closing errors divided by a
/// scale that only grows during the run (plugin/README.md, "Ledgers"). SI units.
struct Ledger {
  // Mass [kg]
  double massElements = 0;
  double massDebris = 0;
  double massDustEmitted = 0;
  double massRemoved = 0;  ///< debris taken away by the budget
  double massError = 0;    ///< dimensionless

  // Momentum of elements and debris
  Eigen::Vector3d linearMomentum = Eigen::Vector3d::Zero();   ///< [kg m/s]
  Eigen::Vector3d angularMomentum = Eigen::Vector3d::Zero();  ///< about the initial centre of mass [kg m^2/s]
  double linearError = 0;                                     ///< dimensionless
  double angularError = 0;                                    ///< dimensionless
  /// What the errors of momentum are divided by, angular ones times the bodies' diagonal as well: the most
  /// momentum that elements and debris can have had at the end of any tick, sqrt(2 mass kinetic energy), plus
  /// the most that was exchanged in any tick, sum of |impulse|. It does not grow with time at rest [N s].
  double momentumScale = 0;
  double momentumError() const { return linearError > angularError ? linearError : angularError; }

  // Energy [J]
  double kinetic = 0;     ///< of elements
  double elastic = 0;     ///< of springs, anchors and element contacts, from rest
  double gravity = 0;     ///< work done by gravity so far
  double dissipated = 0;  ///< by dashpots, friction, air, ground hits of debris
  double fracture = 0;    ///< released by broken springs and crushed elements, not given to debris
  double debris = 0;      ///< kinetic energy of debris
  double exchanged = 0;   ///< work done by Bullet's bodies so far
  /// Put in by place alone, so far: debris that were set out of what they were in, against gravity, or that
  /// waited for it to make room. No body gave it.
  double placed = 0;
  /// The energies here are those of the instant of the last forces, velocities those of half a substep later.
  /// At that instant Bullet's dynamic bodies held so much more kinetic energy than by their velocities: what
  /// they do on elements in that half step.
  double exchangedNext = 0;
  double removed = 0;      ///< taken away by sleep, removal and dust
  double energyError = 0;  ///< dimensionless
  /// The most that elements got from one rigid body beyond what that gave, up to now: energy out of nothing
  /// [J]. And the bodies that made so much that a warning was logged.
  double made = 0;
  std::uint32_t makers = 0;
  double energyScale = 0;  ///< the most that was in the world, which energyError is divided by [J]
};

}  // namespace rubble
