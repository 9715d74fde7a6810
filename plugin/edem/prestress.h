// The static state of an anchored body under gravity, so that it stands still from its first step without any
// damping. A body that only stands on the ground has none of its own (it depends on what it touches): it is
// not pre-stressed and settles by itself.
#pragma once

#include "edem/body.h"
#include "edem/static_rest.h"

namespace rubble::edem {

/// Largest residual of a state that is applied. A residual r in the slowest mode, omega_1, swings without
/// damping at r g / omega_1: below 1e-6 m/s for every body whose slowest vibration is above 1.6 Hz, which is
/// what float velocities near rest can tell from nothing.
inline constexpr double kPrestressTolerance = 1e-6;

enum class RestMethod {
  Chosen,  ///< sparse Cholesky for a few hundred elements, conjugate gradients above
  Direct,  ///< sparse Cholesky
  Grouped  ///< conjugate gradients with two levels
};

/// Finds the static state of a body, in the asset's axes, without touching the body. The state that its asset
/// keeps is taken if its key is that of the body and it leaves no more than kPrestressTolerance; else
/// `refusal` says why, and it is solved: K (u, theta) = (m g, 0) with the stiffness at rest, the
/// finite-rotation residual corrected with the same K, or with that of the state found where this gains too
/// little, until it is below kPrestressTolerance. `rest` is valid if the result is applied().
template <class Real>
PrestressResult findRest(const Body<Real>& body, const Eigen::Vector3d& gravity, RestMethod method,
                         AssetRest& rest);

/// Writes the displacements and rotations of findRest into the body. When there are none, the body is left as
/// it was. A whole body's result is taken from and kept in `cache`, if one is given; what its asset keeps is
/// not kept twice.
template <class Real>
PrestressResult prestress(Body<Real>& body, const Eigen::Vector3d& gravity, StaticRestCache* cache = nullptr,
                          RestMethod method = RestMethod::Chosen);

}  // namespace rubble::edem
