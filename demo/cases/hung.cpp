// A bar hung by its top under its own weight. The elements are pre-stressed when it is added; the chain of
// springs starts without stress and is judged by its mean after a second.
#include <cmath>

#include "demo/cases/bar.h"
#include "demo/cases/cases.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace hung {
namespace {

// Mean over the outer tenth is linear in the depth but for the tenth's own curvature, 1e-3 of the whole.
double errorOf(const bar::Outer& outer) {
  const auto sink = [](double depth) {
    return hungSink(bar::kLength, depth, bar::kDensity, bar::kModulus, bar::kGravity);
  };
  return std::abs(outer.sink - sink(outer.depth)) / sink(bar::kLength);
}

// `maySleep`: as every body that sets nothing it sleeps when it is at rest, which takes Bullet two seconds.
CaseOutcome runElements(Precision precision, double substepSafety, std::size_t elements, bool maySleep) {
  constexpr double kTick = 1.0 / 240;              // [s]
  const double simulated = maySleep ? 4.0 : 0.25;  // [s]
  CaseWorld world(bar::kGravity);
  const DestructibleBody* body =
      world.destruct(precision, substepSafety, maySleep).addBody(bar::elements(elements));
  const int ticks = int(std::lround(simulated / kTick));
  bar::Outer mean{0, 0};
  for (int tick = 0; tick < ticks; ++tick) {
    world.step(kTick);
    const bar::Outer now = bar::outerOf(*body);
    mean.depth += now.depth / ticks;
    mean.sink += now.sink / ticks;
  }
  return world.outcome(errorOf(mean));
}

CaseOutcome runChain(double rate, int iterations) {
  constexpr double kSettling = 1, kSimulated = 4;  // [s]
  CaseWorld world(bar::kGravity);
  const bar::Chain chain(world, iterations, 0.99);  // it comes to rest: damping bears no weight
  const int settling = int(std::lround(kSettling * rate)), ticks = int(std::lround(kSimulated * rate));
  bar::Outer mean{0, 0};
  for (int tick = 0; tick < ticks; ++tick) {
    world.step(1 / rate);
    if (tick < settling) continue;
    mean.depth += chain.outer().depth / (ticks - settling);
    mean.sink += chain.outer().sink / (ticks - settling);
  }
  return world.outcome(errorOf(mean));
}

}  // namespace
}  // namespace hung

double hungSink(double length, double depth, double density, double modulus, double gravity) {
  return density * gravity / modulus * (length * depth - depth * depth / 2);
}

ReportCase hungCase() {
  using namespace hung;
  ReportCase c{.name = "hung",
               .what = "A bar of 1 x 0.1 x 0.1 m, 2400 kg/m3, E 30 MPa, hung by its top under its own weight",
               .closedForm = "rho g (L y - y^2 / 2) / E in the outer tenth; 0.39 mm at the tip",
               .error = "error of the mean sinking / that of the tip",
               .runs = {}};
  const double standard = DestructionDef{}.substepSafety;
  const auto add = [&](const std::string& method, Precision precision, double safety, std::size_t elements,
                       bool sleep) {
    c.runs.push_back(elementsRun(precision, method, safety, elements,
                                 [=] { return runElements(precision, safety, elements, sleep); }));
    c.runs.back().standard = sleep;
    c.runs.back().quick = elements == bar::kCoarse && safety == standard;
  };
  add("asleep at rest", Precision::Float, standard, bar::kCoarse, true);
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    for (const std::size_t elements : {bar::kCoarse, bar::kMiddle, bar::kFine})
      add("awake", precision, standard, elements, false);
    for (const double safety : {standard, standard / 2, standard / 4})
      add("shorter substeps", precision, safety, bar::kCoarse, false);
  }
  const std::vector<CaseRun> chain =
      chainRuns("springs of 6 degrees", {10, 100}, {1000.0, 4000.0, 16000.0}, runChain);
  c.runs.insert(c.runs.end(), chain.begin(), chain.end());
  return c;
}

}  // namespace rubble::demo
