// A block of one element flies flat against a wall that stands. No gravity, so what it does before and after
// the blow is known and its times follow from where it is at the end.
#include <cmath>
#include <numbers>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
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

// Heights of the lowest face, of any body: its centre's less half an edge.
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

struct BlockRun {
  Precision precision;
  double substepSafety, restitution;
};

std::pair<Bounce, CaseOutcome> runElements(const BlockRun& run) {
  CaseWorld world(0);
  world.add(0, wall(), Eigen::Vector3d::Zero()).setRestitution(1);
  DestructibleBodyDef def;
  def.asset = cookedBox(Eigen::Vector3d::Constant(kEdge), 1);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.contactDamping = def.material.friction = 0;
  def.material.restitution = run.restitution;
  def.transform.setOrigin(toBullet({0, kEdge / 2 + kGap, 0}));
  def.velocity = toBullet({0, -kSpeed, 0});
  const DestructibleBody* block = world.destruct(run.precision, run.substepSafety).addBody(def);
  const double centre = def.asset->positions[0].y();
  const Bounce bounce = fly(world, 1.0 / 240, [&] { return placesOf(*block)[0].y() - centre - kEdge / 2; });
  return {bounce, world.outcome(0)};
}

std::pair<Bounce, CaseOutcome> runStock(double rate, double restitution) {
  CaseWorld world(0);
  world.add(0, wall(), Eigen::Vector3d::Zero()).setRestitution(1);
  btRigidBody& block = world.add(kDensity * std::pow(kEdge, 3),
                                 std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d::Constant(kEdge / 2))),
                                 {0, kEdge / 2 + kGap, 0});
  block.setRestitution(btScalar(restitution));
  block.setLinearVelocity(toBullet({0, -kSpeed, 0}));
  const Bounce bounce =
      fly(world, 1 / rate, [&] { return double(block.getWorldTransform().getOrigin().y()) - kEdge / 2; });
  return {bounce, world.outcome(0)};
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
      .what = "A block of one element, edge 0.2 m, 2400 kg/m3, E 3 MPa, flies at 1 m/s flat against a wall",
      .closedForm = "the restitution set, 0.5, and of 1 the contact time pi sqrt(m / k), 25 ms, k = 0.5 E h",
      .error = "restitution: error of the speed back / speed; contact time: relative error",
      .runs = substepRuns(
          "restitution",
          [](Precision precision, double safety) {
            const auto [bounce, outcome] = runElements({precision, safety, kRestitution});
            return withError(outcome, std::abs(bounce.speed / kSpeed - kRestitution));
          },
          kParts)};
  const std::vector<CaseRun> times = substepRuns(
      "contact time",
      [](Precision precision, double safety) {
        const auto [bounce, outcome] = runElements({precision, safety, 1});
        const Material material;
        const double expected =
            springContactSeconds(kDensity * std::pow(kEdge, 3), material.contactStiffness * kModulus * kEdge);
        return withError(outcome, std::abs(bounce.contactSeconds / expected - 1));
      },
      kParts);
  c.runs.insert(c.runs.end(), times.begin(), times.end());
  for (const double rate : {60.0, 240.0, 1000.0}) {
    c.runs.push_back({"restitution, Bullet's rigid box", rounded(rate) + " Hz", false, true, [=] {
                        const auto [bounce, outcome] = runStock(rate, kRestitution);
                        return withError(outcome, std::abs(bounce.speed / kSpeed - kRestitution));
                      }});
  }
  return c;
}

}  // namespace rubble::demo
