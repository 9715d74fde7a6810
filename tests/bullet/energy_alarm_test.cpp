// A rigid body that elements get energy of out of nothing is named, once; others are not.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bullet/bullet_world.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

// Of 0.3 x 0.1 x 0.3 m, 1 mm above `height`, its middle above the origin.
void addSlab(BulletWorld& w, double height) {
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = std::make_shared<const Asset>(gridAsset(
      {.cubes = {3, 1, 3}, .edge = 0.1, .origin = {-0.15, height + 0.001, -0.15}, .anchored = false}));
  def.material = material("concrete_soft");
  def.anchored = false;
  w.destruction->addBody(def);
}

TEST(EnergyAlarm, NamesAStaticBodyThatGrowsOnce) {
  ExpectedWarnings warnings;
  DestructionDef definition;
  definition.log = warnings.log();
  BulletWorld w(definition);
  addSlab(w, 0.2);
  w.add(0, w.ballShape, {0, btScalar(0.1), 0});
  for (int tick = 0; tick < 60; ++tick) {
    w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    w.ballShape.setUnscaledRadius(w.ballShape.getRadius() + btScalar(0.002));
  }
  EXPECT_EQ(warnings.take("J more from the static body at (0, 0.1, 0) than it gave"), 1);
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_EQ(w.destruction->ledger().makers, 1u);
  EXPECT_GT(w.destruction->ledger().made, 0);
}

TEST(EnergyAlarm, IsSilentOfABallThatShootsAWall) {
  BulletWorld w;
  w.addWall(material("concrete_soft"));
  w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.4)})->setLinearVelocity({0, 0, 10});
  for (int tick = 0; tick < 240; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
  EXPECT_LT(w.destruction->ledger().made, 0.01 * 500) << "of the ball's 500 J";
}

TEST(EnergyAlarm, IsSilentOfWhatStands) {
  for (const bool crate : {false, true}) {
    DestructionDef definition;
    definition.sleep = false;
    BulletWorld w(definition);
    btBoxShape crateShape({btScalar(0.5), btScalar(0.25), btScalar(0.5)});
    if (crate) w.add(50, crateShape, {0, btScalar(0.25), 0});
    addSlab(w, crate ? 0.5 : 0);
    for (int tick = 0; tick < 600; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_LT(w.destruction->ledger().made, 0.01 * w.destruction->ledger().energyScale) << crate;
  }
}

// A ball of 2 kg that the substeps slowed down from 10 to 5 m/s, so it gave 75 J; Bullet has it at `speed`
// afterwards, by its own impulse.
std::vector<std::string> linesAfter(double speed) {
  btSphereShape shape(1);
  btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(2, nullptr, &shape, {1, 1, 1}));
  body.setLinearVelocity({btScalar(speed), 0, 0});
  bullet::TouchedBody touched;
  touched.object = touched.rigid = &body;
  touched.velocity = {10, 0, 0};
  touched.deltaVelocity = {-5, 0, 0};
  edem::RigidProxy proxy;
  proxy.key = 1;
  proxy.inverseMass = 0.5;
  bullet::EnergyAlarm alarm;
  alarm.begin({&proxy, 1});
  proxy.contactWeight = 10;
  proxy.given = 75;
  return alarm.end({&touched, 1}, {&proxy, 1}, 1.0 / 60, 75);
}

TEST(EnergyAlarm, DynamicBodyGivesNoMoreThanItLost) {
  EXPECT_TRUE(linesAfter(5).empty());
  EXPECT_TRUE(linesAfter(0).empty()) << "a wall took the rest";
  EXPECT_TRUE(linesAfter(8).empty()) << "a motor drives it";
}

TEST(EnergyAlarm, NamesADynamicBodyWhoseImpulseWasLost) {
  btSphereShape shape(1);
  btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(2, nullptr, &shape, {1, 1, 1}));
  body.setLinearVelocity({10, 0, 0});
  bullet::TouchedBody touched;
  touched.object = touched.rigid = &body;
  touched.velocity = {10, 0, 0};  // as before: no impulse came to it
  edem::RigidProxy proxy;
  proxy.key = 1;
  proxy.inverseMass = 0.5;
  bullet::EnergyAlarm alarm;
  for (int tick = 0; tick < 3; ++tick) {
    alarm.begin({&proxy, 1});
    proxy.contactWeight = 10;
    proxy.given = 75;
    const auto lines = alarm.end({&touched, 1}, {&proxy, 1}, 1.0 / 60, 75);
    ASSERT_EQ(lines.size(), tick == 0 ? 1u : 0u) << "once a body";
    if (tick == 0) {
      EXPECT_NE(lines[0].find("got 75 J more from the dynamic body"), std::string::npos) << lines[0];
    }
  }
  EXPECT_DOUBLE_EQ(alarm.made(), 3 * 75);
}

}  // namespace
}  // namespace rubble::test
