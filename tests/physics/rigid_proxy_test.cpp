// Rigid bodies against a wall of one element's thickness.
#include "physics/bodies.h"

namespace rubble::test {
namespace {

template <class Real>
class RigidBody : public ::testing::Test {
 protected:
  // Throws a ball along -z at a wall about z = 0.1 whose springs do not break; returns the ball as it is 0.2
  // s later.
  edem::RigidProxy throwAtWall(double radius, double mass, double speed) {
    edem::BodyDef def = block({5, 5, 1}, true);
    def.material.contactDamping = 0.3;
    const auto solver = makeSolver<Real>(false);
    solver->addBody(def, kNoGravity);
    std::vector<edem::RigidProxy> proxies = {
        ball(radius, mass, {0.5, 0.5, 0.2 + radius + 0.3}, {0, 0, -speed})};
    for (int t = 0; t < 12; ++t) {
      solver->tick(kFrame, kNoGravity, proxies);
      touched = touched || !proxies[0].touched.empty();
    }
    EXPECT_EQ(solver->failure(), "");
    return proxies[0];
  }
  bool touched = false;
};
TYPED_TEST_SUITE(RigidBody, Scalars);

TYPED_TEST(RigidBody, FastBallDoesNotTunnel) {
  for (const double mass : {0.02, 1.0, 10.0}) {
    this->touched = false;
    const edem::RigidProxy after = this->throwAtWall(0.1, mass, 100);
    EXPECT_TRUE(this->touched) << mass;
    EXPECT_GT(after.position.z(), 0.2) << mass;
    EXPECT_GT(after.velocity.z(), 0) << mass;
  }
}

TYPED_TEST(RigidBody, FastSmallBallDoesNotTunnel) {
  const edem::RigidProxy after = this->throwAtWall(0.02, 0.1, 100);
  EXPECT_TRUE(this->touched);
  EXPECT_GT(after.position.z(), 0.2);
}

TYPED_TEST(RigidBody, LightBallGainsNoEnergy) {
  // From 1e-5 element masses up: an element has 19.2 kg.
  for (const double mass : {2e-4, 2e-3, 2e-2, 0.2, 2.0}) {
    this->touched = false;
    const edem::RigidProxy after = this->throwAtWall(0.1, mass, 5);
    EXPECT_TRUE(this->touched) << mass;
    EXPECT_LE(after.velocity.norm(), 5.0 * (1 + 1e-6)) << mass;
  }
}

TYPED_TEST(RigidBody, BlockRestsOnThePlane) {
  edem::BodyDef def = block({2, 2, 2});
  def.material.springDamping = 0.1;
  def.material.contactDamping = 0.5;
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {fixedPlane()};
  for (int t = 0; t < 180; ++t) solver->tick(kFrame, kGravity, proxies);
  EXPECT_LT(solver->maxSpeed(id), 1e-3);
  // Each lower element carries two: overlap = 2 m g / k_cn, k_cn = E h / 2.
  const double overlap = 2 * 19.2 * 9.81 / (0.5 * 30e6 * 0.2);
  EXPECT_NEAR(solver->position(id, 0).y(), 0.1 - overlap, 0.02 * overlap);
}

// The host's float of a place is wrong by `rounding`. What is light beside an element is where the substeps
// left it while the host tells no more than that; all else is where the host has it.
TYPED_TEST(RigidBody, RoundingDoesNotMoveALightBody) {
  constexpr double kRounding = 1e-5, kElement = 19.2;
  const auto placeAfter = [&](double mass, double shift, bool placed) {
    const auto solver = makeSolver<TypeParam>();
    solver->addBody(block({1, 1, 1}), kNoGravity);
    std::vector<edem::RigidProxy> proxies = {ball(0.1, mass, {175, 1, 0}, kNoGravity)};
    proxies[0].key = 1;
    proxies[0].rounding = float(kRounding);
    solver->tick(kFrame, kNoGravity, proxies);
    proxies[0].position.x() += shift;
    proxies[0].placed = placed;
    solver->tick(kFrame, kNoGravity, proxies);
    return proxies[0].position.x() - 175;
  };
  EXPECT_EQ(placeAfter(4e-6 * kElement, 0.5 * kRounding, false), 0);
  EXPECT_NEAR(placeAfter(4e-6 * kElement, 1.5 * kRounding, false), 1.5 * kRounding, 1e-9)
      << "moved by the host";
  EXPECT_NEAR(placeAfter(4e-6 * kElement, 0.5 * kRounding, true), 0.5 * kRounding, 1e-9)
      << "by the application";
  EXPECT_NEAR(placeAfter(0.01 * kElement, 0.5 * kRounding, false), 0.5 * kRounding, 1e-9) << "heavier";
}

}  // namespace
}  // namespace rubble::test
