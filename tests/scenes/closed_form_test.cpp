// The cases of `rubble report` beside those in case_report_test.cpp: their closed forms, found in another
// way, and what the default settings keep of them. No time is asserted.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
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

double errorOf(const demo::ReportCase& c, const std::string& method, const std::string& setting) {
  for (const demo::CaseRun& run : c.runs)
    if (run.method == method && run.setting == setting) return run.run().error;
  ADD_FAILURE() << c.name << " has no " << method << ", " << setting;
  return HUGE_VAL;
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

// The curvature M / (E I) of what the cut holds, load and one bar, summed twice from the middle; shear adds
// V / (k G A).
TEST(BeamCase, TheSagIsTheSumOfTheCurvatures) {
  constexpr demo::SupportedBeam kBeam{1.3, 0.1, 1.1};
  constexpr double kDensity = 2000, kModulus = 1e8, kGravity = 9;
  constexpr int kSlices = 100000;
  const double area = kBeam.height * kBeam.height, q = kDensity * kGravity * area;
  const double bending = kModulus * area * area / 12, shear = 5.0 / 6 * kModulus / 2 * area;
  double slope = 0, rise = 0;
  const double step = kBeam.span / 2 / kSlices;
  for (int i = 0; i < kSlices; ++i) {
    const double x = step * (i + 0.5), beyond = kBeam.length / 2 - x;
    const double moment = q * kBeam.length / 2 * (kBeam.span / 2 - x) - q * beyond * beyond / 2;
    slope += step * moment / bending;
    rise += step * (slope - step * moment / bending / 2 + q * x / shear);
  }
  EXPECT_NEAR(demo::supportedSag(kBeam, 0, kDensity, kModulus, kGravity), rise, 1e-8 * rise);
  EXPECT_NEAR(demo::supportedSag(kBeam, kBeam.span / 2, kDensity, kModulus, kGravity), 0, 1e-15);
}

// The slowest swing of a row of rigid discs from a wall, each with its mass and moment of inertia, on springs
// of k G A / a across and E I / a in bending: their eigenvalues.
TEST(BeamCase, ThePeriodIsThatOfARowOfDiscsOnSprings) {
  constexpr double kLength = 1.3, kHeight = 0.2, kDensity = 2000, kModulus = 1e8;
  constexpr int kDiscs = 200;
  const double a = kLength / kDiscs, area = kHeight * kHeight, second = area * area / 12;
  const double across = 5.0 / 6 * kModulus / 2 * area / a, bending = kModulus * second / a;
  // Places and slopes of the discs; the first is in the wall, the last is half a disc.
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * kDiscs + 2, 2 * kDiscs + 2);
  Eigen::VectorXd mass(2 * kDiscs + 2);
  for (int i = 0; i <= kDiscs; ++i) {
    const double share = i == kDiscs ? 0.5 : 1;
    mass[2 * i] = share * kDensity * area * a;
    mass[2 * i + 1] = share * kDensity * second * a;
    if (i == kDiscs) break;
    const Eigen::Vector4d gap(-1, -a / 2, 1, -a / 2), turn(0, -1, 0, 1);
    stiffness.block<4, 4>(2 * i, 2 * i) += across * gap * gap.transpose() + bending * turn * turn.transpose();
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      stiffness.bottomRightCorner(2 * kDiscs, 2 * kDiscs), mass.tail(2 * kDiscs).asDiagonal().toDenseMatrix(),
      Eigen::EigenvaluesOnly);
  const double period = 2 * kPi / std::sqrt(modes.eigenvalues()[0]);
  EXPECT_NEAR(demo::timoshenkoPeriod(kLength, kHeight, kDensity, kModulus), period, 1e-4 * period);
}

// Two elements through the height: 2 % is what is promised of the stiffness of a packing.
TEST(BeamCase, TheElementsKeepTheClosedForms) {
  EXPECT_EQ(expectStandardErrorsBelow(demo::supportedBeamCase(), 0.02), 2);
}

// Friction that keeps a sphere from slipping: it slows the way and turns the sphere.
TEST(RollCase, TheSphereIsTurnedByTheFrictionThatSlowsIt) {
  constexpr double kGravity = 9, kSlope = 0.3;
  // a = g sin - f / m, and a / R = f R / (2 / 5 m R^2): the friction per kilogram by bisection.
  double low = 0, high = kGravity;
  for (int i = 0; i < 60; ++i) {
    const double friction = (low + high) / 2;
    const double forward = kGravity * std::sin(kSlope) - friction, turning = friction / 0.4;
    (turning < forward ? low : high) = friction;
  }
  EXPECT_NEAR(demo::rollingAcceleration(kGravity, kSlope), kGravity * std::sin(kSlope) - low, 1e-12);
}

// A soft slab yields and holds the ball a little; ten times stiffer, less than a fifth of that is left.
TEST(RollCase, TheSlabKeepsTheClosedFormAsItIsStiff) {
  const demo::ReportCase c = demo::rollCase();
  EXPECT_EQ(expectStandardErrorsBelow(c, 0.005), 1);
  EXPECT_LT(errorOf(c, "elements, float, E 300 MPa", "240 Hz, substep_safety 0.9"), 0.001);
}

// As tests/physics/strength_long_test.cpp and plate_strength_test.cpp have it, of the smallest cube alone:
// 0.9 to 1 of the strength in the machine, more than 0.6 between plates.
TEST(CrushCase, TheCubeIsAsStrongAsItsMaterialSays) {
  int tried = 0;
  for (const demo::CaseRun& run : demo::crushCase().runs) {
    if (run.setting != "64 elements") continue;
    const bool isPlates = run.method.find("Bullet's") != std::string::npos;
    EXPECT_LT(run.run().error, isPlates ? 0.4 : 0.1) << run.method;
    ++tried;
  }
  EXPECT_EQ(tried, 5);
}

// dv/dt = g (1 - (v / v_t)^2), step by step.
TEST(DebrisFallCase, TheWayIsThatOfQuadraticDrag) {
  constexpr double kTerminal = 20, kGravity = 9, kSeconds = 3, kStep = 1e-6;
  double speed = 0, way = 0;
  for (int i = 0; i < int(kSeconds / kStep); ++i) {
    const double before = speed;
    speed += kStep * kGravity * (1 - std::pow(speed / kTerminal, 2));
    way += kStep * (before + speed) / 2;
  }
  EXPECT_NEAR(demo::fallenWay(kTerminal, kGravity, kSeconds), way, 1e-5 * way);
}

// Weight is drag, 6 pi mu R v.
TEST(DebrisFallCase, TheGrainsWeightIsItsDrag) {
  constexpr double kRadius = 3e-6, kDensity = 2000, kGravity = 9, kViscosity = 2e-5;
  const double weight = 4.0 / 3 * kPi * std::pow(kRadius, 3) * kDensity * kGravity;
  const double speed = demo::stokesSpeed(kRadius, kDensity, kGravity, kViscosity);
  EXPECT_NEAR(6 * kPi * kViscosity * kRadius * speed, weight, 1e-12 * weight);
}

// Of the law of drag itself, whose correction is 1e-4 at the grain's Reynolds number.
TEST(DebrisFallCase, DebrisKeepTheClosedForms) {
  EXPECT_EQ(expectStandardErrorsBelow(demo::debrisFallCase(), 5e-4), 2);
}

// 0.7 of the mass is finer than R with (R / R_max)^m = 0.7. A hundred elements of 14 pieces are 1400 steps of
// the share, which is as far off as a few of them; the paper's sizes are as far off as can be.
TEST(SieveCase, SizesByMassFollowTheLawAndThePapersDoNot) {
  EXPECT_NEAR(demo::sievedShare(2, 0.5, 2 * 0.7 * 0.7), 0.7, 1e-12);
  EXPECT_EQ(demo::sievedShare(2, 0.5, 3), 1);
  const demo::ReportCase c = demo::sieveCase();
  EXPECT_EQ(expectStandardErrorsBelow(c, 5.0 / 1400), 1);
  EXPECT_GT(errorOf(c, "by number, the paper's", "100 elements"), 0.9);
}

// du/dt = nu laplace(u) in small steps, the Laplacian of sin(k x) cos(k z) by differences.
TEST(DustTaylorGreenCase, TheDecayIsThatOfDiffusion) {
  constexpr double kViscosity = 0.01, kWave = 3, kSeconds = 2, kX = 0.2, kZ = 0.3, kGap = 1e-3;
  const auto u = [](double x, double z) { return std::sin(kWave * x) * std::cos(kWave * z); };
  const double laplacian =
      (u(kX + kGap, kZ) + u(kX - kGap, kZ) + u(kX, kZ + kGap) + u(kX, kZ - kGap) - 4 * u(kX, kZ)) /
      (kGap * kGap);
  constexpr int kSteps = 100000;
  double left = 1;
  for (int i = 0; i < kSteps; ++i) left += kSeconds / kSteps * kViscosity * left * laplacian / u(kX, kZ);
  EXPECT_NEAR(demo::taylorGreenDecay(kViscosity, kWave, kSeconds), left, 1e-5);
}

// Of the energy of the flow: of the ball, and of the dipole outside, |u| = v (R / r)^3 sqrt(1 + 3 cos^2) / 2,
// summed over shells, where the mean of cos^2 is 1 / 3. Weight over twice the energy over v^2.
TEST(DustPlumeCase, TheAddedMassIsThatOfTheDipoleOutside) {
  constexpr int kShells = 1'000'000;
  double outside = 0;  // twice its energy, over the mass of the ball times v^2
  for (int i = 0; i < kShells; ++i) {
    const double s = (i + 0.5) / kShells;  // R / r, from 0 at infinity to 1
    outside += 3 / std::pow(s, 4) * std::pow(s, 6) * (1 + 3.0 / 3) / 4 / kShells;
  }
  EXPECT_NEAR(demo::ladenBallAcceleration(0.1, 10), 0.1 * 10 / (1 + outside), 1e-6);
}

// A factor of 5 a cycle, as in tests/unit/dust/pressure_test.cpp, three of them. The ball is 6.4 cells in
// radius, of which half a cell of its rim is blurred: a tenth.
TEST(DustCases, TheGridKeepsTheClosedForms) {
  EXPECT_EQ(expectStandardErrorsBelow(demo::dustDivergenceCase(), 1.0 / 125), 2);
  EXPECT_EQ(expectStandardErrorsBelow(demo::dustPlumeCase(), 0.1), 1);
}

// The splitting of a step is of first order: a quarter of the step, a quarter of the loss.
TEST(DustTaylorGreenCase, TheVortexLosesEnergyAsTheStepIsLong) {
  const demo::ReportCase c = demo::dustTaylorGreenCase();
  const double slow = errorOf(c, "energy, confinement 0, 60 Hz", "32^3 cells"),
               quick = errorOf(c, "energy, confinement 0, 240 Hz", "32^3 cells");
  EXPECT_LT(slow, 0.06);
  EXPECT_NEAR(quick / slow, 0.25, 0.1);
}

// The bell is 1.2, 2.4 and 4.8 cells wide: half the cell leaves at most half of the error once it is
// resolved.
TEST(DustRotationCase, TheDustsErrorFallsWithTheCell) {
  const demo::ReportCase c = demo::dustRotationCase();
  const double coarse = errorOf(c, "dust, 60 Hz", "32^3 cells"),
               fine = errorOf(c, "dust, 60 Hz", "64^3 cells");
  EXPECT_LT(fine, coarse / 2);
  EXPECT_LT(fine, 0.2);
}

}  // namespace
}  // namespace rubble::test
