// The contact force (paper 3.1.2) against its closed form.
#include "edem/contact.h"

#include <Eigen/Eigenvalues>

#include "edem/stable_step.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

using edem::ContactLaw;
using edem::ContactLoad;
using edem::ContactMemory;
using edem::ContactMotion;
using edem::Vec3;

template <class Real>
class Contact : public ::testing::Test {
 protected:
  static constexpr Real kOverlap = Real(0.01);
  // Units in the last place of forces of about 1e3 N.
  static constexpr double kTolerance = 1e4 * double(std::numeric_limits<Real>::epsilon());

  // Load at kOverlap, with the normal along y.
  ContactLoad<Real> load(const Vec3<Real>& approach, Real moved = 0,
                         const Vec3<Real>& spin = Vec3<Real>::Zero()) {
    return edem::contactLoad<Real>(law, {kOverlap, 1, 0, {0, 1, 0}, approach, spin}, moved, memory);
  }
  ContactLaw<Real> law{Real(1e5), Real(200), 0, Real(200), 0, 0, 0, Real(0.5), 0};
  ContactMemory<Real> memory;
};
TYPED_TEST_SUITE(Contact, Scalars);

TYPED_TEST(Contact, PushesByStiffnessTimesOverlap) {
  const auto f = this->load({0, 0, 0});
  EXPECT_NEAR(double(f.elastic.y()), 1000, this->kTolerance);
  EXPECT_NEAR(double(f.energy), 5, this->kTolerance);
  EXPECT_EQ(double(f.damping.norm()), 0);
}

TYPED_TEST(Contact, DashpotAddsWhileClosingAndTakesWhileOpening) {
  EXPECT_NEAR(double(this->load({0, -2, 0}).damping.y()), 400, this->kTolerance);
  EXPECT_NEAR(double(this->load({0, 2, 0}).damping.y()), -400, this->kTolerance);
}

TYPED_TEST(Contact, NeverPulls) {
  const auto f = this->load({0, 50, 0});
  EXPECT_EQ(double((f.elastic + f.damping).y()), 0);
}

TYPED_TEST(Contact, FrictionOfADashpotEndsAtCoulombsLimit) {
  EXPECT_NEAR(double(this->load({1, 0, 0}).damping.x()), -200, this->kTolerance);
  const auto fast = this->load({30, 0, 40});
  EXPECT_NEAR(double(fast.damping.x()), -0.5 * 1000 * 0.6, this->kTolerance);
  EXPECT_NEAR(double(fast.damping.z()), -0.5 * 1000 * 0.8, this->kTolerance);
}

TYPED_TEST(Contact, FrictionIsUnlimitedInThePaper) {
  this->law.friction = -1;
  EXPECT_NEAR(double(this->load({50, 0, 0}).damping.x()), -10000, 10 * this->kTolerance);
}

TYPED_TEST(Contact, WhatSlidIsHeldByASpring) {
  using Real = TypeParam;
  this->law.tangential = 2e4;
  this->law.tangentialDamping = 0;
  for (int n = 0; n < 10; ++n) this->load({1, 0, 0}, Real(1e-3));
  const auto f = this->load({0, 0, 0});
  EXPECT_NEAR(double(f.elastic.x()), -2e4 * 10e-3, this->kTolerance);
  EXPECT_NEAR(double(f.energy), 5 + 0.5 * 2e4 * 1e-4, this->kTolerance);
}

TYPED_TEST(Contact, SpringGivesWayAtCoulombsLimit) {
  using Real = TypeParam;
  this->law.tangential = 2e4;
  double slipped = 0;
  for (int n = 0; n < 100; ++n) slipped += double(this->load({3, 0, 4}, Real(1e-3)).slipped);
  const auto f = this->load({0, 0, 0});
  EXPECT_NEAR(double(f.elastic.x()), -500 * 0.6, this->kTolerance);
  EXPECT_NEAR(double(f.elastic.z()), -500 * 0.8, this->kTolerance);
  // The spring holds 500 N at 25 mm; half a metre less that slipped under 500 N.
  EXPECT_NEAR(slipped, 500 * (0.5 - 0.025), 100 * this->kTolerance);
}

TYPED_TEST(Contact, AskedAgainItSaysTheSame) {
  using Real = TypeParam;
  this->law.tangential = 2e4;
  this->law.rolling = 10;
  this->law.rollingDamping = Real(0.1);
  this->law.rollingReach = Real(1e-3);
  const Vec3<Real> approach(3, Real(-0.1), 4), spin(1, 2, 3);
  for (int n = 0; n < 30; ++n) this->load(approach, Real(1e-3), spin);
  const auto first = this->load(approach, 0, spin), again = this->load(approach, 0, spin);
  EXPECT_NEAR(double((first.elastic - again.elastic).norm()), 0, this->kTolerance);
  EXPECT_NEAR(double((first.damping - again.damping).norm()), 0, this->kTolerance);
  EXPECT_NEAR(double((first.elasticTorque - again.elasticTorque).norm()), 0, this->kTolerance);
}

TYPED_TEST(Contact, RollingIsResistedUpToItsReach) {
  using Real = TypeParam;
  this->law.rolling = 10;
  this->law.rollingReach = Real(2e-3);
  this->load({0, 0, 0}, Real(1e-2), {0, 0, 1});
  EXPECT_NEAR(double(this->load({0, 0, 0}).elasticTorque.z()), -0.1, this->kTolerance);
  for (int n = 0; n < 100; ++n) this->load({0, 0, 0}, Real(1e-2), {0, 0, 1});
  EXPECT_NEAR(double(this->load({0, 0, 0}).elasticTorque.z()), -2e-3 * 1000, this->kTolerance);
}

TYPED_TEST(Contact, SlipTurnsWithTheTangentPlane) {
  using Real = TypeParam;
  this->law.tangential = 2e4;
  this->load({1, 0, 0}, Real(1e-2));
  const Vec3<Real> tilted(Real(0.6), Real(0.8), 0);
  const auto f = edem::contactLoad<Real>(
      this->law, {this->kOverlap, 1, 0, tilted, Vec3<Real>::Zero(), Vec3<Real>::Zero()}, 0, this->memory);
  const Vec3<Real> slide = f.elastic - Real(1000) * tilted;
  EXPECT_NEAR(double(slide.dot(tilted)), 0, this->kTolerance);
  EXPECT_NEAR(double(slide.norm()), 200, this->kTolerance);
}

edem::ContactSide side() {
  return {3e5, 1 / 12.0, 0.05 * 0.05 / 0.012, 0.05, 0.3, 0.6, 0.5, 0, true};
}

TEST(ContactLaw, DashpotsAreOfTheirRatio) {
  // x'' + c (1/m1 + 1/m2) x' + k (1/m1 + 1/m2) x = 0 decays by exp(-2 pi xi / sqrt(1 - xi^2)) a period; here
  // integrated.
  const ContactLaw<double> law = edem::contactLaw(side(), side());
  const double reduced = 6, step = 1e-6;
  double x = 1, v = 0, last = 1;
  for (int crossings = 0; crossings < 2;) {
    v -= step * (law.stiffness * x + law.damping * v) / reduced;
    const double next = x + step * v;
    crossings += (next > 0) != (x > 0);
    x = next;
  }
  for (double before = v; before * v > 0 && v != 0;) {
    before = v;
    v -= step * (law.stiffness * x + law.damping * v) / reduced;
    x += step * v;
    last = x;
  }
  EXPECT_NEAR(last, std::exp(-2 * 3.14159265358979 * 0.3 / std::sqrt(1 - 0.09)), 1e-3);
}

TEST(ContactLaw, SpringsOfUnlikeSidesStandInSeries) {
  edem::ContactSide soft = side();
  soft.stiffness = 1e5;
  // Each side is a spring of twice the stiffness: 1 / (1 / 6e5 + 1 / 2e5).
  EXPECT_NEAR(edem::contactLaw(side(), soft).stiffness, 1.5e5, 1e-6);
  EXPECT_NEAR(edem::contactLaw(side(), side()).stiffness, 3e5, 1e-6);
}

TEST(ContactLaw, MemoryNeedsNoShorterStep) {
  // A ball (I = 0.4 m r^2) on a plane: modes of sliding and rolling by M^-1 K, in units of k_n / m.
  edem::ContactSide ball{1, 1, 2.5, 1, 0, 0.6, 0.5, 0, true};
  edem::ContactSide plane = ball;
  plane.mobility = plane.turning = plane.radius = 0;
  const ContactLaw<double> law = edem::contactLaw(ball, plane);
  Eigen::Matrix2d k;
  k << law.tangential, law.tangential, law.tangential, law.tangential + law.rolling;
  const Eigen::Matrix2d m = Eigen::Vector2d(1, 0.4).asDiagonal();
  const double fastest =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(k, m).eigenvalues().maxCoeff();
  EXPECT_LT(fastest, law.stiffness);
  EXPECT_LE(edem::contactRates(law, 1, 2.5, 1).stiffness, law.stiffness * (1 + 1e-12));
}

TEST(ContactLaw, ThePaperRemembersNothing) {
  edem::ContactSide paper = side();
  paper.memory = false;
  paper.friction = -1;
  const ContactLaw<double> law = edem::contactLaw(paper, paper);
  EXPECT_EQ(law.tangential, 0);
  EXPECT_EQ(law.rolling, 0);
  EXPECT_EQ(law.tangentialDamping, law.damping);
  EXPECT_LT(law.friction, 0);
}

}  // namespace
}  // namespace rubble::test
