// When couplers of whole bodies are in Bullet's world, by which blows are seen before its solver.
#include <gtest/gtest.h>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

constexpr btScalar kSixtieth = btScalar(1) / 60;

void tickOn(BulletWorld& w, int ticks) {
  for (int t = 0; t < ticks; ++t) w.world.stepSimulation(kSixtieth, 1, kSixtieth);
}

btRigidBody* shootAt(BulletWorld& w, const btVector3& from, const btVector3& velocity) {
  btRigidBody* ball = w.add(10, w.ballShape, from);
  ball->setLinearVelocity(velocity);
  ball->setGravity({0, 0, 0});
  return ball;
}

// Bullet sorts all constraints of its world in each tick, and looks through them for each island.
TEST(Couplers, AreNotInTheWorldOfWhatOnlyLies) {
  BulletWorld w;
  std::vector<DestructibleBody*> blocks;
  for (int i = 0; i < 5; ++i)
    blocks.push_back(w.destruction->addBody(blockDef({4, 4, 4}, {btScalar(i), btScalar(0.001), 0})));
  for (DestructibleBody* block : blocks) block->setActivationState(DISABLE_DEACTIVATION);
  tickOn(w, 120);
  EXPECT_EQ(w.world.getNumConstraints(), 0);
  EXPECT_TRUE(blocks[2]->isActive());
  shootAt(w, {2 + btScalar(0.1), btScalar(0.1), -1}, {0, 0, 10});
  tickOn(w, 12);
  EXPECT_FALSE(blocks[2]->isWhole());
  EXPECT_EQ(w.world.getNumConstraints(), 1);
  w.destruction->removeBody(blocks[2]);
  EXPECT_EQ(w.world.getNumConstraints(), 0);
}

TEST(Couplers, AreThereInTheTickOfTheBlow) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  tickOn(w, 200);
  ASSERT_TRUE(wall->isAsleep());
  // Added between two ticks, and through the wall in the next.
  shootAt(w, {0, btScalar(0.25), btScalar(-0.6)}, {0, 0, 100});
  tickOn(w, 1);
  EXPECT_FALSE(wall->isWhole());
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
}

// Bullet asks a body only while it ignores somebody.
TEST(Couplers, ComeAlsoOnceTheApplicationHasTakenBackWhatItIgnores) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  btRigidBody* ball = shootAt(w, {0, btScalar(0.25), -1}, {0, 0, 10});
  wall->setIgnoreCollisionCheck(ball, true);
  tickOn(w, 12);  // goes through it
  EXPECT_TRUE(wall->isWhole());
  wall->setIgnoreCollisionCheck(ball, false);
  ball->setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(0.25), -1}));
  tickOn(w, 12);
  EXPECT_FALSE(wall->isWhole());
}

// As Bullet's manual shows for near callbacks.
void passOn(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

TEST(Couplers, ComeUnderANearCallbackOfTheApplications) {
  BulletWorld w;
  static_cast<btCollisionDispatcher*>(w.world.getDispatcher())->setNearCallback(passOn);
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  shootAt(w, {0, btScalar(0.25), -1}, {0, 0, 10});
  tickOn(w, 12);
  EXPECT_FALSE(wall->isWhole());
}

}  // namespace
}  // namespace rubble::test
