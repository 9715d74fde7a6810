// Momentum and speed across the border of Bullet and the elements.
#include <gtest/gtest.h>

#include "bullet/bullet_world.h"

namespace rubble::test {
namespace {

// A ball of 10 kg at 10 m/s through the wall; returns its speed along z after 0.3 s.
double speedBehindWall(double strength, int rate, int ticksPerCall, double* worstMomentum = nullptr) {
  BulletWorld w;
  Material m = material("concrete_soft");
  m.tensileStrength = strength;
  m.compressiveStrength = 10 * strength;
  w.addWall(m);
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.4)});
  ball->setLinearVelocity({0, 0, 10});
  const btScalar tick = btScalar(1) / btScalar(rate);
  btVector3 before = ball->getLinearVelocity();
  double given = 0, scale = 0;
  for (int call = 0; call < int(0.3 * rate) / ticksPerCall; ++call) {
    w.world.stepSimulation(tick * btScalar(ticksPerCall), ticksPerCall, tick);
    const btVector3 now = ball->getLinearVelocity();
    given += 10 * double(before.z() - now.z());
    scale += std::abs(10 * double(before.z() - now.z()));
    before = now;
    if (worstMomentum) *worstMomentum = std::max(*worstMomentum, w.destruction->ledger().linearError);
  }
  EXPECT_GT(scale, 0) << "the ball never touched the wall";
  EXPECT_GT(given, 0);
  return double(before.z());
}

TEST(Coupling, ExitSpeedDoesNotDependOnTheTick) {
  // With hardly more strength than bears its weight only inertia brakes the ball: the same at every rate,
  // within 5 %.
  const double at240 = speedBehindWall(1.5e3, 240, 1);
  EXPECT_NEAR(speedBehindWall(1.5e3, 60, 1), at240, 0.05 * at240);
  EXPECT_NEAR(speedBehindWall(1.5e3, 1000, 1), at240, 0.05 * at240);
  EXPECT_LT(at240, 9.9);
}

TEST(Coupling, TicksPerCallChangeNothing) {
  // Bullet clears forces only after all ticks of a call; ours act as impulses.
  const double one = speedBehindWall(0.33e6, 240, 1);
  EXPECT_NEAR(speedBehindWall(0.33e6, 240, 2), one, 0.02 * one + 0.05);
  EXPECT_NEAR(speedBehindWall(0.33e6, 240, 4), one, 0.02 * one + 0.05);
}

TEST(Coupling, MomentumLedgerClosesInFloat) {
  double worst = 0;
  speedBehindWall(0.33e6, 240, 1, &worst);
  EXPECT_LT(worst, 1e-4);
}

// In the tick in which it breaks the wall. AddressSanitizer tells, too.
TEST(Coupling, AnActionMayDeleteTheBallThatHits) {
  BulletWorld w;
  w.addWall(material("concrete_soft"));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.4)});
  ball->setLinearVelocity({0, 0, 10});
  const auto step = [&] { w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240); };
  for (int tick = 0; tick < 48 && w.destruction->counts().springsBroken == 0; ++tick) step();
  ASSERT_GT(w.destruction->counts().springsBroken, 0u);
  Takes action([&] { w.remove(ball); });
  w.actFirst(action);
  for (int tick = 0; tick < 24; ++tick) step();
  w.world.removeAction(&action);
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_LT(w.destruction->ledger().linearError, 1e-4);
}

TEST(Coupling, BallGetsWhatTheElementsGive) {
  // No ground contact, gravity or crushing: what the ball loses the elements have, to the rounding of
  // Bullet's scalars; 8 ulp of the ball's momentum in 48 ticks.
  DestructionDef definition;
  definition.precision = sizeof(btScalar) == sizeof(double) ? Precision::Double : Precision::Float;
  definition.crushing = false;
  BulletWorld w(definition);
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = smallWall();
  def.material = material("concrete_soft");
  def.anchored = false;
  def.transform.setOrigin({0, 5, 0});
  const DestructibleBody* wall = w.destruction->addBody(def);
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(5.25), btScalar(-0.4)});
  ball->setLinearVelocity({0, 0, 10});
  for (int tick = 0; tick < 48; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  const double lost = 10 * (10 - double(ball->getLinearVelocity().z()));
  EXPECT_GT(lost, 1);
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
  EXPECT_NEAR(double(wall->linearMomentum().z()), lost,
              8 * double(SIMD_EPSILON) * 100);  // of the ball's 100 kg m/s
}

TEST(Coupling, DebrisPushTheElementsTheyHit) {
  // Springs break by crushing alone: a light ball crushes some of the first wall, and the first that reach
  // the second are debris.
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = smallWall();
  def.material = material("concrete_soft");
  def.material.crushEfficiency = 1e-3;
  def.material.tensileStrength = def.material.compressiveStrength = 1e12;
  def.material.breakingAngle = 3;
  def.anchored = false;
  def.transform.setOrigin({0, 5, 0});
  const DestructibleBody* struck = w.destruction->addBody(def);
  def.transform.setOrigin({0, 5, btScalar(0.4)});
  const DestructibleBody* behind = w.destruction->addBody(def);
  btRigidBody* ball = w.add(1, w.ballShape, {0, btScalar(5.25), btScalar(-0.2)});
  ball->setLinearVelocity({0, 0, 20});
  double worst = 0;
  for (int tick = 0; tick < 60 && !(double(behind->linearMomentum().z()) > 0); ++tick) {
    w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    worst = std::max(worst, w.destruction->ledger().momentumError());
    for (const ContactImpulse& c : w.destruction->takeEvents().contacts) EXPECT_EQ(c.body, struck->id());
  }
  EXPECT_GT(w.destruction->counts().debrisSpawned, 0u);
  std::vector<ElementPose> poses(struck->asset()->elementCount());
  struck->poses(poses);
  for (const ElementPose& pose : poses) EXPECT_TRUE(pose.alive <= 0 || pose.position.z() < 0.3f);
  EXPECT_LT(double(ball->getWorldTransform().getOrigin().z()), 0.3);
  EXPECT_GT(double(behind->linearMomentum().z()), 0);
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT(w.destruction->ledger().energyError, 0.02);
}

TEST(Coupling, AShapeThatCannotTouchIsNamedOnce) {
  test::ExpectedWarnings warnings;
  DestructionDef definition;
  definition.log = warnings.log();
  btConvexHullShape floor;
  for (const btVector3& corner : {btVector3(-1, 0, -1), btVector3(1, 0, -1), btVector3(0, 0, 1)})
    floor.addPoint(corner);
  test::BulletWorld w(definition);
  w.addWall(material("concrete_soft"));
  for (int i = 0; i < 2; ++i) w.add(0, floor, {0, btScalar(0.01), 0});
  for (int tick = 0; tick < 2; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_EQ(
      warnings.take("shape Convex does not touch the elements of destructible bodies: it has no volume"), 1);
}

TEST(Coupling, AppStyleTeardownDeletesBodiesFirst) {
  auto w = std::make_unique<BulletWorld>();
  w->addWall(material("concrete_soft"));
  for (int i = w->world.getNumConstraints() - 1; i >= 0; --i)
    w->world.removeConstraint(w->world.getConstraint(i));
  for (int i = w->world.getNumCollisionObjects() - 1; i >= 0; --i) {
    btCollisionObject* object = w->world.getCollisionObjectArray()[i];
    w->world.removeCollisionObject(object);
    delete object;
  }
  EXPECT_TRUE(w->destruction->bodies().empty());
  w->world.stepSimulation(btScalar(1) / 60);
}

}  // namespace
}  // namespace rubble::test
