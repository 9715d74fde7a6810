// The cases of `rubble report` beside those in case_report_test.cpp: their closed forms, found in another
// way, and what the default settings keep of them. No time is asserted.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "demo/cases/cases.h"

namespace rubble::test {
namespace {

constexpr double kPi = std::numbers::pi;

// Runs all default settings of a case; returns how many there are.
int expectStandardErrorsBelow(const demo::ReportCase& c, double tolerance) {
  int tried = 0;
  for (const demo::CaseRun& run : c.runs) {
    if (!run.standard) continue;
    EXPECT_LT(run.run().error, tolerance) << c.name << ", " << run.method;
    ++tried;
  }
  return tried;
}

// Of the stress that grows evenly from -s to s through the section, s y / (a / 2), the moments of its slices.
TEST(SpringBreakCase, TheMomentIsThatOfStressesThatGrowEvenlyThroughTheSection) {
  constexpr double kStrength = 3e5, kEdge = 0.3;
  constexpr int kSlices = 100000;
  double moment = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double y = kEdge * ((i + 0.5) / kSlices - 0.5);
    moment += kStrength * y / (kEdge / 2) * y * kEdge * kEdge / kSlices;
  }
  EXPECT_NEAR(demo::squareBendingMoment(kStrength, kEdge), moment, 1e-8 * moment);
}

// Saint-Venant's series for a square bar: torque over k1 G theta a^4 and largest stress k G theta a, with
// k = 1 - 8 / pi^2 sum 1 / (n^2 cosh(n pi / 2)) and k1 = (1 - 192 / pi^5 sum tanh(n pi / 2) / n^5) / 3 over
// odd n. The book prints three digits of k1 / k.
TEST(SpringBreakCase, TheTorqueIsThatOfSaintVenantsSeries) {
  double stress = 1, torque = 1;
  for (int n = 1; n < 100; n += 2) {
    stress -= 8 / (kPi * kPi) / (n * n * std::cosh(n * kPi / 2));
    torque -= 192 / std::pow(kPi, 5) * std::tanh(n * kPi / 2) / std::pow(n, 5);
  }
  constexpr double kStrength = 3e5, kEdge = 0.3;
  const double expected = torque / 3 / stress * kStrength * std::pow(kEdge, 3);
  EXPECT_NEAR(demo::squareTwistingMoment(kStrength, kEdge), expected, 2e-3 * expected);
}

// Mohr's circles of the pull f_t and of the pressure f_c, of radii f_t / 2 and f_c / 2 about those points of
// the axis, have one common tangent; c is its height at no pressure.
TEST(SpringBreakCase, TheCohesionIsTheTangentOfMohrsCircles) {
  constexpr double kTension = 2, kPressure = 18;
  const double sine = (kPressure - kTension) / (kPressure + kTension), cosine = std::sqrt(1 - sine * sine);
  // At distance f_t / 2 from the centre (f_t / 2, 0): c cos = f_t / 2 + f_t / 2 sin.
  EXPECT_NEAR(demo::cohesionOf(kTension, kPressure), kTension / 2 * (1 + sine) / cosine, 1e-12);
}

// A tick of 240 Hz is 0.4 % of the load, and each is a step that the cubes answer with twice of it at most.
TEST(SpringBreakCase, TheElementsKeepTheClosedFormsAndABreakingImpulseOnlyThatOfItsOwnLoadAndTick) {
  const demo::ReportCase c = demo::springBreakCase();
  EXPECT_EQ(expectStandardErrorsBelow(c, 3.0 / 240), 4);
  int bullet = 0;
  for (const demo::CaseRun& run : c.runs) {
    if (run.method.find("Bullet's") == std::string::npos) continue;
    const double error = run.run().error;
    if (run.method.starts_with("pull") && run.setting == "240 Hz") {
      EXPECT_LT(error, 1.0 / 240);
    } else {
      EXPECT_GT(error, 0.3) << run.method << ", " << run.setting;
    }
    ++bullet;
  }
  EXPECT_EQ(bullet, 12);
}

}  // namespace
}  // namespace rubble::test
