// Two cubes on one spring, loaded at both ends until it breaks: pulled, sheared, bent and twisted. A breaking
// impulse of Bullet's is one number for forces and moments alike.
#include <array>
#include <cmath>

#include "demo/cases/case_timer.h"
#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"
#include "demo/stability/grid_asset.h"
#include "edem/solver.h"

namespace rubble::demo {
namespace spring_break {
namespace {

using Eigen::Vector3d;

constexpr double kEdge = 0.2;                           // of a cube, and of their face [m]
constexpr double kDensity = 2400, kModulus = 300e6;     // [kg/m^3], [Pa]; they swing with a period of 2.5 ms
constexpr double kTension = 0.2e6, kPressure = 2e6;     // f_t, f_c [Pa]
constexpr double kRamp = 1;                             // until the load asked [s]
constexpr double kMostElements = 3, kMostBullet = 150;  // of the load asked: it did not break
constexpr double kChosenRate = 240;                     // for which Bullet's threshold is set [Hz]

// Of the second cube, at the ends of the spring along x; the first has the opposite force, and the torque
// that leaves the face the load alone.
struct Loading {
  const char* name;
  double asked;            // [N] or [N m]
  Vector3d force, torque;  // of a load of 1
  Vector3d torqueOnFirst;
};

std::array<Loading, 4> loadings() {
  const double cohesion = cohesionOf(kTension, kPressure), arm = kEdge / 2;
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(), none = Vector3d::Zero();
  return {{{"pull", partingForce(kTension, kEdge * kEdge), x, none, none},
           {"shear", partingForce(cohesion, kEdge * kEdge), y, -arm * z, -arm * z},
           {"bend", squareBendingMoment(kTension, kEdge), none, z, -z},
           {"twist", squareTwistingMoment(cohesion, kEdge), none, x, -x}}};
}

// Lets the load grow until `broken`; that of the middle of that tick, over the load asked. Not finite: it
// held.
template <class Step, class Broken>
double grow(double rate, double most, Step step, Broken broken) {
  for (int tick = 0; tick < int(most * kRamp * rate); ++tick) {
    const double share = (tick + 0.5) / (kRamp * rate);
    step(share);
    if (broken()) return share;
  }
  return HUGE_VAL;
}

edem::BodyDef cubes() {
  stability::GridAssetDef grid;
  grid.cubes = {2, 1, 1};
  grid.edge = kEdge;
  grid.origin = -kEdge * Vector3d(1, 0.5, 0.5);
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(stability::gridAsset(grid));
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.tensileStrength = kTension;
  def.material.compressiveStrength = kPressure;
  def.anchored = false;
  return def;
}

CaseOutcome runElements(Precision precision, double substepSafety, double rate, const Loading& loading) {
  edem::SolverDef def;
  def.substepSafety = substepSafety;
  def.crushing = false;
  const auto solver = edem::Solver::make(precision, def);
  const std::uint32_t id = solver->addBody(cubes(), Vector3d::Zero());
  CaseTimer timer;
  const double reached = grow(
      rate, kMostElements,
      [&](double share) {
        const double load = share * loading.asked;
        const std::array<edem::HostLoad, 2> loads = {
            {{0, -load * loading.force, load * loading.torqueOnFirst},
             {1, load * loading.force, load * loading.torque}}};
        timer.time(1 / rate, [&] {
          solver->load(id, loads);
          solver->tick(1 / rate, Vector3d::Zero(), {});
        });
      },
      [&] { return solver->view(id).broken > 0; });
  return timer.outcome(std::abs(reached - 1));
}

// As a user would: the impulse that a tick of his rate gives at the force that pulls the face apart.
CaseOutcome runConstraint(double rate, const Loading& loading) {
  CaseWorld world(0);
  std::array<btRigidBody*, 2> boxes{};
  for (const int end : {0, 1})
    boxes[std::size_t(end)] = &world.add(
        kDensity * std::pow(kEdge, 3), std::make_unique<btBoxShape>(toBullet(Vector3d::Constant(kEdge / 2))),
        {(end - 0.5) * kEdge, 0, 0}, false);
  btTransform front = btTransform::getIdentity(), back = btTransform::getIdentity();
  front.setOrigin(toBullet({kEdge / 2, 0, 0}));
  back.setOrigin(toBullet({-kEdge / 2, 0, 0}));
  auto joint = std::make_unique<btFixedConstraint>(*boxes[0], *boxes[1], front, back);
  joint->setBreakingImpulseThreshold(btScalar(partingForce(kTension, kEdge * kEdge) / kChosenRate));
  const btFixedConstraint* fixed = joint.get();
  world.join(std::move(joint));
  const double reached = grow(
      rate, kMostBullet,
      [&](double share) {
        const double load = share * loading.asked;
        boxes[0]->applyCentralForce(toBullet(-load * loading.force));
        boxes[0]->applyTorque(toBullet(load * loading.torqueOnFirst));
        boxes[1]->applyCentralForce(toBullet(load * loading.force));
        boxes[1]->applyTorque(toBullet(load * loading.torque));
        world.step(1 / rate);
      },
      [&] { return !fixed->isEnabled(); });
  return world.outcome(std::abs(reached - 1));
}

}  // namespace
}  // namespace spring_break

double cohesionOf(double tensileStrength, double compressiveStrength) {
  return std::sqrt(tensileStrength * compressiveStrength) / 2;
}

double squareBendingMoment(double strength, double edge) {
  return strength * std::pow(edge, 3) / 6;
}

double squareTwistingMoment(double strength, double edge) {
  return 0.208 * strength * std::pow(edge, 3);
}

ReportCase springBreakCase() {
  using namespace spring_break;
  ReportCase c{
      .name = "spring_break",
      .what =
          "Two cubes of 0.2 m on one spring, f_t 0.2 MPa, f_c 2 MPa, pulled, sheared, bent and twisted "
          "until it breaks",
      .closedForm =
          "f_t A, c A, f_t a^3 / 6 and 0.208 c a^3 of a square face of edge a (Timoshenko and Goodier, "
          "Theory "
          "of Elasticity, 109), c = sqrt(f_c f_t) / 2 of Mohr and Coulomb's law",
      .error = "relative error of the force or moment at which it breaks",
      .runs = {},
      .note =
          "The load grows to that value in 1 s; the rate is that of the host's ticks, through each of which "
          "it "
          "is even; Bullet's constraint has the breaking impulse that f_t A gives in a tick of 240 Hz"};
  const double standard = DestructionDef{}.substepSafety;
  for (const Loading& loading : loadings()) {
    const std::string name = loading.name;
    const auto add = [&](Precision precision, const std::string& method, double safety) {
      for (const double rate : {60.0, kChosenRate, 1000.0, 4000.0})
        c.runs.push_back({name + ", elements, " + precisionName(precision) + method,
                          rounded(rate) + " Hz, substep_safety " + rounded(safety),
                          precision == Precision::Float && rate == kChosenRate, rate <= kChosenRate,
                          [=] { return runElements(precision, safety, rate, loading); }});
    };
    add(Precision::Float, "", standard);
    add(Precision::Double, ", shorter substeps", standard / 4);
    for (const double rate : {60.0, kChosenRate, 1000.0})
      c.runs.push_back({name + ", Bullet's btFixedConstraint", rounded(rate) + " Hz", false, true,
                        [=] { return runConstraint(rate, loading); }});
  }
  return c;
}

}  // namespace rubble::demo
