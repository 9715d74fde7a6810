// Rigid bodies whose linear and angular factors lock some of their motion, within the substeps, too.
#include <gtest/gtest.h>

#include "bullet/bullet_world.h"
#include "bullet/convert.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr double kCubeSide = 0.1;   // edge of the one element [m]
constexpr double kBlowSpeed = 1;    // of what strikes [m/s]
constexpr double kBarMass = 4;      // of the bar [kg]
constexpr double kBarLength = 1.2;  // of the bar, in x [m]

struct LockedWorld : BulletWorld {
  LockedWorld() : BulletWorld(unbreakable()) { world.setGravity({0, 0, 0}); }
  ~LockedWorld() { clear(); }
  static DestructionDef unbreakable() {
    DestructionDef def;
    def.breaking = def.crushing = def.sleep = false;
    def.log = strictLog();
    return def;
  }
  /// One cube about `at`, whose blows lose nothing.
  DestructibleBody* addCube(const btVector3& at, bool anchored, const btVector3& velocity) {
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = std::make_shared<const Asset>(
        gridAsset({.cubes = {1, 1, 1},
                   .edge = kCubeSide,
                   .origin = bullet::toEigen(at) - Eigen::Vector3d::Constant(0.5 * kCubeSide),
                   .anchored = anchored}));
    def.material = material("concrete_soft");
    def.material.contactDamping = def.material.springDamping = def.material.friction = 0;
    def.material.restitution = 1;
    def.anchored = anchored;
    def.velocity = velocity;
    return destruction->addBody(def);
  }
  btRigidBody* addBar(const btVector3& at) {
    btRigidBody* bar = add(btScalar(kBarMass), barShape, at);
    bar->setFriction(0);
    bar->setRestitution(1);
    bar->setActivationState(DISABLE_DEACTIVATION);
    return bar;
  }
  void run(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
  }
  btBoxShape barShape{{btScalar(kBarLength / 2), btScalar(0.05), btScalar(0.1)}};
};

// What strikes with its end and cannot turn bounces as what strikes with its middle, back at the speed it
// came with; one that turns would be left with less, for at its end it weighs m / (1 + m x^2 / I), 0.31 m.
TEST(LockedMotion, ABarThatCannotTurnStrikesWithAllOfItsMass) {
  for (const double side : {0.0, 0.5}) {
    LockedWorld w;
    w.addCube({btScalar(side), 1, 0}, true, {0, 0, 0});
    btRigidBody* bar = w.addBar({0, btScalar(1 + kCubeSide + 0.01), 0});
    bar->setLinearFactor({0, 1, 0});
    bar->setAngularFactor({0, 0, 0});
    bar->setLinearVelocity({0, btScalar(-kBlowSpeed), 0});
    w.run(12);
    EXPECT_NEAR(double(bar->getLinearVelocity().y()), kBlowSpeed, 0.02 * kBlowSpeed) << side;
    EXPECT_EQ(bar->getAngularVelocity(), btVector3(0, 0, 0)) << side;
    EXPECT_EQ(bar->getWorldTransform().getBasis(), btMatrix3x3::getIdentity()) << side;
    EXPECT_EQ(bar->getWorldTransform().getOrigin().x(), 0) << side;
    EXPECT_EQ(bar->getWorldTransform().getOrigin().z(), 0) << side;
    EXPECT_EQ(w.destruction->failure(), "");
    EXPECT_EQ(w.destruction->ledger().makers, 0u);
  }
}

// A turnstile that a cube flies against: an elastic blow on what turns about a fixed axis,
// w = 2 m r v / (I + m r^2) and v' = v (m r^2 - I) / (m r^2 + I).
TEST(LockedMotion, ATurnstileTurnsAboutItsAxisAndStaysWhereItIs) {
  LockedWorld w;
  const double r = 0.5;
  const btVector3 middle(0, 2, 0);
  DestructibleBody* cube = w.addCube({btScalar(r), 2, btScalar(-0.17)}, false, {0, 0, btScalar(kBlowSpeed)});
  btRigidBody* bar = w.addBar(middle);
  bar->setLinearFactor({0, 0, 0});
  bar->setAngularFactor({0, 1, 0});
  w.run(6);
  const double m = 1 / double(cube->getInvMass()), inertia = 1 / double(bar->getInvInertiaDiagLocal().y());
  const double spin = -2 * m * r * kBlowSpeed / (inertia + m * r * r);  // z towards -x
  const btVector3 turns = bar->getAngularVelocity();
  EXPECT_NEAR(double(turns.y()), spin, 0.03 * std::abs(spin));
  EXPECT_EQ(turns.x(), 0);
  EXPECT_EQ(turns.z(), 0);
  EXPECT_EQ(bar->getWorldTransform().getOrigin(), middle);
  EXPECT_EQ(bar->getLinearVelocity(), btVector3(0, 0, 0));
  const double back = kBlowSpeed * (m * r * r - inertia) / (m * r * r + inertia);
  EXPECT_NEAR(double(cube->linearMomentum().z()) / m, back, 0.03 * kBlowSpeed);
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_EQ(w.destruction->ledger().makers, 0u);
}

// A press without guides: a plate, wider than the block, that may only sink carries a load beside its middle.
// On one spring of k_cn = E h / 2 alone it would swing by twice its sag of F / k_cn.
TEST(LockedMotion, APlateThatOnlySinksStaysLevel) {
  LockedWorld w;
  w.addCube({btScalar(0.4), btScalar(0.5 * kCubeSide), 0}, true, {0, 0, 0});
  btRigidBody* plate = w.addBar({0, btScalar(kCubeSide + 0.05), 0});
  plate->setLinearFactor({0, 1, 0});
  plate->setAngularFactor({0, 0, 0});
  constexpr double kForce = 100;  // [N]
  double lowest = 1;
  for (int tick = 0; tick < 60; ++tick) {
    plate->applyCentralForce({0, btScalar(-kForce), 0});
    w.run(1);
    lowest = std::min(lowest, double(plate->getWorldTransform().getOrigin().y()));
    EXPECT_EQ(plate->getWorldTransform().getBasis(), btMatrix3x3::getIdentity()) << tick;
  }
  const double sag = 2 * kForce / (material("concrete_soft").youngsModulus * kCubeSide);
  // A guard, undamped, under a light plate whose contacts are softened, on an anchor that gives way, too.
  EXPECT_GT(lowest, kCubeSide + 0.05 - 4 * sag);
  EXPECT_LT(lowest, kCubeSide + 0.05 - 1.5 * sag);
}

}  // namespace
}  // namespace rubble::test
