// Bodies of elements that have come to rest, and are Bullet's again.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

// Of a packed wall, whose elements' centre of mass is beside the middle of its box, several times.
TEST(Regime, MomentaAndPlaceSurviveTheWayBack) {
  constexpr btScalar kRate = 240;
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = wallDef(Regime::RigidUntilStruck);
  def.anchored = false;
  def.transform = btTransform(btQuaternion({1, 2, 3}, btScalar(0.7)), {0, 2, 0});
  def.velocity = {btScalar(0.06), btScalar(0.03), btScalar(-0.05)};
  def.spin = {btScalar(0.1), btScalar(-0.1), btScalar(0.05)};
  DestructibleBody* wall = w.destruction->addBody(def);
  const Momenta first(*wall);
  for (int cycle = 0; cycle < 3; ++cycle) {
    w.destruction->strike(wall);
    ASSERT_EQ(ticksUntil(w, *wall, false, kRate, 2), 1);
    std::vector<ElementPose> before;
    int ticks = 0;
    for (; ticks < 240 && !wall->isWhole(); ++ticks) {
      before = posesOf(*wall);
      w.world.stepSimulation(1 / kRate, 1, 1 / kRate);
    }
    ASSERT_TRUE(wall->isWhole());
    EXPECT_GE(ticks, 60) << "a quarter of a second";
    // No more than its motion, 0.083 m/s and 0.15 rad/s 0.36 m from its middle, all along the tick.
    EXPECT_LT(largestJump(before, posesOf(*wall)), 0.137 / double(kRate));
    const Momenta now(*wall);
    EXPECT_LT(double((now.linear - first.linear).length() / first.linear.length()), 1e-5);
    EXPECT_LT(double((now.angular - first.angular).length() / first.angular.length()), 1e-5);
    const Ledger& ledger = w.destruction->ledger();
    EXPECT_LT(std::abs(ledger.linearError), 1e-6);
    EXPECT_LT(std::abs(ledger.angularError), 1e-5);
    EXPECT_LT(ledger.energyError, 1e-4);
    for (int tick = 0; tick < 24; ++tick) w.world.stepSimulation(1 / kRate, 1, 1 / kRate);
    ASSERT_TRUE(wall->isWhole());
    ASSERT_EQ(w.destruction->lastSubsteps(), 0);
  }
}

#ifdef RUBBLE_SANITIZED  // the same code at every rate and mass
constexpr std::array kCrateRates = {60}, kCrateMasses = {10};
#else
constexpr std::array kCrateRates = {60, 120, 240, 480};
constexpr std::array kCrateMasses = {1, 10, 50};
#endif

// A crate falls 20 mm onto a slab, whose elements take the blow. It rests on a rigid body of Bullet's again
// soon, once and for all, and both fall asleep.
TEST(Regime, ASlabUnderARestingCrateGoesBackToBulletAndSleeps) {
  btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  for (const int rate : kCrateRates) {
    for (const int mass : kCrateMasses) {
      SCOPED_TRACE(std::to_string(rate) + " Hz, " + std::to_string(mass) + " kg");
      BulletWorld w;
      const DestructibleBody* slab =
          w.destruction->addBody(blockDef({10, 2, 10}, {btScalar(-0.25), 0, btScalar(-0.25)}));
      btRigidBody* crate = w.add(btScalar(mass), shape, {0, btScalar(0.22), 0});
      int changes = 0;
      bool whole = true;
      double jump = 0, errorStep = 0;
      for (int tick = 0; tick < 4 * rate; ++tick) {
        const std::vector<ElementPose> before = posesOf(*slab);
        const double error = w.destruction->ledger().energyError;
        w.world.stepSimulation(btScalar(1) / btScalar(rate), 1, btScalar(1) / btScalar(rate));
        if (slab->isWhole() == whole) continue;
        whole = !whole;
        ++changes;
        if (!whole) continue;
        jump = largestJump(before, posesOf(*slab));
        errorStep = w.destruction->ledger().energyError - error;
      }
      EXPECT_EQ(changes, 2) << "elements once, and back";
      EXPECT_TRUE(slab->isWhole());
      EXPECT_TRUE(slab->isAsleep());
      EXPECT_FALSE(crate->isActive());
      EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.2, 1e-3);
      EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
      EXPECT_LT(jump, 0.1 * slab->asset()->radius);
      EXPECT_LT(errorStep, 1e-3);
    }
  }
}

TEST(Regime, AnAnchoredWallGoesBackToWhereItStood) {
  constexpr btScalar kRate = 240;
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  const std::vector<ElementPose> stood = posesOf(*wall);
  for (int cycle = 0; cycle < 2; ++cycle) {
    btRigidBody* ball = w.add(btScalar(0.3), w.ballShape, {0, btScalar(0.4), btScalar(-0.16)});
    ball->setLinearVelocity({0, 0, btScalar(1.5)});
    ASSERT_LT(ticksUntil(w, *wall, false, kRate, 24), 24);
    ASSERT_LT(ticksUntil(w, *wall, true, kRate, 960), 960);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_LT(largestJump(stood, posesOf(*wall)), 1e-6);
    EXPECT_LT(w.destruction->ledger().linearError, 1e-4);
    EXPECT_LT(w.destruction->ledger().energyError, 0.02);
  }
  for (int tick = 0; tick < 960; ++tick) w.world.stepSimulation(1 / kRate, 1, 1 / kRate);
  EXPECT_TRUE(wall->isWhole());
  EXPECT_TRUE(wall->isAsleep());
}

TEST(Regime, TheApplicationsSettingsComeBackWithTheBody) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 1, 0}));
  block->setFlags(block->getFlags() | BT_DISABLE_WORLD_GRAVITY);
  block->setGravity({0, btScalar(0.01), 0});
  block->setLinearFactor({1, 1, 0});
  block->setAngularFactor({0, 0, 1});
  block->setFriction(btScalar(0.123));
  block->setActivationState(DISABLE_DEACTIVATION);
  w.destruction->strike(block);
  ASSERT_EQ(ticksUntil(w, *block, false, 60, 2), 1);
  ASSERT_LT(ticksUntil(w, *block, true, 60, 60), 60);
  EXPECT_EQ(block->getGravity(), btVector3(0, btScalar(0.01), 0));
  EXPECT_EQ(block->getLinearFactor(), btVector3(1, 1, 0));
  EXPECT_EQ(block->getAngularFactor(), btVector3(0, 0, 1));
  EXPECT_EQ(block->getFriction(), btScalar(0.123));
  EXPECT_EQ(block->getActivationState(), DISABLE_DEACTIVATION);
}

// In whatever tick of a call it goes back, it falls as it should in the others of the same call.
TEST(Regime, GravityActsInTheTicksAfterTheWayBack) {
  constexpr double kGravity = 0.01;  // it stays slow enough for a second [m/s^2]
  BulletWorld w;
  w.world.setGravity({0, btScalar(-kGravity), 0});
  DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 1, 0}));
  w.destruction->strike(block);
  for (int frame = 0; frame < 20; ++frame) w.world.stepSimulation(btScalar(1) / 30, 8, btScalar(1) / 240);
  ASSERT_TRUE(block->isWhole());
  // Half a substep, for the elements' velocities are of half steps; a tick lost would be 4e-5 m/s.
  EXPECT_NEAR(double(block->getLinearVelocity().y()), -kGravity * 20 / 30, 2e-6);
}

// Whether the world's is switched off for it or not: 0.01 m/s^2 all the time, as elements and before and
// after.
TEST(Regime, GravityOfItsOwnActsInEveryState) {
  constexpr double kOwn = 0.01, kRate = 240;
  for (const bool isSwitchedOff : {true, false}) {
    BulletWorld w;
    w.world.setGravity({0, btScalar(-9.81), 0});
    DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 5, 0}));
    if (isSwitchedOff) block->setFlags(block->getFlags() | BT_DISABLE_WORLD_GRAVITY);
    block->setGravity({0, btScalar(kOwn), 0});
    int ticks = 0;
    const auto step = [&] {
      w.world.stepSimulation(btScalar(1 / kRate), 1, btScalar(1 / kRate));
      EXPECT_NEAR(double(block->linearMomentum().y()) / block->elementMass(), kOwn * ++ticks / kRate, 1e-5);
    };
    for (int tick = 0; tick < 10; ++tick) step();
    w.destruction->strike(block);
    step();
    ASSERT_FALSE(block->isWhole());
    while (!block->isWhole() && ticks < 240) step();
    ASSERT_TRUE(block->isWhole());
    for (int tick = 0; tick < 10; ++tick) step();
    EXPECT_EQ(block->getGravity(), btVector3(0, btScalar(kOwn), 0));
  }
}

TEST(Regime, WhatBrokeStaysElements) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.145)});
  ball->setLinearVelocity({0, 0, 3});
  for (int tick = 0; tick < 60; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
  EXPECT_FALSE(wall->isWhole());
}

TEST(Regime, TheWayBackIsTheSameInEveryRun) {
  const auto run = [] {
    BulletWorld w;
    btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
    w.destruction->addBody(blockDef({10, 2, 10}, {btScalar(-0.25), 0, btScalar(-0.25)}));
    btRigidBody* crate = w.add(10, shape, {0, btScalar(0.22), 0});
    for (int tick = 0; tick < 60; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
    return std::pair(w.destruction->hash(), crate->getWorldTransform().getOrigin().y());
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace rubble::test
