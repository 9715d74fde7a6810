// Bodies with cracks that are still one piece, and Bullet's again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

#ifdef RUBBLE_SANITIZED  // the same code at every rate and in every second
constexpr std::initializer_list<int> kSlabRates = {60};
constexpr int kWallTicks = 20;
#else
constexpr std::initializer_list<int> kSlabRates = {60, 240};
constexpr int kWallTicks = 120;
#endif

std::vector<std::uint8_t> springsOf(const DestructibleBody& body) {
  const auto intact = body.springsIntact();
  return {intact.begin(), intact.end()};
}

// Of the distances to the first element; a body that moves without bending has none.
double largestStretch(const std::vector<ElementPose>& from, const std::vector<ElementPose>& to) {
  double most = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    most = std::max(most, std::abs(double((to[i].position - to[0].position).norm()) -
                                   double((from[i].position - from[0].position).norm())));
  return most;
}

// A crate of 10 kg that falls 0.3 m onto a slab cracks it, in one piece. It goes back, sleeps and is struck
// again: with the same cracks, in the same shape, from which nothing pushes it.
TEST(Regime, ACrackedSlabInOnePieceGoesBackWithItsCracks) {
  btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  for (const int rate : kSlabRates) {
    SCOPED_TRACE(rate);
    const btScalar hertz = btScalar(rate);
    BulletWorld w;
    DestructibleBody* slab =
        w.destruction->addBody(blockDef({10, 2, 10}, {btScalar(-0.25), 0, btScalar(-0.25)}));
    const std::vector<ElementPose> lay = posesOf(*slab);
    const btRigidBody* crate = w.add(10, shape, {0, btScalar(0.5), 0});
    ASSERT_LT(ticksUntil(w, *slab, false, hertz, rate), rate);
    ASSERT_LT(ticksUntil(w, *slab, true, hertz, 4 * rate), 4 * rate);
    ASSERT_EQ(w.destruction->counts().fragments, 1u);
    const std::vector<std::uint8_t> cracked = springsOf(*slab);
    const std::uint32_t broken = w.destruction->counts().springsBroken;
    ASSERT_GT(broken, 0u);
    for (int tick = 0; tick < 3 * rate; ++tick) {
      w.world.stepSimulation(1 / hertz, 1, 1 / hertz);
      ASSERT_EQ(w.destruction->lastSubsteps(), 0);
    }
    EXPECT_TRUE(slab->isAsleep());
    EXPECT_FALSE(crate->isActive());
    // The blow shoves it aside: with the crate's aim the way wanders between 0.1 and 1.3 mm.
    EXPECT_LT(largestJump(lay, posesOf(*slab)), 2e-3);
    EXPECT_LT(largestStretch(lay, posesOf(*slab)), 1e-4);

    const double error = w.destruction->ledger().energyError;
    w.destruction->strike(slab);
    const std::vector<ElementPose> before = posesOf(*slab);
    ASSERT_LE(ticksUntil(w, *slab, false, hertz, 2), 2);
    EXPECT_EQ(springsOf(*slab), cracked);
    EXPECT_LT(largestJump(before, posesOf(*slab)), 1e-4);
    ASSERT_LT(ticksUntil(w, *slab, true, hertz, 4 * rate), 4 * rate);
    EXPECT_EQ(springsOf(*slab), cracked);
    EXPECT_LT(std::abs(w.destruction->ledger().linearError), 1e-4);
    EXPECT_LT(w.destruction->ledger().energyError - error, 1e-3);
  }
}

// Cracked by a ball in free fall without gravity, it flies on slowly and turns.
TEST(Regime, BothMomentaSurviveTheWayBackWithCracks) {
  constexpr btScalar kRate = 240;
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* slab = w.destruction->addBody(blockDef({10, 2, 10}, {0, 1, 0}));
  btRigidBody* ball = w.add(btScalar(0.25), w.ballShape, {btScalar(0.05), btScalar(1.25), btScalar(0.25)});
  ball->setLinearVelocity({0, -4, 0});
  ASSERT_LT(ticksUntil(w, *slab, false, kRate, 60), 60);
  ASSERT_LT(ticksUntil(w, *slab, true, kRate, 960), 960);
  ASSERT_EQ(w.destruction->counts().fragments, 1u);
  const std::vector<std::uint8_t> cracked = springsOf(*slab);
  ASSERT_GT(w.destruction->counts().springsBroken, 0u);
  const Momenta first(*slab);
  ASSERT_GT(double(slab->getAngularVelocity().length()), 0.01);
  for (int cycle = 0; cycle < 2; ++cycle) {
    w.destruction->strike(slab);
    ASSERT_EQ(ticksUntil(w, *slab, false, kRate, 2), 1);
    ASSERT_LT(ticksUntil(w, *slab, true, kRate, 960), 960);
    EXPECT_EQ(springsOf(*slab), cracked);
    const Momenta now(*slab);
    EXPECT_LT(double((now.linear - first.linear).length() / first.linear.length()), 1e-5);
    EXPECT_LT(double((now.angular - first.angular).length() / first.angular.length()), 1e-5);
    EXPECT_LT(std::abs(w.destruction->ledger().linearError), 1e-5);
    EXPECT_LT(std::abs(w.destruction->ledger().angularError), 1e-5);
  }
}

// Its foot breaks before its middle: what still holds it is no longer what Bullet's rigid body is held by.
TEST(Regime, AWallThatHasLostAnAnchorStaysElements) {
  BulletWorld w;
  const DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.145)});
  ball->setLinearVelocity({0, 0, btScalar(0.5)});
  ball->setGravity({0, 0, 0});
  for (int tick = 0; tick < kWallTicks; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_EQ(w.destruction->counts().fragments, 1u);
  const auto anchors = wall->springsIntact().subspan(wall->asset()->springs.size());
  EXPECT_LT(std::count(anchors.begin(), anchors.end(), 1), std::ptrdiff_t(anchors.size()));
  EXPECT_FALSE(wall->isWhole());
}

}  // namespace
}  // namespace rubble::test
