// What elements get of a rigid body, by their own motion, against what it gives by its own.
#include <algorithm>

#include "physics/bodies.h"

namespace rubble::test {
namespace {

// Of one proxy, over all ticks: energy out of nothing.
struct Made {
  void add(const edem::RigidProxy& proxy) {
    total += proxy.surplus;
    most = std::max(most, total);
  }
  double total = 0, most = 0;  // [J]
};

template <class Real>
class EnergyBorder : public ::testing::Test {
 protected:
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>(false);
};
TYPED_TEST_SUITE(EnergyBorder, Scalars);

TYPED_TEST(EnergyBorder, StaticBallThatGrowsMakesAllThatTheElementsHave) {
  this->solver = makeSolver<TypeParam>(false, 0.3);
  this->solver->addBody(block({2, 2, 2}), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {ball(0.3, 1, {0.2, 0.71, 0.2}, {0, 0, 0})};
  proxies[0].inverseMass = 0;
  Made made;
  for (int t = 0; t < 80; ++t) {
    if (t < 25) proxies[0].parts[0].size.array() += 0.002;
    this->solver->tick(kFrame, kNoGravity, proxies);
    made.add(proxies[0]);
    EXPECT_EQ(proxies[0].given, 0);
  }
  const edem::Books& b = this->solver->books();
  const double has = b.kinetic + b.elastic;
  EXPECT_GT(has, 0.1);
  EXPECT_EQ(proxies[0].contactWeight, 0) << "they have left";
  EXPECT_EQ(b.bullet.work.done(), 0) << "what it is booked to have given";
  EXPECT_NEAR(made.total, has, 5e-3 * has);  // finite rotations
}

TYPED_TEST(EnergyBorder, StaticPlaneOnlyTakes) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    this->solver = makeSolver<TypeParam>(false);
    edem::BodyDef def = block({2, 2, 2});
    def.velocity = Eigen::Vector3d(1, -3, 0);
    def.transform.translation() = Eigen::Vector3d(0, 0.05, 0);
    def.material.friction = 0.6;
    def.material.restitution = restitution;
    this->solver->addBody(def, kNoGravity);
    std::vector<edem::RigidProxy> proxies = {fixedPlane()};
    proxies[0].restitution = 1;
    Made made;
    for (int t = 0; t < 30; ++t) {
      this->solver->tick(kFrame, kNoGravity, proxies);
      made.add(proxies[0]);
    }
    EXPECT_GT(this->solver->books().bullet.linear.norm(), 100) << "it has met the plane";
    // The leapfrog's balance at a blow, as of the books of elements and contacts together.
    EXPECT_LT(made.most, 1e-3 * this->solver->books().initialEnergy) << restitution;
  }
}

TYPED_TEST(EnergyBorder, BallGivesWhatItLosesAndElementsGetNoMore) {
  edem::BodyDef def = block({3, 3, 1}, true);
  def.material.contactDamping = 0.3;
  def.material.friction = 0.6;
  this->solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {ball(0.25, 100, {0.3, 0.32, 0.5}, {0, 1, -5})};
  const double had = 0.5 * 100 * 26;
  double given = 0;
  Made made;
  for (int t = 0; t < 30; ++t) {
    this->solver->tick(kFrame, kNoGravity, proxies);
    given += proxies[0].given;
    made.add(proxies[0]);
  }
  const edem::RigidProxy& b = proxies[0];
  const double has = 0.5 * (100 * b.velocity.squaredNorm() + b.spin.squaredNorm() / b.inverseInertia.x());
  EXPECT_GT(b.velocity.z(), 0) << "it has bounced";
  EXPECT_NEAR(given, had - has, 1e-9 * had);
  EXPECT_LT(made.most, 2e-3 * had);
}

// A ball and one element on a spring of the contact: leapfrog keeps the sum of an instant exactly, but for
// the share of the steps in which the two meet and part. By the velocities of half a step later it swings by
// omega h / 2 of what the ball gives, and h is 0.35 / omega.
TYPED_TEST(EnergyBorder, EnergiesOfOneInstantAreConstantInABlow) {
  this->solver->addBody(block({1, 1, 1}), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {ball(0.25, 20, {0.1, 0.1, 0.4501}, {0, 0, -5})};
  proxies[0].restitution = 1;
  const double had = 0.5 * 20 * 25;
  double worst = 0, swing = 0;
  int pressed = 0;
  for (int t = 0; t < 40; ++t) {
    this->solver->tick(5e-4, kNoGravity, proxies);
    const edem::Books& b = this->solver->books();
    const double has = b.kinetic + b.elastic + 0.5 * 20 * proxies[0].velocity.squaredNorm();
    pressed += proxies[0].contactWeight > 0;
    swing = std::max(swing, std::abs(has - had));
    worst = std::max(worst, std::abs(has + proxies[0].givenNext - had));
  }
  EXPECT_GT(pressed, 5);
  EXPECT_EQ(proxies[0].givenNext, 0) << "they have parted";
  EXPECT_GT(swing, 0.03 * had);
  EXPECT_LT(worst, 0.005 * had);
}

}  // namespace
}  // namespace rubble::test
