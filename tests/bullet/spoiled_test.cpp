// Numbers that are not finite, or beyond Bullet's own, do not get into the elements.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "bullet/bullet_world.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr btScalar kNaN = std::numeric_limits<btScalar>::quiet_NaN();
constexpr btScalar kInfinity = std::numeric_limits<btScalar>::infinity();

// A block of 2 x 2 x 2 cubes, 1 mm above the ground.
DestructibleBody* addBlock(BulletWorld& w, double edge, Regime regime = Regime::Elements) {
  DestructibleBodyDef def;
  def.asset = std::make_shared<const Asset>(
      gridAsset({.edge = edge, .origin = {-edge, 0.001, -edge}, .anchored = false}));
  def.material = material("concrete_soft");
  def.anchored = false;
  def.regime = regime;
  return w.destruction->addBody(def);
}

void step(BulletWorld& w, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
}

bool elementsAreFinite(const DestructibleBody& body) {
  std::vector<ElementPose> poses(body.asset()->elementCount());
  body.poses(poses);
  for (const ElementPose& pose : poses)
    if (!pose.position.allFinite() || !pose.rotation.allFinite()) return false;
  return true;
}

bool isFinite(const btRigidBody& body) {
  const btVector3 &x = body.getWorldTransform().getOrigin(), &v = body.getLinearVelocity(),
                  &w = body.getAngularVelocity();
  return std::isfinite(x.dot(x) + v.dot(v) + w.dot(w));
}

// A ball that touches the block is spoiled once it lies there.
void expectOnlyTheBallIsSpoiled(const std::function<void(btRigidBody&)>& spoil) {
  ExpectedWarnings warnings;
  DestructionDef definition;
  definition.log = warnings.log();
  BulletWorld w(definition);
  const DestructibleBody* body = addBlock(w, 0.1);
  btRigidBody* ball = w.add(1, w.ballShape, {0, 0, btScalar(-0.199)});
  step(w, 2);
  spoil(*ball);
  step(w, 10);
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_EQ(warnings.take("are not finite numbers"), 1);
  EXPECT_TRUE(elementsAreFinite(*body));
  const Ledger& l = w.destruction->ledger();
  EXPECT_TRUE(std::isfinite(l.energyError + l.angularError + l.linearError + l.exchanged + l.dissipated));
  EXPECT_LT(l.energyError, 1e-3);
}

TEST(SpoiledNumbers, OfARigidBodyDoNotGetIntoTheElements) {
  expectOnlyTheBallIsSpoiled([](btRigidBody& ball) { ball.setLinearVelocity({kNaN, 0, 0}); });
  expectOnlyTheBallIsSpoiled([](btRigidBody& ball) { ball.setAngularVelocity({0, kInfinity, 0}); });
  expectOnlyTheBallIsSpoiled([](btRigidBody& ball) {
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, kNaN, 0}));
  });
  expectOnlyTheBallIsSpoiled([](btRigidBody& ball) { ball.applyCentralForce({0, 0, kInfinity}); });
}

TEST(SpoiledNumbers, OfAWholeBodyStopTheSimulationAndNameIt) {
  for (const btScalar bad : {kNaN, kInfinity}) {
    BulletWorld w;
    DestructibleBody* body = addBlock(w, 0.1, Regime::RigidUntilStruck);
    step(w, 2);
    body->setLinearVelocity({bad, 0, 0});
    step(w, 3);
    EXPECT_NE(w.destruction->failure().find("body 0 (concrete_soft"), std::string::npos)
        << w.destruction->failure();
    EXPECT_NE(w.destruction->failure().find("no finite number"), std::string::npos);
    EXPECT_NE(w.destruction->failure().find(" (tick "), std::string::npos) << w.destruction->failure();
    EXPECT_TRUE(elementsAreFinite(*body));
  }
}

TEST(SpoiledNumbers, OfABodyOfElementsAreTakenBack) {
  BulletWorld w;
  DestructibleBody* body = addBlock(w, 0.1);
  step(w, 2);
  body->setLinearVelocity({kNaN, 0, 0});
  step(w, 3);
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_TRUE(elementsAreFinite(*body));
  EXPECT_TRUE(isFinite(*body));
  EXPECT_NEAR(double(body->getWorldTransform().getOrigin().y()), 0.1005, 1e-3);
}

// I = m (2 h)^2 / 6 is 4e22 kg m^2 along each axis; its square is more than a float holds.
TEST(SpoiledNumbers, AMountainOfTenKilometresIsNoNaNToBullet) {
  for (const Regime regime : {Regime::Elements, Regime::RigidUntilStruck}) {
    ExpectedWarnings warnings;
    DestructionDef definition;
    definition.log = warnings.log();
    BulletWorld w(definition);
    const DestructibleBody* body = addBlock(w, 5000, regime);
    warnings.take("its own weight presses its foot");
    step(w, 3);
    EXPECT_EQ(w.destruction->failure(), "");
    EXPECT_TRUE(isFinite(*body));
    EXPECT_TRUE(elementsAreFinite(*body));
    EXPECT_TRUE(std::isfinite(body->angularMomentum().length()));
  }
}

}  // namespace
}  // namespace rubble::test
