// A beam on two round bars, and one that is tied at one end and swings: by elements through its height. The
// sag is taken between what lies over the bars and the middle, so the contacts' own depth is left out.
#include <cmath>

#include "demo/cases/beam.h"
#include "demo/cases/case_world.h"
#include "demo/cases/cases.h"
#include "demo/cases/period.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace supported_beam {
namespace {

using cantilever::kDensity;
using cantilever::kGravity;
using cantilever::kHeight;
using cantilever::kLength;
using cantilever::kModulus;

constexpr std::size_t kCoarse = 80, kMiddle = 270, kFine = 640;  // elements: 2, 3 and 4 through the height
constexpr double kSpan = 0.9, kBar = 0.05;                       // between the bars, their radius [m]
constexpr double kNear = 0.06;    // what is so near to the middle or to a bar is looked at [m]
constexpr double kDamping = 100;  // of the bending [1/s]; its slowest swing has 124 rad/s
constexpr double kSettling = 0.2, kLooking = 0.05;  // [s]
constexpr int kPeriods = 2;                         // so many are timed
constexpr double kSpare = 1.5;                      // of the time that they should take

double sagAt(double x) {
  return supportedSag({kLength, kHeight, kSpan}, x, kDensity, kModulus, kGravity);
}

btRigidBody& addBar(CaseWorld& world, double x) {
  return world.add(0, std::make_unique<btCylinderShapeZ>(toBullet({kBar, kBar, kHeight})),
                   {x, -kHeight / 2 - kBar, 0});
}

// Mean of what the elements sag by less the closed form, of those near the middle or near the bars.
double meanExcess(const Asset& asset, const std::vector<Eigen::Vector3d>& places, bool middle) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d& rest = asset.positions[i];
    const double x = std::abs(rest.x());
    if ((middle ? x : std::abs(x - kSpan / 2)) > kNear) continue;
    sum += rest.y() - places[i].y() - sagAt(x);
    ++count;
  }
  return sum / count;
}

CaseOutcome runSag(Precision precision, double substepSafety, std::size_t elements) {
  constexpr double kTick = 1.0 / 240;  // [s]
  CaseWorld world(kGravity);
  addBar(world, -kSpan / 2).setFriction(1);
  addBar(world, kSpan / 2).setFriction(0);  // it may roll
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox({kLength, kHeight, kHeight}, elements);
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  def.massDamping = kDamping;
  const DestructibleBody* beam = world.destruct(precision, substepSafety).addBody(def);
  const int settling = int(std::lround(kSettling / kTick)), looking = int(std::lround(kLooking / kTick));
  double excess = 0;
  for (int tick = 0; tick < settling + looking; ++tick) {
    world.step(kTick);
    if (tick < settling) continue;
    const std::vector<Eigen::Vector3d> places = placesOf(*beam);
    excess += (meanExcess(*def.asset, places, true) - meanExcess(*def.asset, places, false)) / looking;
  }
  return world.outcome(std::abs(excess) / sagAt(0));
}

// Let go straight, it swings about its sag.
CaseOutcome runPeriod(Precision precision, double substepSafety, std::size_t elements) {
  constexpr double kTick = 1.0 / 480;  // an 84th of the period [s]
  CaseWorld world(0);                  // no pre-stress
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = cookedBox({kLength, kHeight, kHeight}, elements, -Eigen::Vector3d::UnitX());
  def.material.density = kDensity;
  def.material.youngsModulus = kModulus;
  const DestructibleBody* beam = world.destruct(precision, substepSafety).addBody(def);
  world.world().setGravity(toBullet({0, -kGravity, 0}));
  std::vector<std::size_t> outer;
  double still = 0;
  for (std::size_t i = 0; i < def.asset->positions.size(); ++i) {
    const double x = def.asset->positions[i].x() + kLength / 2;
    if (x < cantilever::kOuter) continue;
    outer.push_back(i);
    still += timoshenkoSag(kLength, kHeight, x, kDensity, kModulus, kGravity);
  }
  PeriodTimer timer(still / double(outer.size()), kPeriods);
  const double expected = timoshenkoPeriod(kLength, kHeight, kDensity, kModulus);
  for (int t = 1; t * kTick < kSpare * (kPeriods + 0.25) * expected; ++t) {
    world.step(kTick);
    const std::vector<Eigen::Vector3d> places = placesOf(*beam);
    double sink = 0;
    for (const std::size_t i : outer)
      sink += (def.asset->positions[i].y() - places[i].y()) / double(outer.size());
    if (timer.add(t * kTick, sink)) break;
  }
  return world.outcome(std::abs(timer.period() / expected - 1));
}

}  // namespace
}  // namespace supported_beam

double supportedSag(const SupportedBeam& beam, double x, double density, double modulus, double gravity) {
  const double load = density * gravity * beam.height * beam.height;  // [N/m]
  const double bending = modulus * std::pow(beam.height, 4) / 12;
  const double shear = 5.0 / 6 * 0.5 * modulus * beam.height * beam.height;
  const double half = beam.span / 2, moment = beam.length * (beam.span - beam.length / 2) / 2;
  const auto bent = [&](double s) { return moment * s * s / 2 - std::pow(s, 4) / 12; };
  return load * (bent(half) - bent(x)) / (2 * bending) + load * (half * half - x * x) / (2 * shear);
}

double timoshenkoPeriod(double length, double height, double density, double modulus) {
  // Huang's dimensionless numbers: b of the frequency, r of the rotary inertia, s of the shear.
  const double r2 = std::pow(height / length, 2) / 12, s2 = r2 * 12 / 5;
  const auto equation = [&](double b) {
    const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
    const double alpha = std::sqrt((root - (r2 + s2)) / 2), beta = std::sqrt((root + (r2 + s2)) / 2);
    return 2 + (b * b * (r2 - s2) * (r2 - s2) + 2) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * (r2 + s2) / std::sqrt(1 - b * b * r2 * s2) * std::sinh(b * alpha) * std::sin(b * beta);
  };
  double low = 1, high = 3.6;  // 3.516 without shear and rotary inertia; lower with them
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (equation(middle) > 0 ? low : high) = middle;
  }
  constexpr double kTurn = 6.283185307179586;
  return kTurn / low * length * length * std::sqrt(12 * density / modulus) / height;
}

ReportCase supportedBeamCase() {
  using namespace supported_beam;
  ReportCase c{
      .name = "beam",
      .what =
          "A beam of 1 x 0.1 x 0.1 m, 2400 kg/m3, E 300 MPa, on two bars 0.9 m apart, or tied at one end and "
          "let go straight",
      .closedForm =
          "Timoshenko's sag of its middle below what lies over the bars, 0.81 mm, and first period of the "
          "cantilever, 176 ms (Huang, J. Appl. Mech. 28, 1961)",
      .error = "relative error of the sag, of the mean of two periods",
      .runs = {},
      .note = "80, 270 and 640 elements are 2, 3 and 4 through the height"};
  const double standard = DestructionDef{}.substepSafety;
  for (const bool isSag : {true, false}) {
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      const auto add = [&](const std::string& method, double safety, std::size_t elements, bool isStandard) {
        c.runs.push_back(elementsRun(precision, method, safety, elements, [=] {
          return isSag ? runSag(precision, safety, elements) : runPeriod(precision, safety, elements);
        }));
        CaseRun& run = c.runs.back();
        run.method = (isSag ? "sag, " : "period, ") + run.method;
        run.standard = isStandard;
        run.quick = isStandard || (elements == kCoarse && safety == standard);
      };
      for (const std::size_t elements : {kCoarse, kMiddle, kFine}) {
        if (elements == kFine && precision == Precision::Double) continue;  // long, and tells the same
        add("more elements", standard, elements, elements == kCoarse && precision == Precision::Float);
      }
      for (const double part : {1.0, 0.5, 0.25}) add("shorter substeps", standard * part, kCoarse, false);
    }
  }
  return c;
}

}  // namespace rubble::demo
