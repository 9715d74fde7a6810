// Anchors that hold to a dynamic Bullet body.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bullet/bullet_world.h"
#include "bullet/regime_bodies.h"
#include "rubble/error.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr double kRideRate = 240, kRideEdge = 0.1, kRideTall = 0.4, kRideWide = 0.2;  // [Hz], [m]
constexpr double kRideHeight = 3;  // of the block's foot above the ground, at first [m]

// 2 x 4 x 2 cubes of 0.1 m on a dynamic cube of 0.5 m, so that its inertia is the same about all axes.
struct RidingBlock : BulletWorld {
  struct Made {
    double masses = 10;  ///< of the base, over the block's
    btVector3 gravity = {0, 0, 0};
    Precision precision = Precision::Float;
    Material material = rubble::material("concrete_soft");
    double height = kRideHeight;
    double damping = 0;
    btVector3 velocity = {0, 0, 0}, spin = {0, 0, 0};
  };
  explicit RidingBlock(const Made& made) : BulletWorld(quiet(made.precision)) {
    world.setGravity(made.gravity);
    const double mass = made.material.density * kRideWide * kRideWide * kRideTall * made.masses;
    base = add(btScalar(mass), baseShape, {0, btScalar(made.height - 0.24), 0});
    base->setLinearVelocity(made.velocity);
    base->setAngularVelocity(made.spin);
    def.asset = std::make_shared<const Asset>(gridAsset({.cubes = {2, 4, 2},
                                                         .edge = kRideEdge,
                                                         .origin = {-kRideWide / 2, 0, -kRideWide / 2},
                                                         .anchored = true}));
    def.material = made.material;
    def.transform.setOrigin({0, btScalar(made.height), 0});
    def.anchorBody = base;
    def.massDamping = made.damping;
    block = destruction->addBody(def);
    rest = posesOf(*block);
  }
  static DestructionDef quiet(Precision precision) {
    DestructionDef d;
    d.precision = precision;
    return d;
  }
  void step(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) world.stepSimulation(btScalar(1 / kRideRate), 1, btScalar(1 / kRideRate));
  }
  double baseMass() const { return 1 / double(base->getInvMass()); }
  Eigen::Vector3d linear() const {
    return vec(block->linearMomentum()) + baseMass() * vec(base->getLinearVelocity());
  }
  // About the origin.
  Eigen::Vector3d angular() const {
    const Momenta m(*block);
    const Eigen::Vector3d centre = vec(base->getWorldTransform().getOrigin());
    return vec(m.angular) + centre.cross(baseMass() * vec(base->getLinearVelocity())) +
           vec(base->getAngularVelocity()) / double(base->getInvInertiaDiagLocal().x());
  }
  double baseKinetic() const {
    return 0.5 * (baseMass() * double(base->getLinearVelocity().length2()) +
                  double(base->getAngularVelocity().length2()) / double(base->getInvInertiaDiagLocal().x()));
  }
  static Eigen::Vector3d vec(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }
  /// Furthest element from where the base would have it, were the block stiff [m].
  double furthest() const {
    const btTransform& at = base->getWorldTransform();
    const std::vector<ElementPose> now = posesOf(*block);
    double most = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Eigen::Vector3f r = rest[i].position - Eigen::Vector3f(0, float(start.y()), 0);
      const btVector3 there = at * btVector3(btScalar(r.x()), btScalar(r.y()), btScalar(r.z()));
      most = std::max(most, (now[i].position.cast<double>() - vec(there)).norm());
    }
    return most;
  }
  void expectClosed(double energy = 1e-4) const {
    EXPECT_EQ(destruction->failure(), "");
    EXPECT_LT(std::abs(destruction->ledger().linearError), 1e-4);
    EXPECT_LT(std::abs(destruction->ledger().angularError), 1e-4);
    EXPECT_LT(std::abs(destruction->ledger().energyError), energy);
    EXPECT_EQ(destruction->ledger().makers, 0u);
  }

  btBoxShape baseShape{{btScalar(0.25), btScalar(0.25), btScalar(0.25)}};
  btRigidBody* base = nullptr;
  DestructibleBodyDef def;
  DestructibleBody* block = nullptr;
  std::vector<ElementPose> rest;
  btVector3 start{0, btScalar(kRideHeight - 0.24), 0};
};

// Thrown and spun, nothing else acts: both momenta are what they were, to the rounding of Bullet's floats.
TEST(AnchorRide, FreeFlightKeepsBothMomenta) {
  for (const Precision precision : {Precision::Float, Precision::Double})
    for (const double masses : {10.0, 1.0, 0.1}) {
      RidingBlock w({.masses = masses,
                     .precision = precision,
                     .velocity = {btScalar(0.5), 1, 0},
                     .spin = {btScalar(0.7), btScalar(-0.4), 1}});
      const Eigen::Vector3d linear = w.linear(), angular = w.angular();
      w.step(240);
      EXPECT_LT((w.linear() - linear).norm(), 1e-5 * linear.norm()) << masses;
      EXPECT_LT((w.angular() - angular).norm(), 1e-5 * angular.norm()) << masses;
      EXPECT_LT(w.furthest(), 2e-3) << masses;
      EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
      w.expectClosed(1e-3);
    }
}

// The base is struck. The block follows at the speed of their centre of mass, which is at once the impulse
// over both masses, and both swing about that.
TEST(AnchorRide, TheCentreOfMassMovesByTheImpulseAlone) {
  RidingBlock w({.masses = 1, .precision = Precision::Double});
  const double mass = w.block->elementMass(), impulse = 0.02 * mass;
  w.base->applyCentralImpulse({0, btScalar(impulse), 0});
  double fastest = 0, slowest = 1;
  for (int tick = 0; tick < 120; ++tick) {
    w.step();
    EXPECT_NEAR(w.linear().y(), impulse, 1e-5 * impulse);
    const double speed = double(w.base->getLinearVelocity().y());
    fastest = std::max(fastest, speed);
    slowest = std::min(slowest, speed);
  }
  EXPECT_LT(slowest, 0.5 * impulse / mass) << "the block pulls it back";
  EXPECT_GT(fastest, 0.5 * impulse / mass);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed(1e-3);
}

// What the base loses is what the elements have: kinetic, in springs, and in dashpots.
TEST(AnchorRide, TheEnergyOfBothCloses) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    RidingBlock w({.masses = 2, .precision = precision});
    const double speed = 0.05;
    w.base->applyCentralImpulse({0, btScalar(speed * w.baseMass()), 0});
    const double begin = 0.5 * w.baseMass() * speed * speed;
    w.step(60);
    const Ledger& ledger = w.destruction->ledger();
    EXPECT_NEAR(ledger.kinetic + ledger.elastic + ledger.dissipated, ledger.exchanged,
                1e-3 * ledger.exchanged);
    EXPECT_NEAR(begin - w.baseKinetic(), ledger.exchanged + ledger.exchangedNext, 2e-3 * begin);
    w.expectClosed(1e-3);
  }
}

// A ball strikes the block: the three have its momentum, and the block stays on.
TEST(AnchorRide, ABallStrikesTheBlock) {
  RidingBlock w({.masses = 2});
  btSphereShape shape(btScalar(0.05));
  btRigidBody* ball = w.add(1, shape, {btScalar(-0.5), btScalar(kRideHeight + 0.25), 0});
  ball->setLinearVelocity({2, 0, 0});
  w.step(240);
  EXPECT_LT(double(ball->getLinearVelocity().x()), 1.0);
  EXPECT_NEAR(w.linear().x() + double(ball->getLinearVelocity().x()), 2, 1e-4);
  EXPECT_LT(w.furthest(), 0.01);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed(3e-3);  // a blow's own, of the first order in the substep: plugin/edem/README.md, Limits
  w.clear();             // before the ball's shape goes
}

// Dropped onto the ground, where the base stops at once: a wave of rho c v goes through the block and comes
// back as tension, which the anchors hold up to f_t.
TEST(AnchorRide, ADropBreaksTheAnchorsOnlyFromAHeight) {
  const Material m = rubble::material("concrete_soft");
  const double holds = m.tensileStrength / std::sqrt(m.density * m.youngsModulus);  // f_t / (rho c) [m/s]
  for (const double share : {0.3, 3.0}) {
    const double speed = share * holds, drop = speed * speed / (2 * 9.81);
    RidingBlock w({.gravity = {0, btScalar(-9.81), 0}, .height = 0.49 + drop, .damping = 20});
    w.start = {0, btScalar(0.25 + drop), 0};
    w.step(960);
    if (share < 1) {
      EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
      EXPECT_LT(w.furthest(), 1e-3);
      EXPECT_EQ(w.destruction->counts().awake, 0u) << "it sleeps";
      EXPECT_FALSE(w.base->isActive()) << "and so does what it stands on";
      w.base->applyCentralImpulse({btScalar(0.2 * w.baseMass()), 0, 0});
      w.base->activate();
      w.step();
      EXPECT_GT(w.destruction->counts().awake, 0u) << "they wake together";
    } else {
      EXPECT_GT(w.destruction->counts().springsBroken, 0u);
    }
    EXPECT_EQ(w.destruction->failure(), "");
  }
}

// A truck that goes at 3 m/s, without friction, of which Bullet bears itself and its load only after the
// substeps. Were the two to fall in each tick's and be stopped, the waves of that would break stiff anchors:
// seven at 240 Hz, and all at 60.
TEST(AnchorRide, ATruckCarriesItsLoadFromTickToTick) {
  Material stiff = rubble::material("concrete_soft");
  stiff.youngsModulus = 3e9;
  stiff.tensileStrength = 2e6;
  stiff.compressiveStrength = 2e7;
  for (const double rate : {60.0, 240.0}) {
    RidingBlock w(
        {.gravity = {0, btScalar(-9.81), 0}, .material = stiff, .height = 1.49, .velocity = {3, 0, 0}});
    w.start = {0, btScalar(1.25), 0};
    btBoxShape road({10, btScalar(0.5), 10});
    w.add(0, road, {0, btScalar(0.5), 0});
    w.base->setFriction(0);
    for (int tick = 0; tick < int(rate); ++tick)
      w.world.stepSimulation(btScalar(1 / rate), 1, btScalar(1 / rate));
    EXPECT_LT(w.furthest(), 1e-3) << rate;
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u) << rate;
    EXPECT_EQ(w.destruction->failure(), "");
    w.clear();  // before the road's shape goes
  }
}

// A base of a tenth of the block, thrown up and spinning under gravity: the pair stays together.
TEST(AnchorRide, ALightBaseStaysBounded) {
  for (const double masses : {0.1, 0.021}) {
    RidingBlock w({.masses = masses, .gravity = {0, btScalar(-9.81), 0}, .spin = {0, 0, 1}});
    w.step(120);
    EXPECT_LT(w.furthest(), 1e-3) << masses;
    w.expectClosed(1e-3);
  }
}

// Without its base the block hangs where that left it; and it follows a base that becomes kinematic.
TEST(AnchorRide, TheBaseGoesOrIsTakenOver) {
  RidingBlock w({.damping = 20, .velocity = {btScalar(0.05), 0, 0}});
  w.step(24);
  w.base->setCollisionFlags(w.base->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  w.base->setActivationState(DISABLE_DEACTIVATION);
  btTransform at = w.base->getWorldTransform();
  for (int tick = 0; tick < 240; ++tick) {
    at.getOrigin() += btVector3(btScalar(0.05 / kRideRate), 0, 0);
    w.base->setWorldTransform(at);
    w.step();
  }
  EXPECT_LT(w.furthest(), 1e-4);
  w.base->setCollisionFlags(w.base->getCollisionFlags() & ~btCollisionObject::CF_KINEMATIC_OBJECT);
  w.base->setLinearVelocity({btScalar(0.05), 0, 0});
  w.step(60);
  EXPECT_LT(w.furthest(), 1e-3);
  const std::vector<ElementPose> before = posesOf(*w.block);
  w.world.removeRigidBody(w.base);
  delete w.base;
  w.base = nullptr;
  w.step(240);
  EXPECT_LT(largestJump(before, posesOf(*w.block)), 1e-3);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  EXPECT_EQ(w.destruction->failure(), "");
}

// The application puts a truck elsewhere: what it carries goes along.
TEST(AnchorRide, WhatItCarriesGoesAlongToAnotherPlace) {
  RidingBlock w({});
  w.step();
  w.base->setWorldTransform(btTransform(btQuaternion({0, 0, 1}, btScalar(0.5)), {5, 4, 1}));
  w.step(60);
  EXPECT_LT(w.furthest(), 1e-3);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed(1e-3);
}

TEST(AnchorRide, ABaseThatIsTooLightIsRefused) {
  RidingBlock w({});
  btRigidBody* crumb = w.add(btScalar(0.1), w.baseShape, {3, 1, 0});
  w.def.anchorBody = crumb;
  try {
    w.destruction->addBody(w.def);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("anchorBody: is of 0.1 kg"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace rubble::test
