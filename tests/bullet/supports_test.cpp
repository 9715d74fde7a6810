// Light rigid bodies between elements and what Bullet's own contacts hold them by.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "bullet/bullet_world.h"
#include "rubble/destructible_body.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

// Of 1 m x 0.2 m x 1 m; an element of it weighs 19 kg.
DestructibleBodyDef slabAt(const btVector3& at, const btVector3& velocity) {
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = std::make_shared<const Asset>(gridAsset({.cubes = {5, 1, 5}, .edge = 0.2, .anchored = false}));
  def.material = material("concrete");
  def.transform.setOrigin(at);
  def.velocity = velocity;
  return def;
}

// A crate of 1 kg took 1 kg times its speed of a slab's momentum in each tick, and was pressed into the
// ground by the way of one.
TEST(LightBody, BetweenASlabAndTheGroundStopsTheSlab) {
  BulletWorld w;
  btBoxShape crateShape({btScalar(0.2), btScalar(0.2), btScalar(0.2)});
  const btRigidBody* crate = w.add(1, crateShape, {0, btScalar(0.2), 0});
  const DestructibleBody* slab = w.destruction->addBody(slabAt({0, btScalar(0.51), 0}, {0, -4, 0}));
  btScalar lowest = 1;
  for (int tick = 0; tick < 12; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    lowest = std::min(lowest, crate->getWorldTransform().getOrigin().y());
  }
  EXPECT_GT(lowest, btScalar(0.2 - 0.02));
  // In 0.2 s it would have come 1 m; what is stopped stands on the crate, or goes back up.
  EXPECT_GT(slab->linearMomentum().y(), btScalar(-0.25 * 4 * slab->elementMass()));
  EXPECT_EQ(w.destruction->failure(), "");
}

// The same through a stack of which only the uppermost is near the slab.
TEST(LightBody, OnOthersPassesTheBlowOnToTheGround) {
  BulletWorld w;
  btBoxShape crateShape({btScalar(0.2), btScalar(0.1), btScalar(0.2)});
  btRigidBody* crates[4];
  for (int i = 0; i < 4; ++i) crates[i] = w.add(1, crateShape, {0, btScalar(0.1 + 0.2 * i), 0});
  for (int tick = 0; tick < 10; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
  w.destruction->addBody(slabAt({0, btScalar(0.91), 0}, {0, -4, 0}));
  btScalar lowest = 1;
  for (int tick = 0; tick < 6; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    lowest = std::min(lowest, crates[0]->getWorldTransform().getOrigin().y());
  }
  EXPECT_GT(lowest, btScalar(0.1 - 0.02));
  EXPECT_GT(crates[3]->getWorldTransform().getOrigin().y(), btScalar(0.7 - 0.08));
}

// Bullet gives a box and a plane one point in a tick, about which four of them tipped into the ground by 6
// cm.
TEST(LightBody, OnAPlaneStaysFlatUnderABlockAndAllComesToRest) {
  BulletWorld w;
  btBoxShape crateShape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  std::vector<const btRigidBody*> crates;
  for (const double x : {-0.1, 0.1})
    for (const double z : {-0.1, 0.1})
      crates.push_back(w.add(1, crateShape, {btScalar(x), btScalar(0.1), btScalar(z)}));
  DestructibleBodyDef def = slabAt({btScalar(0.03), btScalar(0.21), btScalar(-0.15)}, {0, -1, 0});
  def.asset = std::make_shared<const Asset>(gridAsset({.cubes = {2, 2, 2}, .edge = 0.2, .anchored = false}));
  const DestructibleBody* block = w.destruction->addBody(def);
  for (int tick = 0; tick < 240 && !(block->isAsleep() && tick > 60); ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    for (const btRigidBody* crate : crates)
      EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.1, 2e-3) << "tick " << tick;
  }
  EXPECT_TRUE(block->isAsleep());
}

}  // namespace
}  // namespace rubble::test
