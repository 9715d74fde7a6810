// What stands, stays.
#include <gtest/gtest.h>

#include "bullet_world.h"

namespace rubble {
namespace {

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
    test::BulletWorld w(def);
    DestructibleBody* wall = w.addWall(material("concrete_soft"));
    std::vector<ElementPose> last(wall->asset()->elementCount());
    wall->poses(last);
    for (int frame = 0; frame < 150; ++frame) {
      w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
      EXPECT_LT(fastest(*wall, last, 1.0 / 60), 1e-3) << "frame " << frame;
    }
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_EQ(wall->isAsleep(), sleep);  // Bullet's rule is two seconds
  }
}

TEST(Standing, SleepingWallWakesWhenABallComes) {
  test::BulletWorld w;
  DestructibleBody* wall = w.addWall(material("concrete_soft"));
  for (int frame = 0; frame < 180; ++frame) w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  ASSERT_TRUE(wall->isAsleep());
  w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.4)})->setLinearVelocity({0, 0, 10});
  for (int frame = 0; frame < 30; ++frame) w.world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
  EXPECT_LT(w.destruction->ledger().energyError, 0.02);
}

}  // namespace
}  // namespace rubble
