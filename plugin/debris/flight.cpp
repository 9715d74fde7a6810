#include "debris/flight.h"

#include <algorithm>
#include <cmath>

namespace rubble::debris {

namespace {

// Schiller and Naumann 1935: C_d = 24 / Re (1 + 0.15 Re^0.687); and C_d of a sphere in Newton's regime.
constexpr double kSchillerFactor = 0.15;
constexpr double kSchillerExponent = 0.687;
constexpr double kNewtonDrag = 0.44;
constexpr double kStokesDrag = 24;

// Below this z the closed form (z - 1 + exp(-z)) / z^2 loses digits; its series to z^7 is then exact to
// 1e-15.
constexpr double kSeriesBelow = 0.1;

// The weights of velocity and gravity in a flight of z = k t: decay = exp(-z), first = (1 - decay) / z,
// second = (1 - first) / z.
struct Weights {
  double decay, first, second;
};

Weights weights(double z) {
  if (z < kSeriesBelow) {
    double second = 0;
    for (const double n : {9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0}) second = (1 - second) * z / n;
    second = (1 - second) / 2;
    const double first = 1 - z * second;
    return {1 - z * first, first, second};
  }
  const double first = -std::expm1(-z) / z;
  return {std::exp(-z), first, (1 - first) / z};
}

}  // namespace

GrainDrag grainDrag(const Air& air, double grainDensity, double radius) {
  if (!(air.viscosity > 0)) return {};
  return {9 * air.viscosity / (2 * grainDensity * radius * radius), 2 * radius * air.density / air.viscosity};
}

double dragRate(const GrainDrag& drag, double speed) {
  const double reynolds = drag.reynoldsPerSpeed * speed;
  const double schiller = 1 + kSchillerFactor * std::pow(reynolds, kSchillerExponent);
  return drag.stokesRate * std::max(schiller, kNewtonDrag / kStokesDrag * reynolds);
}

double stepDragRate(const GrainDrag& drag, const Eigen::Vector3d& velocity, const Eigen::Vector3d& gravity,
                    double dt) {
  if (!(drag.stokesRate > 0)) return 0;
  const double speed = velocity.norm();
  const double rate = dragRate(drag, speed);
  const double predicted = (velocity + dt * gravity).norm() / (1 + rate * dt);
  return dragRate(drag, (speed + predicted) / 2);
}

Flight fly(const Eigen::Vector3d& velocity, const Eigen::Vector3d& gravity, double rate, double time) {
  const Weights w = weights(rate * time);
  return {time * w.first * velocity + time * time * w.second * gravity,
          w.decay * velocity + time * w.first * gravity};
}

}  // namespace rubble::debris
