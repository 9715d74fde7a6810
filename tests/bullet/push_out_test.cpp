// Whole bodies leave what they are in no faster than they came.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bullet/push_out.h"
#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

// A block that nothing here breaks, a bit more than Bullet's contacts look ahead (2 cm) above the ground:
// it comes into it within the first tick. No gravity.
struct Lander : BulletWorld {
  Lander(double gap, double speed, double restitution) {
    world.setGravity({0, 0, 0});
    ground->setRestitution(btScalar(restitution));
    ground->setFriction(0);
    DestructibleBodyDef def = blockDef({2, 2, 2}, {0, btScalar(gap), 0});
    def.material.restitution = restitution;
    def.material.tensileStrength *= 20;
    def.material.compressiveStrength *= 20;
    def.velocity = {0, btScalar(-speed), 0};
    block = destruction->addBody(def);
    kineticAtFirst = kinetic();
  }
  double kinetic() const {
    const btVector3 spin = block->getAngularVelocity();
    const btVector3 momentum = block->getInvInertiaTensorWorld().inverse() * spin;
    return 0.5 * double(block->getLinearVelocity().length2() / block->getInvMass() + spin.dot(momentum));
  }
  void step(double dt) {
    world.stepSimulation(btScalar(dt), 1, btScalar(dt));
    fastest = std::max(fastest, double(block->getLinearVelocity().length()));
    EXPECT_TRUE(block->isWhole());
    for (const btManifoldPoint* point : points())
      EXPECT_EQ(point->m_contactPointFlags & BT_CONTACT_FLAG_HAS_CONTACT_ERP, 0) << "as Bullet made it";
  }
  std::vector<btManifoldPoint*> points() {
    std::vector<btManifoldPoint*> list;
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
      btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
      for (int p = 0; p < manifold.getNumContacts(); ++p) list.push_back(&manifold.getContactPoint(p));
    }
    return list;
  }

  DestructibleBody* block = nullptr;
  double fastest = 0, kineticAtFirst = 0;  // [m/s], [J]
};

// 0.6 m/s for 1/15 s are 0.04 m, 0.019 m of them in the ground; a fifth of that in 1/240 s would be 0.91 m/s.
TEST(PushOut, AShortTickAfterALongOneThrowsNothing) {
  Lander w(0.021, 0.6, 0);
  w.step(1.0 / 15);
  ASSERT_LT(double(w.block->getWorldTransform().getOrigin().y()), 0.05 - 0.015) << "is in the ground";
  for (int tick = 0; tick < 240; ++tick) w.step(1.0 / 240);
  EXPECT_LT(w.fastest, 0.6 * (1 + 1e-3));
  // A fifth of the depth in the long tick's time, 0.2 * 0.019 m * 15 Hz, by however many corners: no faster
  // than a fifth of the speed that it came with, and out of the ground.
  EXPECT_NEAR(double(w.block->getLinearVelocity().y()), 0.06, 0.02);
}

// What bounces fully keeps its speed: a fifth of 0.018 m in 1/60 s would be 0.21 m/s on top.
TEST(PushOut, WhatBouncesIsNotPushedAsWell) {
  Lander w(0.0205, 2.3, 1);
  for (int tick = 0; tick < 10; ++tick) w.step(1.0 / 60);
  EXPECT_GT(double(w.block->getLinearVelocity().y()), 0.5);
  EXPECT_NEAR(w.kinetic(), w.kineticAtFirst, 0.01 * w.kineticAtFirst);
}

// A bar at 45 degrees that slides under its foot, u = (-0.6, -1) v: with K = ((2.5, -1.5), (-1.5, 2.5)) / m
// along normal and sliding (a thin bar) a full bounce that sticks would add 0.225 m v^2 / 2 to 1.36 m v^2 /
// 2; at a restitution of 0.8 it adds nothing.
TEST(PushOut, FrictionAndRestitutionTogetherThrowNothing) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  w.ground->setRestitution(1);
  w.ground->setFriction(10);
  DestructibleBodyDef def = blockDef({8, 1, 1}, {0, btScalar(0.06), 0});
  def.transform.setRotation(btQuaternion(btVector3(0, 0, 1), btScalar(-0.785398)));
  def.transform.setOrigin({0, btScalar(0.2), 0});
  def.material.restitution = 1;
  def.material.tensileStrength *= 1000;
  def.material.compressiveStrength *= 1000;
  def.velocity = {btScalar(-0.6), btScalar(-1), 0};
  const DestructibleBody* bar = w.destruction->addBody(def);
  const auto kinetic = [&] {
    const btVector3 spin = bar->getAngularVelocity();
    const btVector3 momentum = bar->getInvInertiaTensorWorld().inverse() * spin;
    return 0.5 * double(bar->getLinearVelocity().length2() / bar->getInvMass() + spin.dot(momentum));
  };
  const double before = kinetic();
  for (int tick = 0; tick < 240 && bar->getAngularVelocity().length() < btScalar(0.1); ++tick)
    w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  ASSERT_TRUE(bar->isWhole());
  EXPECT_GT(double(bar->getAngularVelocity().length()), 1.0) << "it has hit";
  EXPECT_NEAR(kinetic(), before, 0.02 * before);
}

// On equal ticks what does not bounce is Bullet's alone, and what the application said of a point is its.
TEST(PushOut, LeavesTheRestToBullet) {
  Lander w(-0.01, 0, 0);
  w.step(1.0 / 60);
  bullet::PushOut push;
  const auto pushed = [&] {
    int count = 0;
    for (const btManifoldPoint* point : w.points())
      count += bool(point->m_contactPointFlags & BT_CONTACT_FLAG_HAS_CONTACT_ERP);
    return count;
  };
  ASSERT_GT(w.points().size(), 0u);
  push.limit(w.world, 1.0 / 60);
  EXPECT_EQ(pushed(), 0);
  w.points().front()->m_contactERP = btScalar(0.7);
  w.points().front()->m_contactPointFlags |= BT_CONTACT_FLAG_HAS_CONTACT_ERP;
  push.limit(w.world, 1.0 / 240);
  EXPECT_EQ(pushed(), int(w.points().size()));
  EXPECT_EQ(w.points().front()->m_contactERP, btScalar(0.7));
  push.restore(w.dispatcher);
  EXPECT_EQ(pushed(), 1);
  EXPECT_EQ(w.points().front()->m_contactERP, btScalar(0.7));
}

TEST(PushOut, AStackStandsOnTicksThatJump) {
  BulletWorld w;
  std::vector<DestructibleBody*> blocks;
  for (int i = 0; i < 4; ++i)
    blocks.push_back(w.destruction->addBody(blockDef({2, 2, 2}, {0, btScalar(0.1 * i), 0})));
  const auto heightOf = [&](int i) {
    return double(blocks[std::size_t(i)]->getWorldTransform().getOrigin().y());
  };
  for (int tick = 0; tick < 60; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  std::vector<double> before;
  for (int i = 0; i < 4; ++i) before.push_back(heightOf(i));
  for (int tick = 0; tick < 300; ++tick) {
    const btScalar dt = btScalar(tick % 3 == 0 ? 1.0 / 60 : 1.0 / 240);
    w.world.stepSimulation(dt, 1, dt);
  }
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(blocks[std::size_t(i)]->isWhole()) << i;
    EXPECT_NEAR(heightOf(i), before[std::size_t(i)], 0.002) << i;
  }
}

}  // namespace
}  // namespace rubble::test
