#include "debris/flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "debris/debris_system.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
using namespace debris;
namespace {

using Eigen::Vector3d;

constexpr double kDensity = 2400;

// Force of the air on a sphere from its drag coefficient, as textbooks write it: F = C_d rho / 2 pi R^2 v^2.
double dragForce(double radius, double speed) {
  const double reynolds = 2 * radius * speed * 1.2 / 1.8e-5;
  const double coefficient = std::max(24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687)), 0.44);
  return coefficient * 0.5 * 1.2 * std::numbers::pi * radius * radius * speed * speed;
}

double weight(double radius) {
  return 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * kDensity * kGravity;
}

// Bisection of drag = weight.
double terminalSpeed(double radius) {
  double low = 1e-9, high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (dragForce(radius, middle) < weight(radius) ? low : high) = middle;
  }
  return low;
}

// One piece falling for `seconds` in free air.
DebrisPiece fallen(double radius, double seconds, double tick, const Air& air, const Vector3d& velocity) {
  DebrisSystem system({.maxDebris = 1, .air = air});
  const DebrisParcel parcel = test::stone(Vector3d::Zero(), velocity, radius);
  system.add({&parcel, 1});
  test::Surroundings nothing;
  const int steps = int(std::lround(seconds / tick));
  for (int i = 0; i < steps; ++i) system.step(tick, kDown, nothing);
  return system.pieces()[0];
}

TEST(Flight, InVacuumIsTheParabola) {
  const Vector3d velocity(2, 5, -1);
  for (const double tick : {1.0 / 30, 1.0 / 240, 0.5}) {
    const DebrisPiece piece = fallen(0.005, 1.5, tick, test::kVacuum, velocity);
    const Vector3d place = 1.5 * velocity + 0.5 * 1.5 * 1.5 * kDown;
    EXPECT_LT((piece.position.cast<double>() - place).norm(), 1e-6) << "float output at 10 m";
    EXPECT_LT((piece.velocity.cast<double>() - velocity - 1.5 * kDown).norm(), 1e-6);
  }
}

TEST(Flight, GrainsReachTheTerminalSpeedOfTheDragLaw) {
  // From dust that floats to stones in Newton's regime; the closed form at the fine end is Stokes' 2/9 rho g
  // R^2 / mu.
  for (const double radius : {5e-6, 5e-5, 3e-4, 2e-3, 1e-2, 5e-2}) {
    const double speed = -double(fallen(radius, 60, 1.0 / 30, Air{}, Vector3d::Zero()).velocity.y());
    EXPECT_NEAR(speed / terminalSpeed(radius), 1, 1e-5) << radius;
  }
  const double stokes = 2.0 / 9 * kDensity * kGravity * 5e-6 * 5e-6 / 1.8e-5;
  EXPECT_NEAR(terminalSpeed(5e-6) / stokes, 1, 0.01);
}

TEST(Flight, StepsOfTenSecondsStillReachTheTerminalSpeed) {
  for (const double radius : {5e-6, 2e-3, 5e-2}) {
    const double speed = -double(fallen(radius, 600, 10, Air{}, Vector3d::Zero()).velocity.y());
    EXPECT_NEAR(speed / terminalSpeed(radius), 1, 1e-5) << radius;
  }
}

TEST(Flight, FollowsAFineIndependentSolution) {
  // Fourth-order Runge-Kutta at 1e-5 s on the textbook force; the flight takes 60 steps of 1/240 s.
  for (const double radius : {1e-4, 1e-3, 1e-2}) {
    const double mass = weight(radius) / kGravity;
    const auto acceleration = [&](const Vector3d& v) -> Vector3d {
      return kDown - dragForce(radius, v.norm()) / mass * v / v.norm();
    };
    Vector3d x = Vector3d::Zero(), v(15, 5, 0);
    const double h = 1e-5;
    for (int i = 0; i < 25000; ++i) {
      const Vector3d a1 = acceleration(v), a2 = acceleration(v + h / 2 * a1),
                     a3 = acceleration(v + h / 2 * a2);
      const Vector3d a4 = acceleration(v + h * a3);
      x += h * v + h * h / 6 * (a1 + a2 + a3);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    const DebrisPiece piece = fallen(radius, 0.25, kTick, Air{}, {15, 5, 0});
    // Second order: the finest grain loses its speed in 15 ms, four steps, and is off by most.
    const double tolerance = radius < 5e-4 ? 0.02 : 1e-4;
    EXPECT_LT((piece.position.cast<double>() - x).norm(), tolerance * x.norm()) << radius;
    EXPECT_LT((piece.velocity.cast<double>() - v).norm(), tolerance * v.norm() + 1e-6) << radius;
  }
}

TEST(Flight, ConvergesAtSecondOrder) {
  const auto speedAt = [](double tick) {
    const GrainDrag drag = grainDrag(Air{}, kDensity, 1e-3);
    Vector3d velocity(15, 0, 0);
    for (int i = 0; i < std::lround(0.4 / tick); ++i)
      velocity = fly(velocity, kDown, stepDragRate(drag, velocity, kDown, tick), tick).velocity;
    return velocity.x();
  };
  const double exact = speedAt(0.4 / 16384);
  const double ratio = (speedAt(0.4 / 16) - exact) / (speedAt(0.4 / 32) - exact);
  EXPECT_NEAR(ratio, 4, 0.6);
}

TEST(Flight, IsOneMapOnBothSidesOfTheSeries) {
  // z = k t crosses the switch from series to closed form at 0.1.
  const Vector3d velocity(1, 2, 3);
  const Flight below = fly(velocity, kDown, 1, std::nextafter(0.1, 0.0));
  const Flight above = fly(velocity, kDown, 1, 0.1);
  EXPECT_LT((below.displacement - above.displacement).norm(), 1e-14);
  EXPECT_LT((below.velocity - above.velocity).norm(), 1e-14);
}

TEST(Flight, ParcelsOfOneGrainSizeFallAlikeWhateverTheirMass) {
  DebrisSystem system({.maxDebris = 2});
  DebrisParcel light = test::stone(1.0), heavy = test::stone(1.0);
  heavy.mass = 50 * light.mass;
  system.add({&light, 1});
  system.add({&heavy, 1});
  test::Surroundings nothing;
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, nothing);
  EXPECT_EQ(system.pieces()[0].position, system.pieces()[1].position);
}

TEST(Flight, SpinTurnsThePieceAtItsRate) {
  DebrisSystem system({.maxDebris = 1});
  DebrisParcel parcel = test::stone(0.0);
  parcel.spin = {0, 0, 2};
  system.add({&parcel, 1});
  test::Surroundings nothing;
  for (int i = 0; i < 240; ++i) system.step(kTick, Vector3d::Zero(), nothing);
  const Eigen::Quaternionf expected(Eigen::AngleAxisf(2, Eigen::Vector3f::UnitZ()));
  EXPECT_LT(system.pieces()[0].orientation.angularDistance(expected), 1e-4f);
}

}  // namespace
}  // namespace rubble::test
