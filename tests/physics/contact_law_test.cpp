// The contact force (paper 3.1.2) against its closed form.
#include "edem/contact.h"

#include "physics/bodies.h"

namespace rubble::test {
namespace {

using edem::ContactForce;
using edem::ContactLaw;
using edem::Vec3;

template <class Real>
class Contact : public ::testing::Test {
 protected:
  static constexpr Real kOverlap = Real(0.01);
  static constexpr ContactLaw<Real> kLaw{Real(1e5), Real(200), Real(0.5)};
  // Units in the last place of forces of about 1e3 N.
  static constexpr double kTolerance = 1e4 * double(std::numeric_limits<Real>::epsilon());
  Vec3<Real> normal{0, 1, 0};
};
TYPED_TEST_SUITE(Contact, Scalars);

TYPED_TEST(Contact, PushesByStiffnessTimesOverlap) {
  using Real = TypeParam;
  const auto f = edem::contactForce<Real>(this->kLaw, this->kOverlap, this->normal, Vec3<Real>::Zero());
  EXPECT_NEAR(double(f.elastic.y()), 1000, this->kTolerance);
  EXPECT_EQ(f.damping.norm(), Real(0));
}

TYPED_TEST(Contact, DashpotAddsWhileClosingAndTakesWhileOpening) {
  using Real = TypeParam;
  const auto closing =
      edem::contactForce<Real>(this->kLaw, this->kOverlap, this->normal, Vec3<Real>(0, -2, 0));
  EXPECT_NEAR(double(closing.damping.y()), 400, this->kTolerance);
  const auto opening =
      edem::contactForce<Real>(this->kLaw, this->kOverlap, this->normal, Vec3<Real>(0, 2, 0));
  EXPECT_NEAR(double(opening.damping.y()), -400, this->kTolerance);
}

TYPED_TEST(Contact, NeverPulls) {
  using Real = TypeParam;
  const auto f = edem::contactForce<Real>(this->kLaw, this->kOverlap, this->normal, Vec3<Real>(0, 50, 0));
  EXPECT_EQ((f.elastic + f.damping).y(), Real(0));
}

TYPED_TEST(Contact, FrictionIsTheDashpotUpToCoulombsLimit) {
  using Real = TypeParam;
  const auto slow = edem::contactForce<Real>(this->kLaw, this->kOverlap, this->normal, Vec3<Real>(1, 0, 0));
  EXPECT_NEAR(double(slow.damping.x()), -200, this->kTolerance);
  const auto fast = edem::contactForce<Real>(this->kLaw, this->kOverlap, this->normal, Vec3<Real>(30, 0, 40));
  EXPECT_NEAR(double(fast.damping.x()), -0.5 * 1000 * 0.6, this->kTolerance);
  EXPECT_NEAR(double(fast.damping.z()), -0.5 * 1000 * 0.8, this->kTolerance);
}

TYPED_TEST(Contact, FrictionIsUnlimitedInThePaper) {
  using Real = TypeParam;
  ContactLaw<Real> law = this->kLaw;
  law.friction = -1;
  const auto f = edem::contactForce<Real>(law, this->kOverlap, this->normal, Vec3<Real>(50, 0, 0));
  EXPECT_NEAR(double(f.damping.x()), -10000, 10 * this->kTolerance);
}

TEST(Dashpot, RatioOneIsCritical) {
  // x'' + (c/m) x' + (k/m) x = 0 has a double root at c = 2 sqrt(k m).
  const double k = 300, m = 12, c = edem::dashpot(1.0, k, m);
  EXPECT_NEAR(c * c - 4 * k * m, 0, 1e-9);
}

}  // namespace
}  // namespace rubble::test
