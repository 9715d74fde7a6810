// Point masses about a common centre: sums and projections that the conserving spawn is made of.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <span>

namespace rubble::debris {

/// Inertia of the points about the centre in their principal axes.
struct PrincipalInertia {
  Eigen::Vector3d moments;  ///< [kg m^2], ascending
  Eigen::Matrix3d axes;     ///< columns
};

/// Takes the mass-weighted mean away, so that sum m x = 0.
void removeMean(std::span<const double> masses, std::span<Eigen::Vector3d> values);

/// Sum of m o x v [kg m^2/s].
Eigen::Vector3d angularMomentum(std::span<const double> masses, std::span<const Eigen::Vector3d> offsets,
                                std::span<const Eigen::Vector3d> velocities);

/// Sum of m/2 |v|^2 [J].
double kineticEnergy(std::span<const double> masses, std::span<const Eigen::Vector3d> velocities);

PrincipalInertia principalInertia(std::span<const double> masses, std::span<const Eigen::Vector3d> offsets);

/// Takes the rigid rotation away that carries the points' angular momentum: afterwards it is 0 but for what
/// no rotation can carry (rounding). A projection that is orthogonal in the mass metric: it never adds
/// energy.
void removeRotation(std::span<const double> masses, std::span<const Eigen::Vector3d> offsets,
                    const PrincipalInertia& inertia, std::span<Eigen::Vector3d> velocities);

}  // namespace rubble::debris
