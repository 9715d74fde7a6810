// Flight of a grain through still air: drag by size, integrated exactly for a drag rate that is constant over
// the step.
#pragma once

#include <Eigen/Core>

namespace rubble::debris {

/// The air that debris fly through; it is at rest.
struct Air {
  double density = 1.2;       ///< [kg/m^3], >= 0
  double viscosity = 1.8e-5;  ///< dynamic [Pa s], >= 0; 0 is vacuum
};

/// A grain's drag law. The drag force on a sphere of radius R is 6 pi mu R v f(Re), Re = 2 R |v| rho_air /
/// mu, with f = max(1 + 0.15 Re^0.687, 0.44 Re / 24): Stokes with Schiller and Naumann's correction, and the
/// constant drag coefficient 0.44 where that is larger (Re about 1000 and above) [Clift, Grace, Weber 1978,
/// ch. 5]. Divided by the grain's mass 4/3 pi rho R^3 it is a rate k = 9 mu / (2 rho R^2) f: dv/dt = g - k v.
/// Buoyancy (rho_air / rho, half a per mille) is left out.
struct GrainDrag {
  double stokesRate = 0;        ///< 9 mu / (2 rho R^2) [1/s]
  double reynoldsPerSpeed = 0;  ///< 2 R rho_air / mu [s/m]
};

/// Drag of a grain of density [kg/m^3] and radius R [m].
GrainDrag grainDrag(const Air& air, double grainDensity, double radius);

/// k [1/s] at a speed [m/s].
double dragRate(const GrainDrag& drag, double speed);

/// k [1/s] to hold constant over a step of dt seconds: the rate at the mean of the speeds at its start and,
/// predicted implicitly, at its end. Second order in dt; for any dt, however long, the speed tends to the
/// terminal one: under quadratic drag a long step is v -> 2 v v_t^2 / (v^2 + v_t^2), which converges
/// quadratically, where the rate at the start of the step would give v -> v_t^2 / v, which oscillates for
/// ever.
double stepDragRate(const GrainDrag& drag, const Eigen::Vector3d& velocity, const Eigen::Vector3d& gravity,
                    double dt);

/// Where dv/dt = g - k v leads in `time` seconds.
struct Flight {
  Eigen::Vector3d displacement;  ///< [m]
  Eigen::Vector3d velocity;      ///< at the end [m/s]
};

/// Exact for constant k >= 0: no step is too long.
Flight fly(const Eigen::Vector3d& velocity, const Eigen::Vector3d& gravity, double rate, double time);

}  // namespace rubble::debris
