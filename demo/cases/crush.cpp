// A packed cube, pulled and crushed: in the testing machine, whose plates its end cells follow, and between a
// table and a plate of Bullet's that a growing force presses down.
#include <algorithm>
#include <cmath>

#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"
#include "demo/processor_time.h"
#include "edem/testing_machine.h"

namespace rubble::demo {
namespace crush {
namespace {

constexpr double kEdge = 0.3;        // of the cube [m]
constexpr double kThick = 0.1;       // of the plates [m]
constexpr double kPlateMass = 20;    // [kg]
constexpr double kRamp = 0.5;        // until the force asked [s]
constexpr double kMostForce = 2;     // of the force asked: it held
constexpr double kMostStrain = 0.2;  // it has given way; it is crushed at 0.07

// Of the material that sets nothing, concrete_soft.
struct MachineTest {
  double Material::*asked;
  edem::Plates plates;
  double side;  // 1 pulls, -1 presses
};

CaseOutcome runMachine(const MachineTest& test, std::size_t elements) {
  const Material material;
  const double strain = material.*test.asked / material.youngsModulus;
  // Sound crosses the cube a hundred times until it is strained so far.
  const double speed = 0.01 * strain * std::sqrt(material.youngsModulus / material.density);
  edem::TestingMachine machine({cookedBox(Eigen::Vector3d::Constant(kEdge), elements), kEdge}, material,
                               test.plates, test.side * speed);
  const double start = processorTime();
  double peak = 0;
  while (std::abs(machine.strain()) < 6 * strain) {
    const double stress = test.side * machine.read();
    peak = std::max(peak, stress);
    if (machine.broken() > 0 && stress < 0.5 * peak) break;
  }
  return {std::abs(peak / (material.*test.asked) - 1), processorTime() - start,
          std::abs(machine.strain()) * kEdge / speed};
}

CaseOutcome runPlates(double substepSafety, std::size_t elements, double rate) {
  CaseWorld world(0);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox(Eigen::Vector3d::Constant(kEdge), elements);
  world.destruct(Precision::Float, substepSafety, false, true).addBody(def);
  const auto shape = [] { return std::make_unique<btBoxShape>(toBullet({kEdge, kThick / 2, kEdge})); };
  world.add(0, shape(), {0, -(kEdge + kThick) / 2, 0}).setFriction(0);
  btRigidBody& plate = world.add(kPlateMass, shape(), {0, (kEdge + kThick) / 2, 0});
  plate.setFriction(0);
  plate.setLinearFactor({0, 1, 0});
  plate.setAngularFactor({0, 0, 0});
  const double asked = partingForce(def.material.compressiveStrength, kEdge * kEdge);
  for (int tick = 0; tick < int(kMostForce * kRamp * rate); ++tick) {
    const double share = (tick + 0.5) / (kRamp * rate);
    plate.applyCentralForce(toBullet({0, -share * asked, 0}));
    world.step(1 / rate);
    const double sunk = (kEdge + kThick) / 2 - double(plate.getWorldTransform().getOrigin().y());
    if (sunk > kMostStrain * kEdge) return world.outcome(std::abs(share - 1));
  }
  return world.outcome(HUGE_VAL);
}

}  // namespace
}  // namespace crush

ReportCase crushCase() {
  using namespace crush;
  ReportCase c{
      .name = "crush",
      .what = "A packed cube of 0.3 m of concrete_soft, f_t 0.2 MPa, f_c 2 MPa, is pulled and crushed",
      .closedForm = "f_t A and f_c A, 18 and 180 kN",
      .error = "relative error of the greatest force that it carries",
      .runs = {},
      .note =
          "Glued and greased: plates of the testing machine, which the end cells follow, in double; "
          "Bullet's plates touch, without friction of their own, and are pressed together by a force "
          "that grows to f_c A in 0.5 s"};
  const auto addMachine = [&](const std::string& method, const MachineTest& test) {
    for (const std::size_t elements : {64, 216, 512})
      c.runs.push_back({method, std::to_string(elements) + " elements", false, elements == 64,
                        [=] { return runMachine(test, elements); }});
  };
  addMachine("pulled, glued", {&Material::tensileStrength, edem::Plates::Glued, 1});
  addMachine("crushed, glued", {&Material::compressiveStrength, edem::Plates::Glued, -1});
  addMachine("crushed, greased", {&Material::compressiveStrength, edem::Plates::Greased, -1});
  const double standard = DestructionDef{}.substepSafety;
  for (const double rate : {60.0, 240.0})
    for (const std::size_t elements : {64, 216})
      c.runs.push_back({"crushed, Bullet's plates, " + rounded(rate) + " Hz",
                        std::to_string(elements) + " elements", elements == 216, elements == 64,
                        [=] { return runPlates(standard, elements, rate); }});
  return c;
}

}  // namespace rubble::demo
