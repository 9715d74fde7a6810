// A bar held at one end and pulled at the other until it parts. Bullet's own fracture is a constraint that is
// switched off above an impulse: the force times the tick, so it knows its strength at one rate alone.
#include <algorithm>
#include <cmath>
#include <string>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace strength {
namespace {

constexpr double kLength = 1, kWidth = 0.1;         // [m]
constexpr double kDensity = 2400, kModulus = 30e6;  // [kg/m^3], [Pa]
constexpr double kStrength = 0.33e6;                // [Pa]
constexpr double kRamp = 2;                         // until the force asked [s]: 56 periods of the bar
constexpr double kMostForce = 6;                    // of the force asked: it did not part
constexpr double kChosenRate = 240;                 // for which Bullet's threshold is set [Hz]
constexpr std::size_t kElements = 80;               // two across
constexpr int kBoxes = 10;
constexpr double kGrip = kLength / kBoxes;  // of the box that is pulled

// Pulls until `parted`; the force of the middle of that tick, over the force asked. Not finite: it held.
double pull(CaseWorld& world, btRigidBody& pulled, double rate, const std::function<bool()>& parted) {
  const double asked = partingForce(kStrength, kWidth * kWidth);
  for (int tick = 0; tick < int(kMostForce * kRamp * rate); ++tick) {
    const double share = (tick + 0.5) / (kRamp * rate);
    pulled.applyCentralForce(toBullet({share * asked, 0, 0}));
    world.step(1 / rate);
    if (parted()) return share;
  }
  return std::nan("");
}

CaseOutcome outcomeOf(const CaseWorld& world, double reached) {
  CaseOutcome outcome = world.outcome(std::abs(reached - 1));
  if (!std::isfinite(reached)) outcome.error = HUGE_VAL;
  return outcome;
}

std::unique_ptr<btCollisionShape> gripShape() {
  return std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d(kGrip, kWidth, kWidth) / 2));
}

btTransform at(double x) {
  btTransform place = btTransform::getIdentity();
  place.setOrigin(toBullet({x, 0, 0}));
  return place;
}

// A box as heavy as a tenth of the bar is fixed to its end.
CaseOutcome runElements(Precision precision, double substepSafety, double rate) {
  CaseWorld world(0);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox({kLength, kWidth, kWidth}, kElements, -Eigen::Vector3d::UnitX());
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.material.tensileStrength = kStrength;
  DestructibleBody* bar = world.destruct(precision, substepSafety, false, true).addBody(def);
  btRigidBody& grip =
      world.add(kDensity * kGrip * kWidth * kWidth, gripShape(), {(kLength + kGrip) / 2, 0, 0}, false);
  const btTransform end = bar->getWorldTransform().inverse() * at(kLength / 2);
  world.join(std::make_unique<btFixedConstraint>(*bar, grip, end, at(-kGrip / 2)));
  // It has parted when what the grip holds is no longer what the anchors hold.
  std::size_t held = 0, tied = 0;
  for (std::size_t i = 0; i < def.asset->positions.size(); ++i) {
    if (def.asset->positions[i].x() > def.asset->positions[held].x()) held = i;
    if (def.asset->positions[i].x() < def.asset->positions[tied].x()) tied = i;
  }
  const Eigen::Vector3d start = placesOf(*bar)[held];
  const double reached = pull(world, grip, rate, [&] {
    return placesOf(*bar)[held].x() - start.x() > 0.1 * kLength ||
           bar->fragments()[held] != bar->fragments()[tied];
  });
  return outcomeOf(world, reached);
}

// As a user of Bullet would: the impulse that a tick of his rate gives at the force asked.
CaseOutcome runChain(double rate) {
  CaseWorld world(0);
  btRigidBody* before = &world.add(0, gripShape(), {-kGrip / 2, 0, 0}, false);
  std::vector<btFixedConstraint*> fixed;
  for (int i = 0; i < kBoxes; ++i) {
    btRigidBody* box =
        &world.add(kDensity * kGrip * kWidth * kWidth, gripShape(), {kGrip * (i + 0.5), 0, 0}, false);
    auto joint = std::make_unique<btFixedConstraint>(*before, *box, at(kGrip / 2), at(-kGrip / 2));
    joint->setBreakingImpulseThreshold(btScalar(partingForce(kStrength, kWidth * kWidth) / kChosenRate));
    fixed.push_back(joint.get());
    world.join(std::move(joint));
    before = box;
  }
  const double reached = pull(world, *before, rate, [&] {
    return std::ranges::any_of(fixed, [](const btFixedConstraint* joint) { return !joint->isEnabled(); });
  });
  return outcomeOf(world, reached);
}

}  // namespace
}  // namespace strength

double partingForce(double strength, double area) {
  return strength * area;
}

ReportCase strengthCase() {
  using namespace strength;
  ReportCase c{
      .name = "strength",
      .what =
          "A bar of 1 x 0.1 x 0.1 m, 2400 kg/m3, E 30 MPa, f_t 0.33 MPa, pulled at its end until it parts",
      .closedForm = "the force f_t A, 3.3 kN",
      .error = "relative error of the force at which it parts",
      .runs = {},
      .note =
          "The force grows by 3.3 kN in 2 s, at three rates of Bullet's ticks; Bullet's chain of ten "
          "boxes has the breaking impulse that the force asked gives in a tick of 240 Hz"};
  const double standard = DestructionDef{}.substepSafety;
  constexpr double kRates[] = {60, 240, 1000};  // [Hz]
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    for (const double rate : kRates) {
      for (const double part : {1.0, 0.5, 0.25}) {
        const bool isStandard = precision == Precision::Float && part == 1;
        c.runs.push_back({"elements, " + precisionName(precision) + ", " + rounded(rate) + " Hz",
                          "80 elements, substep_safety " + rounded(standard * part), isStandard, part == 1,
                          [=] { return runElements(precision, standard * part, rate); }});
      }
    }
  }
  for (const double rate : kRates)
    c.runs.push_back({"Bullet's btFixedConstraint, " + rounded(rate) + " Hz",
                      "breaking impulse f_t A / 240 Hz", false, true, [=] { return runChain(rate); }});
  return c;
}

}  // namespace rubble::demo
