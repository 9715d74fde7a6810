// Grains that fall from rest through still air: the terminal speed of a fine one, and how far a stone has
// come while its drag still grows.
#include <cmath>

#include "debris/debris_system.h"
#include "demo/cases/case_timer.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"
#include "rubble/destruction.h"

namespace rubble::demo {
namespace debris_fall {
namespace {

constexpr double kDensity = 2400, kGravity = 9.81;   // [kg/m^3], [m/s^2]
constexpr double kGrain = 1e-6, kStone = 0.02;       // radii [m]
constexpr double kGrainSeconds = 0.5, kSeconds = 3;  // the stone has half of its terminal speed then
constexpr std::uint32_t kPieces = 1000;              // alike: what one costs is too little to time
constexpr double kDragCoefficient = 0.44;            // of the stone, at Reynolds numbers above 1000

class StillAir : public debris::DebrisCollider {
 public:
  bool sweep(const Eigen::Vector3d&, const Eigen::Vector3d&, double, debris::DebrisHit&) override {
    return false;
  }
};

CaseOutcome run(double rate, bool isStone) {
  debris::DebrisSystemDef def;
  def.maxDebris = kPieces;
  debris::DebrisSystem system(def);
  debris::DebrisParcel parcel;
  parcel.radius = parcel.collisionRadius = isStone ? kStone : kGrain;
  parcel.density = kDensity;
  parcel.mass = 4.0 / 3 * 3.141592653589793 * std::pow(parcel.radius, 3) * kDensity;
  for (std::uint32_t i = 0; i < kPieces; ++i) system.add({&parcel, 1});
  StillAir air;
  CaseTimer timer;
  const double seconds = isStone ? kSeconds : kGrainSeconds;
  for (int tick = 0; tick < int(std::lround(seconds * rate)); ++tick)
    timer.time(1 / rate, [&] { system.step(1 / rate, {0, -kGravity, 0}, air); });
  const DebrisPiece& piece = system.pieces().front();
  if (!isStone)
    return timer.outcome(std::abs(
        -double(piece.velocity.y()) / stokesSpeed(kGrain, kDensity, kGravity, def.air.viscosity) - 1));
  const double terminal =
      std::sqrt(8.0 / 3 * kStone * kDensity * kGravity / (kDragCoefficient * def.air.density));
  return timer.outcome(std::abs(-double(piece.position.y()) / fallenWay(terminal, kGravity, kSeconds) - 1));
}

}  // namespace
}  // namespace debris_fall

double stokesSpeed(double radius, double density, double gravity, double viscosity) {
  return 2.0 / 9 * density * gravity * radius * radius / viscosity;
}

double fallenWay(double terminalSpeed, double gravity, double seconds) {
  return terminalSpeed * terminalSpeed / gravity * std::log(std::cosh(gravity * seconds / terminalSpeed));
}

ReportCase debrisFallCase() {
  using namespace debris_fall;
  ReportCase c{
      .name = "debris_fall",
      .what =
          "A thousand grains, all of 1 micrometre or all stones of 2 cm, 2400 kg/m3, fall from rest through "
          "still air",
      .closedForm =
          "Stokes' terminal speed, 2 / 9 rho g R^2 / mu, 0.29 mm/s, and the stone's way in 3 s under "
          "Newton's drag of 0.44, v^2 / g ln cosh(g t / v), v 49 m/s",
      .error = "relative error of the speed, of the way",
      .runs = {},
      .note = "The law of drag has Schiller and Naumann's correction, 0.01 % at the grain's Reynolds number"};
  for (const bool isStone : {false, true})
    for (const double rate : {10.0, 30.0, 60.0, 240.0, 1000.0})
      c.runs.push_back({isStone ? "way of a stone" : "terminal speed of a grain", rounded(rate) + " Hz",
                        rate == 60, rate <= 240, [=] { return run(rate, isStone); }});
  return c;
}

}  // namespace rubble::demo
