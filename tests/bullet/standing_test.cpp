// What stands, stays.
#include <gtest/gtest.h>

#include "bullet/bullet_world.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

#ifdef RUBBLE_SANITIZED  // the same code in every second: until Bullet's own two of rest are over takes a
                         // minute
constexpr bool kWaitsForSleep = false;
#else
constexpr bool kWaitsForSleep = true;
#endif

double fastest(const DestructibleBody& body, std::vector<ElementPose>& last, double dt) {
  std::vector<ElementPose> now(last.size());
  body.poses(now);
  double speed = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    speed = std::max(speed, double((now[i].position - last[i].position).norm()) / dt);
  last = now;
  return speed;
}

TEST(Standing, AnchoredWallIsStillFromTheFirstTick) {
  for (const bool sleep : {false, true}) {
    DestructionDef def;
    def.sleep = sleep;
    BulletWorld w(def);
    DestructibleBody* wall = w.addWall(material("concrete_soft"));
    std::vector<ElementPose> last(wall->asset()->elementCount());
    wall->poses(last);
    for (int frame = 0; frame < (kWaitsForSleep ? 150 : 15); ++frame) {
      w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
      EXPECT_LT(fastest(*wall, last, 1.0 / 60), 1e-3) << "frame " << frame;
    }
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_EQ(wall->isAsleep(), sleep && kWaitsForSleep);
  }
}

TEST(Standing, CubeRestsOnACrateThatSlept) {
  BulletWorld w;
  btBoxShape crateShape({btScalar(0.5), btScalar(0.25), btScalar(0.5)});
  btRigidBody* crate = w.add(50, crateShape, {0, btScalar(0.25), 0});
  for (int frame = 0; frame < 180; ++frame) w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  ASSERT_FALSE(crate->isActive());
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = smallWall();
  def.material = material("concrete_soft");
  def.anchored = false;
  def.transform = btTransform(btQuaternion({1, 0, 0}, SIMD_HALF_PI), {0, btScalar(0.545), btScalar(-0.25)});
  const DestructibleBody* slab = w.destruction->addBody(def);
  double impulse = 0;
  int frames = 0;
  for (; frames < 90; ++frames) {
    w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
    for (const ContactImpulse& c : w.destruction->takeEvents().contacts)
      if (frames >= 60 && c.other == crate) impulse += double(c.impulse);
  }
  // The crate bears its weight.
  EXPECT_NEAR(impulse, slab->elementMass() * 9.81 * 30 / 60, 0.02 * impulse);
  EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.25, 0.01);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  if (!kWaitsForSleep) return;
  // It comes to rest after a drop of 5 mm: ringing is gone in a second, Bullet's own rule takes two.
  for (; frames < 300 && !slab->isAsleep(); ++frames)
    w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  EXPECT_LT(frames, 300);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
}

TEST(Standing, MomentumScaleDoesNotGrowWithTimeAtRest) {
  DestructionDef definition;
  definition.sleep = false;
  BulletWorld w(definition);
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = std::make_shared<const Asset>(
      gridAsset({.cubes = {3, 2, 2}, .edge = 0.1, .origin = {0, 0.001, 0}, .anchored = false}));
  def.material = material("concrete_soft");
  def.anchored = false;
  const DestructibleBody* block = w.destruction->addBody(def);
  const auto stand = [&](int seconds) {
    for (int tick = 0; tick < 60 * seconds; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
    return w.destruction->ledger().momentumScale;
  };
  const double settled = stand(2);
  EXPECT_GT(settled, block->elementMass() * 9.81 / 60) << "it holds at least a tick of its weight";
  EXPECT_EQ(stand(10), settled);
  EXPECT_LT(w.destruction->ledger().linearError, 1e-4);
}

TEST(Standing, SleepingWallWakesWhenABallComes) {
  BulletWorld w;
  DestructibleBody* wall = w.addWall(material("concrete_soft"));
  for (int frame = 0; frame < 180; ++frame) w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  ASSERT_TRUE(wall->isAsleep());
  w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.4)})->setLinearVelocity({0, 0, 10});
  for (int frame = 0; frame < 30; ++frame) w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
  EXPECT_LT(w.destruction->ledger().energyError, 0.02);
}

}  // namespace
}  // namespace rubble::test
