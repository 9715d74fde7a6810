// Anchors that hold to a Bullet body which the application moves.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bullet/bullet_world.h"
#include "bullet/regime_bodies.h"
#include "rubble/error.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr double kBlockRate = 240, kBlockEdge = 0.1, kBlockTall = 0.4, kBlockWide = 0.2;  // [Hz], [m]
constexpr double kBlockDamping = 20;  // of the deformation, whose slow modes would ring for seconds [1/s]
constexpr double kBlockFoot = 3;      // of the block, above the ground [m]

btTransform poseAt(const Eigen::Vector3d& place, double angle = 0) {
  return btTransform(btQuaternion({0, 1, 0}, btScalar(angle)),
                     {btScalar(place.x()), btScalar(place.y()), btScalar(place.z())});
}

// 2 x 4 x 2 cubes of 0.1 m that stand on a kinematic box, by anchors, with its foot 10 mm in it.
struct CarriedBlock : BulletWorld {
  explicit CarriedBlock(const btVector3& gravity = {0, 0, 0}, const Material& material = soft(),
                        const Eigen::Vector3d& from = {0, 0, 0}, Precision precision = Precision::Float,
                        double damping = kBlockDamping)
      : BulletWorld(quiet(precision)) {
    world.setGravity(gravity);
    base = add(0, baseShape, {0, btScalar(kBlockFoot - 0.09), 0});
    base->setCollisionFlags(base->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    base->setActivationState(DISABLE_DEACTIVATION);
    base->setInterpolationWorldTransform(base->getWorldTransform());
    def.asset =
        std::make_shared<const Asset>(gridAsset({.cubes = {2, 4, 2},
                                                 .edge = kBlockEdge,
                                                 .origin = {-kBlockWide / 2 + from.x(), 0, -kBlockWide / 2},
                                                 .anchored = true}));
    def.material = material;
    def.transform.setOrigin({0, btScalar(kBlockFoot), 0});
    def.anchorBody = base;
    def.massDamping = damping;
    block = destruction->addBody(def);
    rest = posesOf(*block);
  }
  static DestructionDef quiet(Precision precision) {
    DestructionDef d;
    d.precision = precision;
    return d;
  }
  static Material soft() { return rubble::material("concrete_soft"); }
  Eigen::Vector3d baseAt() const { return Eigen::Vector3d(0, kBlockFoot - 0.09, 0); }

  /// The application puts the base somewhere `ticks` times in a row, the world follows.
  void step(const btTransform& pose, int ticksACall = 1) {
    base->setWorldTransform(pose);
    world.stepSimulation(btScalar(ticksACall / kBlockRate), ticksACall, btScalar(1 / kBlockRate));
  }
  /// Furthest element from where the base would have it, were the block stiff [m].
  double furthest(const Eigen::Isometry3d& by) const {
    const std::vector<ElementPose> now = posesOf(*block);
    double most = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
      most = std::max(most, (now[i].position.cast<double>() - by * rest[i].position.cast<double>()).norm());
    return most;
  }
  double furthest(const Eigen::Vector3d& by) const {
    return furthest(Eigen::Isometry3d(Eigen::Translation3d(by)));
  }
  void expectClosed(double energy = 1e-4) const {
    EXPECT_EQ(destruction->failure(), "");
    EXPECT_LT(std::abs(destruction->ledger().linearError), 1e-4);
    EXPECT_LT(std::abs(destruction->ledger().angularError), 1e-4);
    EXPECT_LT(std::abs(destruction->ledger().energyError), energy);
  }

  btBoxShape baseShape{{btScalar(0.5), btScalar(0.1), btScalar(0.5)}};
  btRigidBody* base = nullptr;
  DestructibleBodyDef def;
  DestructibleBody* block = nullptr;
  std::vector<ElementPose> rest;
};

// Upwards from rest to 0.3 m/s within a tick: the base's velocity goes to 1.5 v and back to v. Each change of
// it sends a wave through the block, by which its free end lags by no more than the change times L / c.
TEST(AnchorBody, ABlockFollowsAtConstantSpeed) {
  CarriedBlock w;
  const double v = 0.3, c = std::sqrt(w.def.material.youngsModulus / w.def.material.density);
  double most = 0;
  for (int tick = 1; tick <= 240; ++tick) {
    const Eigen::Vector3d way(0, v * tick / kBlockRate, 0);
    w.step(poseAt(w.baseAt() + way));
    most = std::max(most, w.furthest(way));
  }
  EXPECT_LT(most, 2 * v * kBlockTall / c + 1e-6);
  EXPECT_GT(most, 0.1 * v * kBlockTall / c) << "it is not stiff";
  EXPECT_LT(w.furthest(Eigen::Vector3d(0, v, 0)), 0.05 * v * kBlockTall / c)
      << "and comes to rest in the base";
  const double mass = w.block->elementMass(), kinetic = 0.5 * mass * v * v;
  EXPECT_NEAR(double(w.block->linearMomentum().y()), mass * v, 1e-3 * mass * v);
  EXPECT_NEAR(w.destruction->ledger().kinetic, kinetic, 2e-3 * kinetic);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed(3e-3);  // mass damping changes velocities at half steps, but is booked as between them
}

// Without that damping: what the base gives is in the block's motion, its springs, and what the dashpots
// took.
TEST(AnchorBody, TheBaseGivesTheEnergy) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    CarriedBlock w({0, 0, 0}, CarriedBlock::soft(), {0.5, 0, 0}, precision, 0);
    double way = 0;  // half a metre and a radian a second, in a quarter of a second
    for (int tick = 1; tick <= 120; ++tick) {
      way += std::min(1.0, tick / kBlockRate / 0.25) / kBlockRate;
      w.step(poseAt(w.baseAt() + Eigen::Vector3d(0, 0.5 * way, 0), way));
    }
    const Ledger& ledger = w.destruction->ledger();
    const double mass = w.block->elementMass(), inertia = mass * (0.5 * 0.5 + kBlockWide * kBlockWide / 6),
                 kinetic = 0.5 * (mass * 0.5 * 0.5 + inertia);
    EXPECT_NEAR(ledger.kinetic, kinetic, 0.02 * kinetic);  // it rings
    EXPECT_GT(ledger.dissipated, 0);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_NEAR(ledger.exchanged, ledger.kinetic + ledger.elastic + ledger.dissipated,
                1e-4 * ledger.exchanged);
    w.expectClosed();
  }
}

// On a table that gathers speed to 2 rad/s in 0.5 s, 0.5 m from its axis. The block lags by its sag as a
// Timoshenko cantilever under the acceleration, a rho (1.5 L^4 / (E b^2) + L^2 / (2 k G)), with k = 5/6 and
// G = 0.4 E, twice that for it comes within ticks.
TEST(AnchorBody, ABlockFollowsOnATurningTable) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    CarriedBlock w({0, 0, 0}, CarriedBlock::soft(), {0.5, 0, 0}, precision);
    const double rate = 2, within = 0.5, radius = 0.5 + kBlockWide;
    const double acceleration = radius * (rate / within + rate * rate), E = w.def.material.youngsModulus;
    const double sag = acceleration * w.def.material.density *
                       (1.5 * std::pow(kBlockTall, 4) / (E * kBlockWide * kBlockWide) +
                        kBlockTall * kBlockTall / (2 * 5.0 / 6 * 0.4 * E));
    double most = 0, angle = 0;
    for (int tick = 1; tick <= 480; ++tick) {
      const double t = tick / kBlockRate;
      angle = t < within ? rate * t * t / (2 * within) : rate * (t - 0.5 * within);
      w.step(poseAt(w.baseAt(), angle));
      most =
          std::max(most, w.furthest(Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()))));
    }
    EXPECT_LT(most, 2 * sag + 1e-6) << sag;
    const double mass = w.block->elementMass();
    const double inertia = mass * (0.5 * 0.5 + kBlockWide * kBlockWide / 6);
    EXPECT_NEAR(w.destruction->ledger().kinetic, 0.5 * inertia * rate * rate, 2e-3 * inertia * rate * rate);
    EXPECT_NEAR(double(w.block->getAngularVelocity().y()), rate, 1e-3 * rate);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    w.expectClosed(3e-3);
  }
}

// Four ticks a call, of which Bullet's kinematic bodies are at the last place from the first tick on.
TEST(AnchorBody, ItsWayIsSpreadOverTheTicksOfACall) {
  CarriedBlock w;
  const double a = 2;
  double most = 0;
  for (int call = 1; call <= 60; ++call) {
    const double t = 4 * call / kBlockRate;
    const Eigen::Vector3d way(0, a / 2 * t * t, 0);
    w.step(poseAt(w.baseAt() + way), 4);
    most = std::max(most, w.furthest(way));
  }
  // Its velocity goes by steps of a * 4 / kBlockRate, within a tick each: 2 x as in
  // ABlockFollowsAtConstantSpeed.
  const double c = std::sqrt(w.def.material.youngsModulus / w.def.material.density);
  EXPECT_LT(most, 2 * a * 4 / kBlockRate * kBlockTall / c + 1e-6);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed();
}

// Drawn down ever harder, 80 m/s^3: its anchors bear m a, and go at f_t A.
TEST(AnchorBody, AnchorsBreakWhenTheBaseIsFasterThanTheyHold) {
  Material weak = CarriedBlock::soft();
  weak.tensileStrength = 2e4;
  CarriedBlock w({0, 0, 0}, weak);
  const double jerk = 80, holds = weak.tensileStrength * kBlockWide * kBlockWide / w.block->elementMass();
  double broke = 0;
  for (int tick = 1; broke == 0 && tick <= 240; ++tick) {
    const double t = tick / kBlockRate;
    w.step(poseAt(w.baseAt() - Eigen::Vector3d(0, jerk / 6 * t * t * t, 0)));
    if (w.destruction->counts().springsBroken > 0) broke = jerk * t;
  }
  EXPECT_NEAR(broke, holds, 0.03 * holds);
  w.expectClosed();
  // It goes on as it was, and falls behind.
  const double speed = -double(w.block->linearMomentum().y()) / w.block->elementMass();
  for (int tick = 0; tick < 24; ++tick)
    w.step(poseAt(w.baseAt() - Eigen::Vector3d(0, 1 + 2.0 * tick / 24, 0)));
  EXPECT_NEAR(-double(w.block->linearMomentum().y()) / w.block->elementMass(), speed, 0.05 * speed);
  w.expectClosed();
}

TEST(AnchorBody, AnchorsHoldAtNineTenthsOfThat) {
  Material weak = CarriedBlock::soft();
  weak.tensileStrength = 2e4;
  CarriedBlock w({0, 0, 0}, weak);
  const double most = 0.9 * weak.tensileStrength * kBlockWide * kBlockWide / w.block->elementMass(),
               ramp = 0.25;
  double place = 0, speed = 0;
  for (int tick = 1; tick <= 120; ++tick) {
    const double a = most * std::min(1.0, tick / kBlockRate / ramp);
    speed += a / kBlockRate;
    place += speed / kBlockRate;
    w.step(poseAt(w.baseAt() - Eigen::Vector3d(0, place, 0)));
  }
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed();
}

// Hard concrete on a lift that gathers 1 m/s^2 at 60 Hz, four ticks a call, and stops again; its places are
// Bullet's floats, from 3 to 4 m. Its sag, rho (g + a) L^2 / (2 E), is 0.07 um.
TEST(AnchorBody, HardConcreteRidesALift) {
  Material hard = CarriedBlock::soft();
  hard.youngsModulus = 3e10;
  hard.tensileStrength = 3e6;
  hard.compressiveStrength = 3e7;
  CarriedBlock w({0, btScalar(-9.81), 0}, hard, {0, 0, 0}, Precision::Float, 0);
  double place = 0;
  for (int call = 1; call <= 120; ++call) {
    const double t = call / 60.0;
    place = t < 1 ? 0.5 * t * t : 1 - 0.5 * (2 - t) * (2 - t);
    w.step(poseAt(w.baseAt() + Eigen::Vector3d(0, place, 0)), 4);
  }
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  EXPECT_NEAR(w.furthest(Eigen::Vector3d(0, place, 0)), 0, 2e-6);
  w.expectClosed();
}

// Of what anchors no longer hold it is a body as any other: it stays on the base that overlaps it.
TEST(AnchorBody, WhatHasBrokenLooseLiesOnTheBase) {
  Material weak = CarriedBlock::soft();
  weak.tensileStrength = 2e4;
  CarriedBlock w({0, btScalar(-9.81), 0}, weak);
  double place = 0, speed = 0;
  int tick = 0;
  for (; tick < 240 && w.destruction->counts().springsBroken < 4; ++tick) {
    speed += 80.0 * tick / kBlockRate / kBlockRate;
    place += speed / kBlockRate;
    w.step(poseAt(w.baseAt() + Eigen::Vector3d(0, place, 0)));
    w.step(poseAt(w.baseAt() + Eigen::Vector3d(0, place -= speed / kBlockRate, 0)));
  }
  ASSERT_LT(tick, 240);
  for (tick = 0; tick < 480; ++tick) w.step(poseAt(w.baseAt() + Eigen::Vector3d(0, place, 0)));
  double lowest = 1e9;
  for (const ElementPose& e : posesOf(*w.block)) lowest = std::min(lowest, double(e.position.y()));
  EXPECT_GT(lowest - place, kBlockFoot + 0.01 + 0.4 * kBlockEdge);
  EXPECT_EQ(w.destruction->failure(), "");
}

// It overlaps its base, which presses nothing that anchors hold: it stands as it was pre-stressed, sleeps,
// and wakes when the base goes, however slowly.
TEST(AnchorBody, ItSleepsOnWhatStandsAndWakesWithIt) {
  CarriedBlock w({0, btScalar(-9.81), 0});
  for (int tick = 0; tick < 960; ++tick) w.step(poseAt(w.baseAt()));
  EXPECT_LT(w.furthest(Eigen::Vector3d::Zero()), 1e-6);
  EXPECT_EQ(w.destruction->counts().awake, 0u);
  for (int tick = 1; tick <= 480; ++tick) {
    w.step(poseAt(w.baseAt() + Eigen::Vector3d(0.005 * tick / kBlockRate, 0, 0)));
    ASSERT_EQ(w.destruction->counts().awake, w.rest.size());
  }
  EXPECT_LT(w.furthest(Eigen::Vector3d(0.01, 0, 0)), 1e-5);
  for (int tick = 0; tick < 960; ++tick) w.step(poseAt(w.baseAt() + Eigen::Vector3d(0.01, 0, 0)));
  EXPECT_EQ(w.destruction->counts().awake, 0u);
  w.expectClosed(3e-3);
}

// It hangs where the base left it, until the application lets it hold to another.
TEST(AnchorBody, WithoutItsBaseItStaysWhereItIs) {
  CarriedBlock w({0, btScalar(-9.81), 0});
  Eigen::Vector3d way(0, 0, 0);
  for (int tick = 1; tick <= 60; ++tick) {
    way.x() = 0.05 * tick / kBlockRate;
    w.step(poseAt(w.baseAt() + way));
  }
  w.world.removeRigidBody(w.base);
  delete w.base;
  for (int tick = 0; tick < 240; ++tick)
    w.world.stepSimulation(btScalar(1 / kBlockRate), 1, btScalar(1 / kBlockRate));
  EXPECT_LT(w.furthest(way), 1e-4);
  w.base = w.add(0, w.baseShape, {5, 5, 5});
  w.base->setCollisionFlags(w.base->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  w.destruction->setAnchorBody(w.block, w.base);
  for (int tick = 1; tick <= 240; ++tick) w.step(poseAt(Eigen::Vector3d(5, 5 + 0.1 * tick / kBlockRate, 5)));
  EXPECT_LT(w.furthest(way + Eigen::Vector3d(0, 0.1, 0)), 1e-4);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed(3e-3);
}

// The application turns block and anchors about the base's axis: from there on they go with the base.
TEST(AnchorBody, APlaceOfItsOwnIsKeptBesideTheBase) {
  CarriedBlock w;
  w.step(poseAt(w.baseAt()));
  btTransform at = w.block->getWorldTransform();
  at.getOrigin() += btVector3(btScalar(0.3), 0, 0);
  w.block->setWorldTransform(at);
  for (int tick = 1; tick <= 120; ++tick)
    w.step(poseAt(w.baseAt() + Eigen::Vector3d(0, 0.1 * tick / kBlockRate, 0)));
  EXPECT_LT(w.furthest(Eigen::Vector3d(0.3, 0.05, 0)), 1e-5);
  w.expectClosed(3e-3);
}

TEST(AnchorBody, ItStaysElementsInAnyRegime) {
  CarriedBlock w;
  w.def.regime = Regime::RigidUntilStruck;
  w.def.transform.setOrigin({0, btScalar(kBlockFoot), btScalar(0.25)});
  DestructibleBody* other = w.destruction->addBody(w.def);
  for (int tick = 0; tick < 240; ++tick) w.step(poseAt(w.baseAt()));
  EXPECT_FALSE(other->isWhole());
}

TEST(AnchorBody, OthersAreRefused) {
  CarriedBlock w;
  const auto why = [&](btRigidBody* base) -> std::string {
    DestructibleBodyDef other = w.def;
    other.anchorBody = base;
    try {
      w.destruction->addBody(other);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  btRigidBody* crate = w.add(5, w.baseShape, {3, 1, 0});
  EXPECT_NE(why(w.block).find("destructible"), std::string::npos);
  w.world.removeRigidBody(crate);
  EXPECT_NE(why(crate).find("not in the world"), std::string::npos);
  delete crate;
  EXPECT_EQ(w.destruction->bodies().size(), 1u);
}

}  // namespace
}  // namespace rubble::test
