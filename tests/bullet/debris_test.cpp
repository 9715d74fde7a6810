// Debris against what Bullet and the elements put in their way: pushes, and what they rest on.
#include <gtest/gtest.h>

#include <numbers>

#include "bullet/body_impl.h"
#include "bullet/bullet_world.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"
#include "support/grid_asset.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
namespace {

using debris::DebrisParcel;
using debris::SurfaceImpulse;

constexpr double kEdge = 0.0337;  // of one element [m]: 92 g of concrete

// `count` pieces of 6.4 g at 10 m/s, one behind the other, from above and a little beside the middle.
std::vector<DebrisParcel> volley(int count, const Eigen::Vector3d& target) {
  std::vector<DebrisParcel> parcels;
  for (int i = 0; i < count; ++i) {
    const double turn = 2.4 * i;  // the golden angle [rad]: no two alike
    const Eigen::Vector3d beside(0.008 * std::cos(turn), 0.03, 0.008 * std::sin(turn));
    DebrisParcel parcel = stone(target + beside, {1, -10, -2});
    parcel.mass = 0.0064;
    parcels.push_back(parcel);
  }
  return parcels;
}

double residual(const Ledger& l) {
  return l.kinetic + l.elastic + l.debris + l.dissipated + l.fracture + l.removed - l.gravity - l.exchanged -
         l.placed;
}

// One step of debris against one free element, without Bullet's tick around it.
struct ElementVolley {
  explicit ElementVolley(int count, Precision precision) : world(of(precision)) {
    world.world.setGravity({0, 0, 0});
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = std::make_shared<const Asset>(
        gridAsset({.cubes = {1, 1, 1}, .edge = kEdge, .origin = {0, 5, 0}, .anchored = false}));
    def.material = material("concrete_soft");
    def.anchored = false;
    id = world.destruction->addBody(def)->id();
    auto& system = *impl().debrisSystem;
    system.add(volley(count, impl().solver->position(id, 0)));
    start = system.motion();
    system.takeExchange();
    system.step(kTick, Eigen::Vector3d::Zero(), *impl().surroundings);
    impulses.assign(system.surfaceImpulses().begin(), system.surfaceImpulses().end());
  }
  static DestructionDef of(Precision precision) {
    DestructionDef def;
    def.precision = precision;
    return def;
  }
  Destruction::Impl& impl() { return implOf(*world.destruction); }
  debris::Motion element() {
    const auto& s = *impl().solver;
    return debris::motionOf(s.view(id).mass[0], s.view(id).inertia[0], s.position(id, 0), s.velocity(id, 0),
                            s.spin(id, 0));
  }
  // Balances of the step alone.
  Ledger pushAndBook() {
    const bullet::ElementPush push = impl().surroundings->push(impulses);
    exchange = impl().debrisSystem->takeExchange();
    bullet::LedgerBook book;
    book.addExchange(exchange);
    book.addPush(push);
    book.close(impl().solver->books(), impl().debrisSystem->motion());
    return book.ledger();
  }

  BulletWorld world;
  std::uint32_t id = 0;
  debris::Motion start;
  std::vector<SurfaceImpulse> impulses;
  debris::Exchange exchange;
};

TEST(DebrisPush, PiecesOfOneTickMakeNoEnergyOnAnElement) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    // Velocities of some 10 m/s in the elements' scalar; a push is rounded once.
    const double rounding = precision == Precision::Float ? 1e-6 : 1e-13;
    for (const int count : {1, 20, 60}) {
      ElementVolley volley(count, precision);
      const Ledger ledger = volley.pushAndBook();
      const debris::Motion pieces = volley.impl().debrisSystem->motion(), element = volley.element();
      EXPECT_LE(pieces.kinetic + element.kinetic, volley.start.kinetic) << count;
      EXPECT_LT(element.linear.y(), -0.05) << "they did hit";
      const Eigen::Vector3d linear = pieces.linear + element.linear - volley.exchange.air.linear;
      const Eigen::Vector3d angular = pieces.angular + element.angular - volley.exchange.air.angular;
      EXPECT_LT((linear - volley.start.linear).norm(), rounding) << count;
      EXPECT_LT((angular - volley.start.angular).norm(), 5 * rounding) << count << "; 5 m from the origin";
      // No Bullet body is there; what the pieces lost the element has, but for what the hits dissipated. The
      // pieces came from nowhere, so their first energy is the whole of the balance.
      EXPECT_NEAR(ledger.exchanged, 0, 1e-12);
      EXPECT_GT(ledger.dissipated, 0);
      EXPECT_NEAR(residual(ledger), volley.start.kinetic, 10 * rounding) << count;
    }
  }
}

TEST(DebrisPush, LedgerShowsEnergyThatTheHitsDidNotGive) {
  // Every hit twice as strong as it was booked: the element has four times the energy it was given.
  ElementVolley volley(20, Precision::Double);
  double given = 0;
  for (SurfaceImpulse& impulse : volley.impulses) {
    impulse.linear *= 2;
    impulse.angular *= 2;
    given += impulse.work;
  }
  const Ledger ledger = volley.pushAndBook();
  EXPECT_GT(given, 0.1);
  EXPECT_NEAR(residual(ledger), volley.start.kinetic + 3 * given, 1e-9);
  EXPECT_GT(ledger.linearError, 0.1);
}

TEST(DebrisPush, PiecesOfOneTickMakeNoEnergyOnALightBody) {
  for (const int count : {1, 20, 60}) {
    BulletWorld w;
    w.world.setGravity({0, 0, 0});
    btBoxShape boxShape({btScalar(0.02), btScalar(0.02), btScalar(0.02)});
    btRigidBody* box = w.add(btScalar(0.09), boxShape, {0, 5, 0});
    box->setLinearFactor({1, 1, 0});  // held in a plane
    Destruction::Impl& impl = implOf(*w.destruction);
    impl.debrisSystem->add(volley(count, {0, 5, 0}));
    const debris::Motion start = impl.debrisSystem->motion();
    impl.debrisSystem->takeExchange();
    impl.debrisSystem->step(kTick, Eigen::Vector3d::Zero(), *impl.surroundings);
    impl.surroundings->push(impl.debrisSystem->surfaceImpulses());
    const debris::Motion pieces = impl.debrisSystem->motion();
    const debris::Exchange exchange = impl.debrisSystem->takeExchange();
    const Eigen::Vector3d v = bullet::toEigen(box->getLinearVelocity());
    const Eigen::Vector3d w1 = bullet::toEigen(box->getAngularVelocity());
    const double kinetic =
        0.5 * (0.09 * v.squaredNorm() + w1.squaredNorm() / double(box->getInvInertiaDiagLocal().x()));
    EXPECT_LE(pieces.kinetic + kinetic, start.kinetic) << count;
    EXPECT_LT(v.y(), -0.3) << "they did hit";
    EXPECT_EQ(v.z(), 0);
    EXPECT_NEAR(exchange.workOnSurfaces, kinetic, 1e-5 * kinetic) << "in Bullet's float";
    const Eigen::Vector3d lost = start.linear + exchange.air.linear - pieces.linear;
    EXPECT_NEAR(0.09 * v.x(), lost.x(), 1e-6);
    EXPECT_NEAR(0.09 * v.y(), lost.y(), 1e-6);
  }
}

constexpr double kStone = 0.012;  // radius [m]: does not fall through between the slab's elements

// A world with stones at rest on something.
struct RestingDebris : BulletWorld {
  using BulletWorld::BulletWorld;

  debris::DebrisSystem& system() { return *implOf(*destruction).debrisSystem; }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds * 240); ++i)
      world.stepSimulation(btScalar(kTick), 1, btScalar(kTick));
  }
  // Nine stones a little above `height`, at rest on it afterwards.
  void strew(double height, double spacing = 0.05) {
    for (int x = -1; x <= 1; ++x)
      for (int z = -1; z <= 1; ++z) {
        const DebrisParcel parcel =
            stone({spacing * x, height + 0.015, spacing * z}, Eigen::Vector3d::Zero(), kStone);
        system().add({&parcel, 1});
      }
    run(2);
    ASSERT_EQ(system().restingCount(), 9u);
    ASSERT_GT(lowest(), height - 0.03);
  }
  double lowest() {
    double y = 1e9;
    for (const DebrisPiece& piece : system().pieces()) y = std::min(y, double(piece.position.y()));
    return y;
  }
  double highest() {
    double y = -1e9;
    for (const DebrisPiece& piece : system().pieces()) y = std::max(y, double(piece.position.y()));
    return y;
  }
  // 100 elements of 5 cm in one layer, its top at `height`.
  DestructibleBody* addSlab(double height) {
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = std::make_shared<const Asset>(gridAsset(
        {.cubes = {10, 1, 10}, .edge = 0.05, .origin = {-0.25, height - 0.05, -0.25}, .anchored = false}));
    def.material = material("concrete_soft");
    def.material.tensileStrength = 0.33e6;  // bears its own weight over 0.4 m, put down at once
    def.material.compressiveStrength = 3.3e6;
    def.anchored = false;
    return destruction->addBody(def);
  }

  btBoxShape shelfShape{{btScalar(0.3), btScalar(0.1), btScalar(0.3)}};
};

void removeAndDelete(btDynamicsWorld& world, btRigidBody* body) {
  world.removeRigidBody(body);
  delete body;
}

TEST(DebrisSupport, NothingWakesWhileNothingMoves) {
  RestingDebris w;
  w.add(0, w.shelfShape, {0, btScalar(0.9), 0});
  w.strew(1);
  for (int i = 0; i < 240; ++i) {
    w.run(kTick);
    ASSERT_EQ(w.system().movingCount(), 0u);
  }
}

TEST(DebrisSupport, StaticBodyThatIsDeletedLeavesThemToTheGround) {
  RestingDebris w;
  btRigidBody* other = w.add(0, w.shelfShape, {3, btScalar(0.9), 0});
  btRigidBody* shelf = w.add(0, w.shelfShape, {0, btScalar(0.9), 0});
  w.strew(1);
  removeAndDelete(w.world, other);  // moves the shelf in the world's list
  w.run(0.1);
  EXPECT_EQ(w.system().movingCount(), 0u);
  removeAndDelete(w.world, shelf);
  w.run(2);
  EXPECT_LT(w.highest(), kStone + 2e-4) << "they lie 1e-5 m above it";
  EXPECT_EQ(w.system().restingCount(), 9u);
}

TEST(DebrisSupport, SleepingBodyThatIsRemovedLeavesThemToTheGround) {
  RestingDebris w;
  btRigidBody* crate = w.add(20, w.shelfShape, {0, btScalar(0.1), 0});
  w.run(4);
  ASSERT_FALSE(crate->isActive());
  w.strew(0.2);
  removeAndDelete(w.world, crate);
  w.run(1);
  EXPECT_LT(w.highest(), kStone + 2e-4);
}

TEST(DebrisSupport, KinematicPlatformTakesThemAlong) {
  // Both ways in which Bullet's users make a body kinematic.
  for (const int flags : {0, int(btCollisionObject::CF_STATIC_OBJECT)}) {
    RestingDebris w;
    btRigidBody* platform = w.add(0, w.shelfShape, {0, btScalar(0.9), 0});
    platform->setCollisionFlags(flags | btCollisionObject::CF_KINEMATIC_OBJECT);
    platform->setActivationState(DISABLE_DEACTIVATION);
    w.strew(1);
    for (int i = 1; i <= 240; ++i) {
      platform->setWorldTransform(
          btTransform(btQuaternion::getIdentity(), {0, btScalar(0.9 - 0.5 * i * kTick), 0}));
      w.run(kTick);
    }
    w.run(1);
    EXPECT_NEAR(w.highest(), 0.5 + kStone, 1e-3) << flags;
    EXPECT_NEAR(w.lowest(), 0.5 + kStone, 1e-3) << flags;
    platform->setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(0.1), 0}));  // drops
    w.run(1);
    EXPECT_NEAR(w.highest(), 0.2 + kStone, 1e-3) << flags;
  }
}

TEST(DebrisSupport, TiltingPlatformIsLeft) {
  // Its middle stays where it is; only its ends move.
  RestingDebris w;
  btRigidBody* platform = w.add(0, w.shelfShape, {0, btScalar(0.9), 0});
  platform->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  platform->setActivationState(DISABLE_DEACTIVATION);
  w.strew(1);
  platform->setWorldTransform(
      btTransform(btQuaternion({0, 0, 1}, btScalar(std::numbers::pi / 3)), {0, btScalar(0.9), 0}));
  w.run(3);
  EXPECT_LT(w.highest(), kStone + 2e-4) << "steeper than friction holds";
}

TEST(DebrisSupport, FallingSlabTakesThemAlong) {
  DestructionDef def;
  def.breaking = def.crushing = false;
  RestingDebris w(def);
  btRigidBody* shelf = w.add(0, w.shelfShape, {0, btScalar(0.4), 0});
  DestructibleBody* slab = w.addSlab(0.551);
  w.run(4);
  w.strew(0.551);
  // 0.5 m down to the ground.
  removeAndDelete(w.world, shelf);
  slab->activate(true);
  w.run(3);
  EXPECT_LT(w.highest(), 0.05 + kStone);
  EXPECT_GT(w.lowest(), 0);
}

TEST(DebrisSupport, SleepingSlabThatIsRemovedLeavesThemToTheGround) {
  for (const bool byApplication : {false, true}) {
    RestingDebris w;
    DestructibleBody* slab = w.addSlab(0.051);
    w.run(6);
    ASSERT_TRUE(slab->isAsleep());
    w.strew(0.051);
    ASSERT_TRUE(slab->isAsleep());
    if (byApplication) {
      removeAndDelete(w.world, slab);
    } else {
      w.destruction->removeBody(slab);
    }
    w.run(1);
    EXPECT_LT(w.highest(), kStone + 2e-4);
  }
}

TEST(DebrisSupport, NothingHangsAfterTheSlabIsShotAway) {
  // Strewn further from the breaks in the middle than a break itself wakes them.
  RestingDebris w;
  w.add(0, w.shelfShape, {btScalar(0.5), btScalar(0.4), 0});
  w.add(0, w.shelfShape, {btScalar(-0.5), btScalar(0.4), 0});
  DestructibleBody* slab = w.addSlab(0.551);
  w.run(3);
  w.strew(0.551, 0.2);  // some into the dimples between the slab's elements
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(1), 0});
  ball->setLinearVelocity({0, -15, 0});
  w.run(3);
  ASSERT_GT(w.destruction->counts().springsBroken, 0u);
  const btVector3 at = ball->getWorldTransform().getOrigin();
  const Eigen::Vector3f ballCentre(float(at.x()), float(at.y()), float(at.z()));
  std::vector<ElementPose> poses(slab->asset()->elementCount());
  slab->poses(poses);
  for (const DebrisPiece& piece : w.system().pieces()) {
    if (!piece.resting || piece.position.y() < 1.1f * piece.radius) continue;
    const double radius = double(piece.radius);
    // Shelves' tops are at 0.5 m.
    double gap = std::abs(double(piece.position.y()) - 0.5) - 1.1 * radius;
    gap = std::min(
        gap, double((piece.position - ballCentre).norm()) - double(w.ballShape.getRadius()) - 1.1 * radius);
    for (const ElementPose& pose : poses) {
      if (pose.alive <= 0) continue;
      gap = std::min(gap,
                     double((piece.position - pose.position).norm()) - slab->asset()->radius - 1.1 * radius);
    }
    EXPECT_LT(gap, 0) << piece.position.transpose();
  }
}

}  // namespace
}  // namespace rubble::test
