// A ball of Bullet's rolls down a slab of elements, from rest. Gravity is tilted and the slab is level, so
// that it is cooked along its axes.
#include <cmath>
#include <sstream>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/cases/lammps.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace roll {
namespace {

const Eigen::Vector3d kSize(2, 0.1, 0.4);  // of the slab [m]
constexpr std::size_t kElements = 128;
constexpr double kDensity = 2400, kModulus = 30e6,
                 kStiff = 300e6;                 // of slab and, the density, ball [kg/m^3], [Pa]
constexpr double kRadius = 0.1;                  // of the ball [m]
constexpr double kSlope = 0.2, kGravity = 9.81;  // [rad], [m/s^2]
constexpr double kSimulated = 1;                 // [s]; it rolls 0.7 m
constexpr double kStart = -0.6;                  // from the slab's middle [m]

double mass() {
  return 4.0 / 3 * 3.141592653589793 * std::pow(kRadius, 3) * kDensity;
}

void tilt(CaseWorld& world) {
  world.world().setGravity(toBullet(kGravity * Eigen::Vector3d(std::sin(kSlope), -std::cos(kSlope), 0)));
}

btRigidBody& addBall(CaseWorld& world, double depth) {
  btRigidBody& ball = world.add(mass(), std::make_unique<btSphereShape>(btScalar(kRadius)),
                                {kStart, kSize.y() / 2 + kRadius - depth, 0});
  ball.setFriction(1);
  return ball;
}

double errorOf(double way) {
  return std::abs(way / (rollingAcceleration(kGravity, kSlope) * kSimulated * kSimulated / 2) - 1);
}

CaseOutcome outcomeOf(CaseWorld& world, const btRigidBody& ball, double tick) {
  for (int t = 0; t < int(std::lround(kSimulated / tick)); ++t) world.step(tick);
  return world.outcome(errorOf(double(ball.getWorldTransform().getOrigin().x()) - kStart));
}

struct SlabRun {
  Precision precision;
  double substepSafety;
  double rate;     // of Bullet's ticks [Hz]
  double modulus;  // [Pa]
};

// Not finite: the slab breaks.
CaseOutcome runElements(const SlabRun& run) {
  CaseWorld world(0);
  tilt(world);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox(kSize, kElements, -Eigen::Vector3d::UnitY());
  def.material.density = kDensity;
  def.material.youngsModulus = run.modulus;
  Destruction& destruction = world.destruct(run.precision, run.substepSafety, false, true);
  destruction.addBody(def);
  // It lies as deep as its weight presses it in.
  const double stiffness = def.material.contactStiffness * run.modulus * def.asset->spacing();  // [N/m]
  const btRigidBody& ball = addBall(world, mass() * kGravity * std::cos(kSlope) / stiffness);
  CaseOutcome outcome = outcomeOf(world, ball, 1 / run.rate);
  if (destruction.counts().springsBroken > 0) outcome.error = HUGE_VAL;
  return outcome;
}

CaseOutcome runStock(double rate) {
  CaseWorld world(0);
  tilt(world);
  world.add(0, std::make_unique<btBoxShape>(toBullet(kSize / 2)), {0, 0, 0});
  const btRigidBody& ball = addBall(world, 0);
  return outcomeOf(world, ball, 1 / rate);
}

// On a wall as stiff as an element of the slab, critically damped.
CaseOutcome runLammpsBall(double timestep) {
  const double stiffness =
      Material().contactStiffness * kModulus * std::cbrt(kSize.prod() / double(kElements));  // [N/m]
  const double depth = mass() * kGravity * std::cos(kSlope) / stiffness;
  const LammpsSphere ball{
      kStart, kRadius - depth, kRadius, kDensity, stiffness, 2 * std::sqrt(stiffness / mass()), true};
  std::ostringstream fall;
  fall << "fix fall all gravity " << kGravity << " vector " << std::sin(kSlope) << ' ' << -std::cos(kSlope)
       << " 0\n";
  const LammpsResult result =
      runLammps({lammpsScript(ball) + fall.str(), {"xcm(all,x)"}, timestep, kSimulated});
  return {errorOf(result.values[0] - kStart), result.processorSeconds, kSimulated};
}

}  // namespace
}  // namespace roll

double rollingAcceleration(double gravity, double slope) {
  return 5.0 / 7 * gravity * std::sin(slope);
}

ReportCase rollCase() {
  using namespace roll;
  ReportCase c{
      .name = "roll",
      .what =
          "A ball of Bullet's, radius 0.1 m, 10 kg, rolls down a slope of 0.2 rad on a slab of 128 "
          "elements, 2400 kg/m3, E 30 or 300 MPa",
      .closedForm =
          "the way of a sphere that rolls without slipping, 5 / 7 g sin(slope) t^2 / 2, 0.70 m in 1 s",
      .error = "relative error of the way",
      .runs = {},
      .note = "What is left goes as 1 / E: the slab yields under the ball"};
  const double standard = DestructionDef{}.substepSafety;
  const auto add = [&](const std::string& method, const SlabRun& run) {
    c.runs.push_back({"elements, " + precisionName(run.precision) + method,
                      rounded(run.rate) + " Hz, substep_safety " + rounded(run.substepSafety),
                      method.empty() && run.precision == Precision::Float && run.rate == 240,
                      run.rate <= 240 && run.substepSafety == standard, [=] { return runElements(run); }});
  };
  for (const Precision precision : {Precision::Float, Precision::Double})
    for (const double rate : {60.0, 240.0, 1000.0}) add("", {precision, standard, rate, kModulus});
  for (const double part : {1.0, 0.5, 0.25})
    add(", shorter substeps", {Precision::Float, standard * part, 240, kModulus});
  for (const double rate : {60.0, 240.0}) add(", E 300 MPa", {Precision::Float, standard, rate, kStiff});
  for (const double rate : {60.0, 240.0, 1000.0})
    c.runs.push_back(
        {"Bullet's rigid slab", rounded(rate) + " Hz", false, true, [=] { return runStock(rate); }});
  for (const CaseRun& run : lammpsRuns("LAMMPS, its wall as stiff", {1e-3, 1e-4, 1e-5}, runLammpsBall))
    c.runs.push_back(run);
  return c;
}

}  // namespace rubble::demo
