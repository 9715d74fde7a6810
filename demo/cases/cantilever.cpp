// A beam tied to the world at one end. The elements are pre-stressed when the beam is added, so what is left
// is the error of their mesh and what the substeps drift by; Bullet's chain settles from straight.
#include <cmath>

#include "demo/cases/beam.h"
#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace cantilever {
namespace {

constexpr std::size_t kCoarse = 80, kMiddle = 270, kFine = 640;  // elements: 2, 3 and 4 through the height

// Fitted to the sag at this rate and 100 iterations, the shortest ticks and the most iterations here.
constexpr double kFittedLinear = 0.38, kFittedRate = 1000;  // [Hz]

// `maySleep`: as every body that sets nothing it sleeps when it is at rest, which takes Bullet two seconds.
CaseOutcome runElements(Precision precision, double substepSafety, std::size_t elements, bool maySleep) {
  constexpr double kTick = 1.0 / 240;              // [s]
  const double simulated = maySleep ? 4.0 : 0.25;  // [s]
  CaseWorld world(kGravity);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox({kLength, kHeight, kHeight}, elements, -Eigen::Vector3d::UnitX());
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  const DestructibleBody* beam = world.destruct(precision, substepSafety, maySleep).addBody(def);
  SagError error;
  for (int tick = 0; tick < int(std::lround(simulated / kTick)); ++tick) {
    world.step(kTick);
    const std::vector<Eigen::Vector3d> places = placesOf(*beam);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector3d& rest = def.asset->positions[i];
      error.add(rest.x() + kLength / 2, rest.y() - places[i].y());
    }
  }
  return world.outcome(error.value());
}

// Twenty boxes, each fixed to the one before; Bullet's constraint knows no modulus and would be rigid.
CaseOutcome runChain(double rate, int iterations) {
  constexpr int kBoxes = 20;
  constexpr double kBox = kLength / kBoxes;
  CaseWorld world(kGravity);
  world.world().getSolverInfo().m_numIterations = iterations;
  const auto shape = [] {
    return std::make_unique<btBoxShape>(toBullet({kBox / 2, kHeight / 2, kHeight / 2}));
  };
  std::vector<btRigidBody*> boxes = {&world.add(0, shape(), {-kBox / 2, 0, 0}, false)};
  btTransform front = btTransform::getIdentity(), back = btTransform::getIdentity();
  front.setOrigin(toBullet({kBox / 2, 0, 0}));
  back.setOrigin(toBullet({-kBox / 2, 0, 0}));
  for (int i = 0; i < kBoxes; ++i) {
    boxes.push_back(
        &world.add(kDensity * kBox * kHeight * kHeight, shape(), {kBox * (i + 0.5), 0, 0}, false));
    world.join(std::make_unique<btFixedConstraint>(*boxes[std::size_t(i)], *boxes.back(), front, back));
  }
  SagError error;
  for (int tick = 0; tick < int(std::lround(kSimulated * rate)); ++tick) {
    world.step(1 / rate);
    if (tick < int(std::lround(kSettling * rate))) continue;
    for (std::size_t i = 1; i < boxes.size(); ++i)
      error.add(kBox * (double(i) - 0.5), -double(boxes[i]->getWorldTransform().getOrigin().y()));
  }
  return world.outcome(error.value());
}

}  // namespace

void SagError::add(double x, double sag) {
  if (x < kOuter) return;
  m_sum += sag - timoshenkoSag(kLength, kHeight, x, kDensity, kModulus, kGravity);
  ++m_count;
}

double SagError::value() const {
  return std::abs(m_sum) / m_count / kLength;
}

}  // namespace cantilever

double timoshenkoSag(double length, double height, double x, double density, double modulus, double gravity) {
  const double load = density * gravity * height * height;  // [N/m]
  const double bending = modulus * std::pow(height, 4) / 12;
  const double shear = 5.0 / 6 * 0.5 * modulus * height * height;
  return load * x * x * (6 * length * length - 4 * length * x + x * x) / (24 * bending) +
         load * (length * x - x * x / 2) / shear;
}

ReportCase cantileverCase() {
  using namespace cantilever;
  ReportCase c{
      .name = "cantilever",
      .what = "A beam of 1 x 0.1 x 0.1 m, 2400 kg/m3, E 300 MPa, tied at one end, under gravity",
      .closedForm = "Timoshenko's sag of the outer tenth, 1.2 % of the length at the tip",
      .error = "error of the mean sag / length",
      .runs = {},
      .note =
          "Bullet's btSoftBody knows no modulus: its stiffness is that of kLST, at most 1, of the "
          "iterations and the tick; kLST 0.38 was fitted to the sag at 1000 Hz and 100 iterations, "
          "where 1 is too stiff; Bullet lowers the stiffness of springs that its tick is too long for"};
  const double standard = DestructionDef{}.substepSafety;
  const auto add = [&](const std::string& method, Precision precision, double safety, std::size_t elements,
                       bool sleep) {
    c.runs.push_back(elementsRun(precision, method, safety, elements,
                                 [=] { return runElements(precision, safety, elements, sleep); }));
    c.runs.back().standard = sleep;
    c.runs.back().quick = elements == kCoarse && safety == standard;
  };
  for (const std::size_t elements : {kCoarse, kMiddle})
    add("asleep at rest", Precision::Float, standard, elements, true);
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    for (const std::size_t elements : {kCoarse, kMiddle, kFine})
      add("awake", precision, standard, elements, false);
    for (const double safety : {standard, standard / 2, standard / 4})
      add("shorter substeps", precision, safety, kCoarse, false);
  }
  const std::vector<CaseRun> chain =
      chainRuns("btFixedConstraint", {10, 30, 100}, {60.0, 240.0, 1000.0}, runChain);
  c.runs.insert(c.runs.end(), chain.begin(), chain.end());
  const std::vector<CaseRun> lattice =
      chainRuns("lattice of springs of 6 degrees", {10}, {240.0, 1000.0, 4000.0}, runLattice);
  c.runs.insert(c.runs.end(), lattice.begin(), lattice.end());
  for (const double linear : {1.0, kFittedLinear}) {
    const std::vector<CaseRun> soft =
        chainRuns("btSoftBody, kLST " + rounded(linear), {10, 100}, {240.0, kFittedRate},
                  [=](double rate, int iterations) { return runSoftBody(rate, iterations, linear); });
    c.runs.insert(c.runs.end(), soft.begin(), soft.end());
  }
  return c;
}

}  // namespace rubble::demo
