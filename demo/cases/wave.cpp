// A bar hung by its top, without stress at first: weight is switched on. All of it falls freely until the
// news of the tied end comes by. The tip sinks past its static place at L / c, comes back at 3 L / c, and
// sinks past it again at 5 L / c: a period is four ways of the wave.
#include <cmath>

#include "demo/cases/bar.h"
#include "demo/cases/cases.h"
#include "demo/cases/period.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace wave {
namespace {

constexpr int kPeriods = 4;     // so many are timed
constexpr double kSpare = 1.5;  // of the time that they and the first quarter should take

// Not finite: there were too few crossings.
template <class Outer>
double periodOf(CaseWorld& world, double tick, Outer outer) {
  const double expected = 4 * waveSeconds(bar::kLength, bar::kDensity, bar::kModulus);
  PeriodTimer timer(hungSink(bar::kLength, outer().depth, bar::kDensity, bar::kModulus, bar::kGravity),
                    kPeriods);
  for (int t = 1; t * tick < kSpare * (kPeriods + 0.25) * expected; ++t) {
    world.step(tick);
    if (timer.add(t * tick, outer().sink)) break;
  }
  return timer.period();
}

double errorOf(double period) {
  return std::abs(period / (4 * waveSeconds(bar::kLength, bar::kDensity, bar::kModulus)) - 1);
}

CaseOutcome runElements(Precision precision, double substepSafety, std::size_t elements) {
  constexpr double kTick = 1.0 / 2400;  // an 86th of the period [s]
  CaseWorld world(0);                   // no pre-stress
  const DestructibleBody* body = world.destruct(precision, substepSafety).addBody(bar::elements(elements));
  world.world().setGravity(toBullet({0, -bar::kGravity, 0}));
  const double period = periodOf(world, kTick, [&] { return bar::outerOf(*body); });
  return world.outcome(errorOf(period));
}

CaseOutcome runChain(double rate, int iterations) {
  CaseWorld world(bar::kGravity);
  const bar::Chain chain(world, iterations);
  const double period = periodOf(world, 1 / rate, [&] { return chain.outer(); });
  return world.outcome(errorOf(period));
}

}  // namespace
}  // namespace wave

double waveSeconds(double length, double density, double modulus) {
  return length / std::sqrt(modulus / density);
}

ReportCase waveCase() {
  using namespace wave;
  ReportCase c{
      .name = "wave",
      .what = "A bar of 1 x 0.1 x 0.1 m, 2400 kg/m3, E 30 MPa, tied at its top, let go without stress",
      .closedForm = "the period of the wave along it, 4 L / c, c = sqrt(E / rho), 36 ms",
      .error = "relative error of the mean of four periods",
      .runs = {}};
  const double standard = DestructionDef{}.substepSafety;
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    const auto add = [&](const std::string& method, double safety, std::size_t elements, bool isStandard) {
      c.runs.push_back(elementsRun(precision, method, safety, elements,
                                   [=] { return runElements(precision, safety, elements); }));
      c.runs.back().standard = isStandard;
      c.runs.back().quick = isStandard || elements == bar::kCoarse;
    };
    for (const std::size_t elements : {bar::kCoarse, bar::kMiddle, bar::kFine})
      add("more elements", standard, elements, elements == bar::kCoarse && precision == Precision::Float);
    for (const double part : {1.0, 0.5, 0.25, 0.1})
      add("shorter substeps", standard * part, bar::kCoarse, false);
  }
  const std::vector<CaseRun> chain =
      chainRuns("springs of 6 degrees", {10, 100}, {1000.0, 4000.0, 16000.0}, runChain);
  c.runs.insert(c.runs.end(), chain.begin(), chain.end());
  return c;
}

}  // namespace rubble::demo
