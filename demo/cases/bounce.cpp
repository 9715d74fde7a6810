// A block of one element, or the sphere of one, flies flat against a wall that stands. No gravity, so what it
// does before and after the blow is known and its times follow from where it is at the end.
#include <cmath>
#include <numbers>
#include <sstream>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/cases/lammps.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace bounce {
namespace {

constexpr double kEdge = 0.2, kGap = 0.05;         // [m]
constexpr double kSpeed = 1;                       // [m/s]
constexpr double kDensity = 2400, kModulus = 3e6;  // [kg/m^3], [Pa]
// Of the substep: a blow is resolved by more substeps than its stability needs, so only small ones tell.
constexpr std::initializer_list<double> kParts = {0.1, 0.03, 0.01, 0.003};
constexpr double kSimulated = 0.5;  // [s]

// How fast it leaves and how long it touched.
struct Bounce {
  double speed, contactSeconds;
};

// From its height at two times after the blow, the second at the end.
Bounce bounceOf(double before, double after, double between) {
  const double speed = (after - before) / between;
  return {speed, kSimulated - after / speed - kGap / kSpeed};
}

std::unique_ptr<btCollisionShape> wall() {
  return std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0));
}

double mass() {
  return kDensity * std::pow(kEdge, 3);
}

double stiffness() {
  return Material().contactStiffness * kModulus * kEdge;
}

// Heights of the lowest point, of any body: its centre's less half an edge, or the radius.
template <class Height>
Bounce fly(CaseWorld& world, double tick, Height height) {
  const int ticks = int(std::lround(kSimulated / tick)), reading = ticks * 4 / 5;
  double before = 0;
  for (int t = 0; t < ticks; ++t) {
    if (t == reading) before = height();
    world.step(tick);
  }
  return bounceOf(before, height(), (ticks - reading) * tick);
}

struct ElementRun {
  bool isSphere;  ///< else the block that its cell is
  Precision precision;
  double substepSafety, restitution;
};

std::pair<Bounce, CaseOutcome> runElements(const ElementRun& run) {
  CaseWorld world(0);
  world.add(0, wall(), Eigen::Vector3d::Zero()).setRestitution(1);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox(Eigen::Vector3d::Constant(kEdge), 1);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.contactDamping = def.material.friction = 0;
  def.material.restitution = run.restitution;
  def.model.cellFaces = !run.isSphere;
  const double centre = def.asset->positions[0].y();
  const double below = run.isSphere ? def.asset->radius : centre + kEdge / 2;
  def.transform.setOrigin(toBullet({0, below - centre + kGap, 0}));
  def.velocity = toBullet({0, -kSpeed, 0});
  const DestructibleBody* block = world.destruct(run.precision, run.substepSafety).addBody(def);
  const Bounce bounce = fly(world, 1.0 / 240, [&] { return placesOf(*block)[0].y() - below; });
  return {bounce, world.outcome(0)};
}

std::pair<Bounce, CaseOutcome> runStock(double rate, double restitution) {
  CaseWorld world(0);
  world.add(0, wall(), Eigen::Vector3d::Zero()).setRestitution(1);
  btRigidBody& block =
      world.add(mass(), std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d::Constant(kEdge / 2))),
                {0, kEdge / 2 + kGap, 0});
  block.setRestitution(btScalar(restitution));
  block.setLinearVelocity(toBullet({0, -kSpeed, 0}));
  const Bounce bounce =
      fly(world, 1 / rate, [&] { return double(block.getWorldTransform().getOrigin().y()) - kEdge / 2; });
  return {bounce, world.outcome(0)};
}

// A sphere as heavy as the block, on the same spring. A mass on a spring and a dashpot beside it, m x'' = -k
// x - m c x', leaves with e = exp(-c t / 2) after t = pi / sqrt(k / m - c^2 / 4).
std::pair<Bounce, CaseOutcome> runLammpsSphere(double timestep, double restitution) {
  const double radius = kEdge / 2, loss = std::log(restitution), pi = std::numbers::pi;
  const double damping = -2 * loss * std::sqrt(stiffness() / mass() / (pi * pi + loss * loss));
  const double density = mass() / (4.0 / 3 * pi * std::pow(radius, 3));
  const LammpsSphere sphere{0, radius + kGap, radius, density, stiffness(), damping, false};
  std::ostringstream speed;
  speed << "velocity all set 0 " << -kSpeed << " 0\n";
  const LammpsResult result =
      runLammps({lammpsScript(sphere) + speed.str(), {"xcm(all,y)", "vcm(all,y)"}, timestep, kSimulated});
  const Bounce bounce{result.values[1],
                      kSimulated - (result.values[0] - radius) / result.values[1] - kGap / kSpeed};
  return {bounce, {0, result.processorSeconds, kSimulated}};
}

CaseOutcome withError(CaseOutcome outcome, double error) {
  outcome.error = error;
  return outcome;
}

}  // namespace
}  // namespace bounce

double springContactSeconds(double mass, double stiffness) {
  return std::numbers::pi * std::sqrt(mass / stiffness);
}

ReportCase bounceCase() {
  using namespace bounce;
  constexpr double kRestitution = 0.5;
  ReportCase c{
      .name = "bounce",
      .what =
          "One element, a block of edge 0.2 m or the sphere in it, 19.2 kg, E 3 MPa, flies at 1 "
          "m/s flat against a wall",
      .closedForm = "the restitution set, 0.5, and of 1 the contact time pi sqrt(m / k), 25 ms, k = 0.5 E h",
      .error = "restitution: error of the speed back / speed; contact time: relative error",
      .runs = {},
      .note =
          "Elements withhold the share 1 - e^2 of the force in full from a parting speed of 0.1 m/s on, so "
          "that what rests is not held down: that alone makes e 0.5043"};
  const auto errorOfSpeed = [](const std::pair<Bounce, CaseOutcome>& ended) {
    return withError(ended.second, std::abs(ended.first.speed / kSpeed - kRestitution));
  };
  const auto errorOfTime = [](const std::pair<Bounce, CaseOutcome>& ended) {
    const double expected = springContactSeconds(mass(), stiffness());
    return withError(ended.second, std::abs(ended.first.contactSeconds / expected - 1));
  };
  const auto add = [&c](const std::vector<CaseRun>& runs) {
    c.runs.insert(c.runs.end(), runs.begin(), runs.end());
  };
  const auto elements = [&](const std::string& quantity, bool isSphere, double restitution, auto errorOf) {
    add(substepRuns(
        quantity,
        [=](Precision precision, double safety) {
          return errorOf(runElements({isSphere, precision, safety, restitution}));
        },
        kParts));
  };
  elements("restitution", false, kRestitution, errorOfSpeed);
  elements("restitution, sphere", true, kRestitution, errorOfSpeed);
  elements("contact time", false, 1, errorOfTime);
  elements("contact time, sphere", true, 1, errorOfTime);
  for (const double rate : {60.0, 240.0, 1000.0})
    add({{"restitution, Bullet's rigid box", rounded(rate) + " Hz", false, true,
          [=] { return errorOfSpeed(runStock(rate, kRestitution)); }}});
  add(lammpsRuns("restitution, LAMMPS", {1e-3, 1e-4, 1e-5},
                 [=](double timestep) { return errorOfSpeed(runLammpsSphere(timestep, kRestitution)); }));
  add(lammpsRuns("contact time, LAMMPS", {1e-3, 1e-4, 1e-5},
                 [=](double timestep) { return errorOfTime(runLammpsSphere(timestep, 1)); }));
  return c;
}

}  // namespace rubble::demo
