// What an application does to a body of elements by Bullet's own calls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bullet/bullet_world.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr btScalar kMoveTick = btScalar(1) / 240;

// 3 x 2 x 2 cubes of 0.1 m in free space: its inertia about x, y and z is m / 12 times the sums of squares of
// the other edges.
struct FreeBlock : BulletWorld {
  explicit FreeBlock(const btVector3& gravity = {0, 0, 0}, Regime regime = Regime::Elements) {
    world.setGravity(gravity);
    DestructibleBodyDef def;
    GridAssetDef grid;
    grid.cubes = {3, 2, 2};
    grid.edge = 0.1;
    def.asset = std::make_shared<const Asset>(gridAsset(grid));
    def.material = material("concrete_soft");
    def.transform.setOrigin({0, btScalar(kHeight), 0});
    def.regime = regime;
    block = destruction->addBody(def);
    mass = block->elementMass();
    step(2);
  }
  // On the ground.
  void putDown() {
    btTransform at = block->getWorldTransform();
    at.getOrigin().setY(at.getOrigin().y() - btScalar(kHeight));
    block->setWorldTransform(at);
  }
  void step(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) world.stepSimulation(kMoveTick, 1, kMoveTick);
  }
  Eigen::Vector3d velocity() const {
    const btVector3 p = block->linearMomentum();
    return Eigen::Vector3d(double(p.x()), double(p.y()), double(p.z())) / mass;
  }
  Eigen::Vector3d spinMomentum() const {
    const btVector3 l = block->angularMomentum();
    return {double(l.x()), double(l.y()), double(l.z())};
  }
  Eigen::Vector3d centre() const {
    std::vector<ElementPose> poses(block->elementsAlive().size());
    block->poses(poses);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const ElementPose& e : poses) sum += e.position.cast<double>() / double(poses.size());
    return sum;
  }
  void expectWhole() const {
    EXPECT_EQ(destruction->counts().springsBroken, 0u);
    EXPECT_EQ(destruction->failure(), "");
    EXPECT_LT(std::abs(destruction->ledger().linearError), 1e-4);
    EXPECT_LT(std::abs(destruction->ledger().angularError), 1e-4);
    EXPECT_LT(std::abs(destruction->ledger().energyError), 1e-4);
  }

  static constexpr double kHeight = 3;
  DestructibleBody* block = nullptr;
  double mass = 0;
};

TEST(HostMoves, AnImpulseAtTheCentre) {
  FreeBlock w;
  w.block->applyCentralImpulse(btVector3(btScalar(w.mass * 0.5), 0, 0));
  w.step(48);
  EXPECT_NEAR(w.velocity().x(), 0.5, 1e-4);
  EXPECT_NEAR(double(w.block->getLinearVelocity().x()), 0.5, 1e-4);
  EXPECT_LT(w.spinMomentum().norm(), 1e-4 * w.mass * 0.5 * 0.1);
  w.expectWhole();
}

TEST(HostMoves, AnImpulseOffTheCentreTurns) {
  FreeBlock w;
  const double impulse = w.mass * 0.3, arm = 0.1;
  w.block->applyImpulse({0, 0, btScalar(impulse)}, {0, btScalar(arm), 0});
  w.step(2);
  EXPECT_NEAR(w.velocity().z(), 0.3, 1e-4);
  EXPECT_NEAR(w.spinMomentum().x(), impulse * arm, 2e-3 * impulse * arm);
  w.expectWhole();
}

TEST(HostMoves, AForceAndATorqueForAWhile) {
  FreeBlock w;
  for (int tick = 0; tick < 48; ++tick) {
    w.block->applyCentralForce({0, btScalar(2 * w.mass), 0});
    w.block->applyTorque({btScalar(0.4), 0, 0});
    w.step(1);
  }
  EXPECT_NEAR(w.velocity().y(), 2 * 48.0 / 240, 1e-3);
  EXPECT_NEAR(w.spinMomentum().x(), 0.4 * 48 / 240, 1e-3 * 0.4 * 48 / 240);
  w.expectWhole();
}

TEST(HostMoves, VelocitiesAreTakenAndShown) {
  FreeBlock w;
  w.block->setLinearVelocity({1, 0, -2});
  w.block->setAngularVelocity({0, 0, btScalar(1.5)});
  w.step(24);
  EXPECT_NEAR(w.velocity().x(), 1, 1e-4);
  EXPECT_NEAR(w.velocity().z(), -2, 1e-4);
  const double inertia = w.mass / 12 * (0.3 * 0.3 + 0.2 * 0.2);
  EXPECT_NEAR(w.spinMomentum().z(), 1.5 * inertia, 2e-3 * inertia);
  EXPECT_NEAR(double(w.block->getAngularVelocity().z()), 1.5, 5e-3);
  w.block->setLinearVelocity({0, 0, 0});
  w.step(1);
  EXPECT_LT(w.velocity().norm(), 1e-4);
  w.expectWhole();
}

TEST(HostMoves, ItsOwnGravityIsInsteadOfTheWorlds) {
  FreeBlock w({0, btScalar(-9.81), 0});
  const double before = w.velocity().y();
  w.block->setGravity({0, btScalar(1.5), 0});
  w.step(48);
  EXPECT_NEAR(w.velocity().y() - before, 1.5 * 48 / 240, 2e-3);
}

// Its sides stand upright in the ground, where rounding decides which of their points press; all of them are
// free from the start.
TEST(HostMoves, WhatIsPutDeepIntoTheGroundIsNotThrown) {
  for (const double depth : {0.02, 0.07, 0.11, 0.14, 0.3}) {
    SCOPED_TRACE(depth);
    FreeBlock w({0, btScalar(-9.81), 0});
    btTransform at = w.block->getWorldTransform();
    at.getOrigin().setY(at.getOrigin().y() - btScalar(FreeBlock::kHeight + depth));
    w.block->setLinearVelocity({0, 0, 0});
    w.block->setWorldTransform(at);
    double fastest = 0;
    for (int tick = 0; tick < 48; ++tick) {
      w.step(1);
      fastest = std::max(fastest, w.velocity().norm());
    }
    EXPECT_LT(fastest, 0.02);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_EQ(w.destruction->failure(), "");
    EXPECT_EQ(w.destruction->ledger().makers, 0u);
  }
}

// It lies on them, so that its contacts know it; then it is put into their middle, with no speed. A place
// that they have not come to by a way gives them nothing.
TEST(HostMoves, ARigidBodyThatIsPutIntoElementsIsNotThrown) {
  for (const double mass : {0.01, 1.0, 100.0}) {
    SCOPED_TRACE(mass);
    BulletWorld w;
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = std::make_shared<const Asset>(gridAsset({.cubes = {4, 1, 4}, .edge = 0.1}));
    def.material = material("concrete_soft");
    w.destruction->addBody(def);
    btBoxShape shape({btScalar(0.3), btScalar(0.02), btScalar(0.3)});
    btRigidBody* plate = w.add(btScalar(mass), shape, {btScalar(0.2), btScalar(0.12), btScalar(0.2)});
    const btScalar dt = btScalar(1) / 240;
    for (int tick = 0; tick < 60; ++tick) w.world.stepSimulation(dt, 1, dt);
    btTransform at = plate->getWorldTransform();
    at.getOrigin().setY(btScalar(0.05));
    plate->setWorldTransform(at);
    plate->setLinearVelocity({0, 0, 0});
    plate->setAngularVelocity({0, 0, 0});
    plate->activate();
    const double before = w.destruction->ledger().exchanged;
    double fastest = 0;
    for (int tick = 0; tick < 48; ++tick) {
      w.world.stepSimulation(dt, 1, dt);
      fastest = std::max(fastest, double(plate->getLinearVelocity().length()));
    }
    // At most what its weight gives over a millimetre.
    EXPECT_LT(fastest, std::sqrt(2 * 9.81 * 1e-3));
    EXPECT_LT(w.destruction->ledger().exchanged - before, mass * 9.81 * 1e-3);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_EQ(w.destruction->failure(), "");
    w.clear();
  }
}

// Zero is a gravity, too, and the world's comes back with it.
TEST(HostMoves, WithoutGravityOfItsOwnItFloats) {
  FreeBlock w({0, btScalar(-9.81), 0});
  const double before = w.velocity().y();
  w.block->setGravity({0, 0, 0});
  w.step(48);
  EXPECT_NEAR(w.velocity().y(), before, 1e-5);
  w.block->setGravity(w.world.getGravity());
  w.step(48);
  EXPECT_NEAR(w.velocity().y() - before, -9.81 * 48 / 240, 2e-3);
  w.expectWhole();
}

// The moon's. What rests on springs holds the square of its weight in them.
TEST(HostMoves, UnderGravityOfItsOwnItRestsAndSleeps) {
  constexpr double kMoon = 1.62, kEarth = 9.81;
  FreeBlock w({0, btScalar(-kEarth), 0});
  w.putDown();
  const auto elasticUnder = [&w](double gravity) {
    w.block->setGravity({0, btScalar(-gravity), 0});
    w.step(2 * 240);
    EXPECT_TRUE(w.block->isAsleep()) << gravity;
    return w.destruction->ledger().elastic;
  };
  const double moon = elasticUnder(kMoon);
  EXPECT_NEAR(elasticUnder(kEarth) / moon, kEarth * kEarth / kMoon / kMoon, 1);
  EXPECT_NEAR(elasticUnder(kMoon) / moon, 1, 0.03);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
}

// A place far away, and a quarter turn about y while it flies along x: it then flies along -z.
TEST(HostMoves, APlaceIsTakenWithTheMotion) {
  FreeBlock w;
  w.block->setLinearVelocity({2, 0, 0});
  w.step(1);
  w.block->setWorldTransform(btTransform(btQuaternion({0, 1, 0}, SIMD_HALF_PI), {-1000, 3, 50}));
  w.step(24);
  const Eigen::Vector3d expected = Eigen::Vector3d(-1000, 3, 50 - 2 * 24.0 / 240);
  EXPECT_LT((w.centre() - expected).norm(), 1e-3) << w.centre().transpose();
  EXPECT_NEAR(w.velocity().z(), -2, 1e-4);
  const btTransform& shown = w.block->getWorldTransform();
  EXPECT_LT((shown.getOrigin() - btVector3(-1000, 3, btScalar(expected.z()))).length(), btScalar(1e-3));
  EXPECT_NEAR(double(shown.getRotation().getAngle()), double(SIMD_HALF_PI), 1e-3);
  w.expectWhole();
}

TEST(HostMoves, ASleepingBodyWakes) {
  FreeBlock w({0, btScalar(-9.81), 0});
  w.putDown();
  w.step(1200);
  ASSERT_TRUE(w.block->isAsleep());
  w.block->setLinearVelocity({0, 2, 0});
  w.step(1);
  EXPECT_FALSE(w.block->isAsleep());
  // Gravity has had between a half and two ticks: velocities are those at half steps.
  EXPECT_NEAR(w.velocity().y(), 2 - 9.81 / 240, 9.81 / 240);
  w.expectWhole();
}

TEST(HostMoves, WhatSleepsOnWhatIsRemovedFalls) {
  FreeBlock w({0, btScalar(-9.81), 0});
  btBoxShape tableShape({1, btScalar(0.1), 1});
  btRigidBody* table = w.add(0, tableShape, {0, btScalar(FreeBlock::kHeight - 0.1), 0});
  w.step(1200);
  ASSERT_TRUE(w.block->isAsleep());
  w.world.removeRigidBody(table);
  delete table;
  w.step(60);
  EXPECT_NEAR(w.centre().y(), FreeBlock::kHeight + 0.1 - 9.81 / 2 * 0.25 * 0.25, 0.02);
}

TEST(HostMoves, ACrateThatSleepsOnARemovedBodyFalls) {
  FreeBlock w({0, btScalar(-9.81), 0});
  w.putDown();
  btBoxShape crateShape({btScalar(0.05), btScalar(0.05), btScalar(0.05)});
  btRigidBody* crate = w.add(2, crateShape, {btScalar(0.15), btScalar(0.26), btScalar(0.1)});
  w.step(1500);
  ASSERT_FALSE(crate->isActive());
  EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.25, 1e-3);
  w.destruction->removeBody(w.block);
  w.step(120);
  EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.05, 5e-3);
}

TEST(HostMoves, ACrateThatSleepsOnARemovedWholeBodyFalls) {
  FreeBlock w({0, btScalar(-9.81), 0}, Regime::RigidUntilStruck);
  btBoxShape tableShape({1, btScalar(0.1), 1}), crateShape({btScalar(0.05), btScalar(0.05), btScalar(0.05)});
  w.add(0, tableShape, {0, btScalar(FreeBlock::kHeight - 0.1), 0});
  constexpr double kOn = FreeBlock::kHeight + 0.25;
  btRigidBody* crate = w.add(2, crateShape, {btScalar(0.15), btScalar(kOn), btScalar(0.1)});
  w.step(1500);
  ASSERT_TRUE(w.block->isWhole());
  ASSERT_FALSE(crate->isActive());
  ASSERT_NEAR(double(crate->getWorldTransform().getOrigin().y()), kOn, 0.01);
  w.destruction->removeBody(w.block);
  w.step(120);
  EXPECT_LT(double(crate->getWorldTransform().getOrigin().y()), FreeBlock::kHeight + 0.06);
}

}  // namespace
}  // namespace rubble::test
