// Bodies that are Bullet's until they are struck.
#include <gtest/gtest.h>
#include <array>

#include <cmath>
#include <optional>
#include <utility>

#include "bullet/bullet_world.h"
#include "rubble/destructible_body.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

DestructibleBodyDef wallDef(Regime regime) {
  DestructibleBodyDef def;
  def.asset = smallWall();
  def.material = material("concrete_soft");
  def.regime = regime;
  return def;
}

// Cubes of 0.05 m, its lowest corner at `corner`.
DestructibleBodyDef blockDef(const Eigen::Vector3i& cubes, const btVector3& corner,
                             Regime regime = Regime::RigidUntilStruck) {
  DestructibleBodyDef def;
  def.asset = std::make_shared<const Asset>(
      gridAsset({.cubes = {cubes.x(), cubes.y(), cubes.z()}, .edge = 0.05, .anchored = false}));
  def.material = material("concrete_soft");
  def.anchored = false;
  def.regime = regime;
  def.transform.setOrigin(corner);
  return def;
}

// An L of two arms, 0.1 m thick.
std::shared_ptr<const Asset> bentSlab() {
  constexpr std::array<std::array<double, 2>, 6> kOutline = {
      {{0, 0}, {0.4, 0}, {0.4, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0, 0.4}}};
  SurfaceMesh mesh;
  for (const double z : {0.0, 0.1})
    for (const auto& p : kOutline) mesh.vertices.emplace_back(p[0], p[1], z);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    mesh.triangles.push_back({t[2], t[1], t[0]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  CookOptions options;
  options.elements = 60;
  return std::make_shared<const Asset>(cookStrictly(mesh, options));
}

struct Blow {
  std::uint32_t broken, crushed;
  double exit;
};

Blow blow(Regime regime, double rate, double after) {
  BulletWorld w;
  w.destruction->addBody(wallDef(regime));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.145 - after * 10)});
  ball->setLinearVelocity({0, 0, 10});
  ball->setGravity({0, 0, 0});
  const btScalar dt = btScalar(1 / rate);
  for (int tick = 0; tick < int((0.05 + after) * rate + 0.5); ++tick) w.world.stepSimulation(dt, 1, dt);
  const DestructionCounts counts = w.destruction->counts();
  EXPECT_LT(std::abs(w.destruction->ledger().linearError), 1e-4);
  EXPECT_LT(std::abs(w.destruction->ledger().massError), 1e-6);
  return {counts.springsBroken, counts.crushed, double(ball->getLinearVelocity().z())};
}

TEST(Regime, ABlowBreaksWhatItBreaksOfElements) {
  for (const double rate : {60.0, 240.0}) {
    const Blow elements = blow(Regime::Elements, rate, 0), whole = blow(Regime::RigidUntilStruck, rate, 0);
    EXPECT_GT(elements.broken, 50u);
    EXPECT_NEAR(double(whole.broken), double(elements.broken), 0.05 * double(elements.broken)) << rate;
    EXPECT_NEAR(double(whole.crushed), double(elements.crushed), 2) << rate;
    EXPECT_NEAR(whole.exit, elements.exit, 0.05 * std::abs(elements.exit)) << rate;
  }
}

TEST(Regime, AnUntouchedWallTakesNoSubstepsUntilItIsStruck) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  for (int tick = 0; tick < 300; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1);
    ASSERT_EQ(w.destruction->lastSubsteps(), 0);
  }
  EXPECT_TRUE(wall->isWhole());
  EXPECT_TRUE(wall->isAsleep());
  // Though everything sleeps, a ball wakes it.
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), -1});
  ball->setLinearVelocity({0, 0, 10});
  for (int tick = 0; tick < 12; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_FALSE(wall->isWhole());
  EXPECT_GT(w.destruction->counts().springsBroken, 50u);
}

TEST(Regime, AGentleTouchLeavesItWhole) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.15)});
  ball->setLinearVelocity({0, 0, btScalar(0.1)});
  for (int tick = 0; tick < 120; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_TRUE(wall->isWhole());
  EXPECT_NEAR(double(ball->getWorldTransform().getOrigin().z()), -0.14, 2e-3);
}

// Of a packed wall, whose elements' centre of mass is beside the middle of its box.
TEST(Regime, BothMomentaSurviveTheThaw) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = wallDef(Regime::RigidUntilStruck);
  def.anchored = false;
  def.transform = btTransform(btQuaternion({1, 2, 3}, btScalar(0.7)), {0, 2, 0});
  def.velocity = {1, btScalar(0.5), -2};
  def.spin = {3, -1, 2};
  DestructibleBody* wall = w.destruction->addBody(def);
  ASSERT_TRUE(wall->isWhole());
  const btScalar dt = btScalar(1) / 240;
  for (int tick = 0; tick < 10; ++tick) w.world.stepSimulation(dt, 1, dt);
  const btVector3 linear = wall->linearMomentum();
  const btVector3 at = wall->getWorldTransform().getOrigin();
  const btVector3 angular = wall->angularMomentum() + at.cross(linear);  // about the origin
  w.destruction->strike(wall);
  w.world.stepSimulation(dt, 1, dt);
  ASSERT_FALSE(wall->isWhole());
  std::vector<ElementPose> poses(wall->asset()->elementCount());
  wall->poses(poses);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i)
    centre += wall->asset()->volumes[i] / wall->asset()->volume() * poses[i].position.cast<double>();
  const btVector3 now = wall->linearMomentum(),
                  middle(btScalar(centre.x()), btScalar(centre.y()), btScalar(centre.z()));
  EXPECT_GT(double((middle - at - dt * linear / btScalar(wall->elementMass())).length()), 1e-5)
      << "no arm to test";
  EXPECT_LT(double((now - linear).length() / linear.length()), 1e-6);
  EXPECT_LT(double((wall->angularMomentum() + middle.cross(now) - angular).length() / angular.length()),
            1e-5);
  EXPECT_LT(std::abs(w.destruction->ledger().linearError), 1e-6);
  EXPECT_LT(std::abs(w.destruction->ledger().angularError), 1e-5);
}

TEST(Regime, WhatItIgnoresDoesNotStrikeIt) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.5)});
  ball->setLinearVelocity({0, 0, 10});
  ball->setIgnoreCollisionCheck(wall, true);
  for (int tick = 0; tick < 12; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_TRUE(wall->isWhole());
  EXPECT_NEAR(double(ball->getWorldTransform().getOrigin().z()), 1.5, 1e-3);
}

TEST(Regime, PosesFollowTheRigidBody) {
  BulletWorld w;
  DestructibleBody* block = w.destruction->addBody(blockDef({4, 2, 2}, {0, 1, 0}));
  std::vector<ElementPose> before(block->asset()->elementCount()), after = before;
  block->poses(before);
  EXPECT_LT(double((before[0].position - Eigen::Vector3f(0.025f, 1.025f, 0.025f)).norm()), 1e-5);
  block->setAngularVelocity({0, 4, 0});
  for (int tick = 0; tick < 30; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  block->poses(after);
  const btTransform& at = block->getWorldTransform();
  // From the middle of the block to its first element: the same in the body's axes as at rest.
  const btVector3 local =
      at.inverse() * btVector3(after[0].position.x(), after[0].position.y(), after[0].position.z());
  EXPECT_LT(double((local - btVector3(btScalar(-0.075), btScalar(-0.025), btScalar(-0.025))).length()), 1e-5);
  EXPECT_GT(double((after[0].position - before[0].position).norm()), 0.05);
}

TEST(Regime, AStackOfEightBlocksStandsAndSleeps) {
  BulletWorld w;
  std::vector<DestructibleBody*> blocks;
  for (int i = 0; i < 8; ++i)
    blocks.push_back(w.destruction->addBody(blockDef({4, 2, 4}, {0, btScalar(0.1 * i), 0})));
  for (int tick = 0; tick < 5 * 240; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  for (int i = 0; i < 8; ++i) {
    const btVector3 at = blocks[i]->getWorldTransform().getOrigin();
    EXPECT_TRUE(blocks[i]->isWhole());
    EXPECT_TRUE(blocks[i]->isAsleep());
    EXPECT_LT(double((at - btVector3(btScalar(0.1), btScalar(0.05 + 0.1 * i), btScalar(0.1))).length()),
              0.01);
  }
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
}

// Crates on crates on a slab rest and sleep where they do on a plain rigid body of Bullet's.
TEST(Regime, CratesRestOnASlab) {
  btBoxShape crate({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  btBoxShape plain({btScalar(0.25), btScalar(0.05), btScalar(0.25)});
  const auto heights = [&](bool destructible, btScalar rate, btScalar lower, btScalar upper) {
    BulletWorld w;
    const DestructibleBodyDef def = blockDef({10, 2, 10}, {btScalar(-0.25), 0, btScalar(-0.25)});
    btRigidBody* slab = nullptr;
    if (destructible) {
      slab = w.destruction->addBody(def);
    } else {
      slab = w.add(btScalar(2400 * 0.5 * 0.1 * 0.5), plain, {0, btScalar(0.05), 0});
      slab->setFriction(btScalar(def.material.friction));
    }
    std::vector<btRigidBody*> crates = {w.add(lower, crate, {0, btScalar(0.2), 0})};
    if (upper > 0) crates.push_back(w.add(upper, crate, {0, btScalar(0.4), 0}));
    for (int tick = 0; tick < int(4 * rate); ++tick) w.world.stepSimulation(1 / rate, 1, 1 / rate);
    EXPECT_FALSE(slab->isActive());
    if (destructible) {
      EXPECT_TRUE(DestructibleBody::upcast(slab)->isWhole());
    }
    std::vector<double> all;
    for (const btRigidBody* c : crates) {
      EXPECT_FALSE(c->isActive()) << rate << " Hz, " << lower << " and " << upper << " kg";
      all.push_back(double(c->getWorldTransform().getOrigin().y()));
    }
    return all;
  };
  for (const int rate : {60, 120, 480}) {
    for (const auto& [lower, upper] : {std::pair(1, 0), {10, 10}, {1, 20}, {50, 0}}) {
      const auto ours = heights(true, btScalar(rate), btScalar(lower), btScalar(upper));
      const auto bullets = heights(false, btScalar(rate), btScalar(lower), btScalar(upper));
      for (std::size_t i = 0; i < ours.size(); ++i)
        EXPECT_NEAR(ours[i], bullets[i], 1e-3) << rate << " Hz, " << lower << " and " << upper << " kg";
    }
  }
}

TEST(Regime, ItFallsOnTriangleMeshes) {
  BulletWorld w;
  w.world.removeRigidBody(w.ground);
  delete w.ground;
  btTriangleMesh triangles;
  triangles.addTriangle({-2, 0, -2}, {2, 0, -2}, {2, 0, 2});
  triangles.addTriangle({-2, 0, -2}, {2, 0, 2}, {-2, 0, 2});
  btBvhTriangleMeshShape floor(&triangles, true);
  w.add(0, floor, {0, 0, 0});
  const DestructibleBody* block = w.destruction->addBody(blockDef({4, 2, 4}, {0, btScalar(0.01), 0}));
  for (int tick = 0; tick < 240; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_NEAR(double(block->getWorldTransform().getOrigin().y()), 0.05, 2e-3);
  EXPECT_TRUE(block->isAsleep());
}

TEST(Regime, TwoWholeBlocksThatMeetBreakAsElementsDo) {
  const auto broken = [](Regime regime) {
    BulletWorld w;
    w.world.setGravity({0, 0, 0});
    DestructibleBodyDef left = blockDef({4, 4, 4}, {0, 1, 0}, regime), right = left;
    right.transform.setOrigin({btScalar(0.25), 1, 0});
    left.velocity = {3, 0, 0};
    right.velocity = {-3, 0, 0};
    const DestructibleBody* a = w.destruction->addBody(left);
    const DestructibleBody* b = w.destruction->addBody(right);
    for (int tick = 0; tick < 24; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    const btVector3 sum = a->linearMomentum() + b->linearMomentum();
    EXPECT_LT(double(sum.length()), 1e-3 * 3 * a->elementMass());
    return double(w.destruction->counts().springsBroken);
  };
  const double elements = broken(Regime::Elements);
  EXPECT_GT(elements, 20);
  EXPECT_NEAR(broken(Regime::RigidUntilStruck), elements, 0.1 * elements);
}

TEST(Regime, ForcesVelocitiesAndTransformsAreTheApplications) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 1, 0}));
  const double mass = block->elementMass();
  for (int tick = 0; tick < 60; ++tick) {
    block->applyCentralForce({btScalar(mass), 0, 0});
    w.world.stepSimulation(btScalar(1) / 60, 1);
  }
  EXPECT_NEAR(double(block->getLinearVelocity().x()), 1, 1e-3);
  block->setWorldTransform(btTransform(btQuaternion::getIdentity(), {5, 5, 5}));
  w.world.stepSimulation(btScalar(1) / 60, 1);
  std::vector<ElementPose> poses(block->asset()->elementCount());
  block->poses(poses);
  EXPECT_NEAR(double(poses[0].position.y()), 5 - 0.025, 1e-3);
}

TEST(Regime, NothingSleepsWhereSleepIsOff) {
  DestructionDef definition;
  definition.sleep = false;
  BulletWorld w(definition);
  const DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 0, 0}));
  for (int tick = 0; tick < 240; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_FALSE(block->isAsleep());
  EXPECT_TRUE(block->isWhole());
}

// In any order, and in the tick of a blow too.
TEST(Regime, WholeBodiesAreRemovedAsOthersAre) {
  BulletWorld w;
  DestructibleBody* first = w.destruction->addBody(blockDef({2, 2, 2}, {0, 0, 0}));
  DestructibleBody* second = w.destruction->addBody(blockDef({2, 2, 2}, {0, btScalar(0.1), 0}));
  w.destruction->strike(first);
  w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_FALSE(first->isWhole());
  EXPECT_TRUE(second->isWhole());
  w.world.removeRigidBody(second);
  delete second;
  w.world.stepSimulation(btScalar(1) / 60, 1);
  w.destruction->removeBody(first);
  w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_TRUE(w.destruction->bodies().empty());
  EXPECT_LT(std::abs(w.destruction->ledger().massError), 1e-9);
  w.destruction->addBody(blockDef({2, 2, 2}, {0, 0, 0}));
}

TEST(Regime, ASolidThatIsNotConvexStaysElementsAndThatIsSaid) {
  std::vector<std::string> lines;
  DestructionDef definition;
  definition.log = [&](LogLevel, const std::string& line) { lines.push_back(line); };
  BulletWorld w(definition);
  DestructibleBodyDef def = blockDef({1, 1, 1}, {0, 0, 0});
  def.asset = bentSlab();
  EXPECT_FALSE(w.destruction->addBody(def)->isWhole());
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find("not convex"), std::string::npos) << lines.back();
}

// Elements that a body has, now.
std::vector<ElementPose> posesOf(const DestructibleBody& body) {
  std::vector<ElementPose> poses(body.asset()->elementCount());
  body.poses(poses);
  return poses;
}

// Largest way of an element between two poses of a body [m].
double largestJump(const std::vector<ElementPose>& from, const std::vector<ElementPose>& to) {
  double most = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    most = std::max(most, double((to[i].position - from[i].position).norm()));
  return most;
}

// Momentum, and angular momentum about the origin, of a free body of elements or of Bullet's.
struct Momenta {
  btVector3 linear, angular;
  explicit Momenta(const DestructibleBody& body) : linear(body.linearMomentum()) {
    btVector3 centre = body.getWorldTransform().getOrigin();
    if (!body.isWhole()) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const std::vector<ElementPose> poses = posesOf(body);
      for (std::size_t i = 0; i < poses.size(); ++i)
        sum += body.asset()->volumes[i] / body.asset()->volume() * poses[i].position.cast<double>();
      centre = {btScalar(sum.x()), btScalar(sum.y()), btScalar(sum.z())};
    }
    angular = body.angularMomentum() + centre.cross(linear);
  }
};

// Ticks until `body` is Bullet's or its elements', as wanted; at most `most`.
int ticksUntil(BulletWorld& w, const DestructibleBody& body, bool whole, btScalar rate, int most) {
  int ticks = 0;
  for (; ticks < most && body.isWhole() != whole; ++ticks) w.world.stepSimulation(1 / rate, 1, 1 / rate);
  return ticks;
}

// Of a packed wall, whose elements' centre of mass is beside the middle of its box, several times.
TEST(Regime, MomentaAndPlaceSurviveTheWayBack) {
  constexpr btScalar kRate = 240;
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = wallDef(Regime::RigidUntilStruck);
  def.anchored = false;
  def.transform = btTransform(btQuaternion({1, 2, 3}, btScalar(0.7)), {0, 2, 0});
  def.velocity = {btScalar(0.06), btScalar(0.03), btScalar(-0.05)};
  def.spin = {btScalar(0.1), btScalar(-0.1), btScalar(0.05)};
  DestructibleBody* wall = w.destruction->addBody(def);
  const Momenta first(*wall);
  for (int cycle = 0; cycle < 3; ++cycle) {
    w.destruction->strike(wall);
    ASSERT_EQ(ticksUntil(w, *wall, false, kRate, 2), 1);
    std::vector<ElementPose> before;
    int ticks = 0;
    for (; ticks < 240 && !wall->isWhole(); ++ticks) {
      before = posesOf(*wall);
      w.world.stepSimulation(1 / kRate, 1, 1 / kRate);
    }
    ASSERT_TRUE(wall->isWhole());
    EXPECT_GE(ticks, 60) << "a quarter of a second";
    // No more than its motion, 0.083 m/s and 0.15 rad/s 0.36 m from its middle, all along the tick.
    EXPECT_LT(largestJump(before, posesOf(*wall)), 0.137 / double(kRate));
    const Momenta now(*wall);
    EXPECT_LT(double((now.linear - first.linear).length() / first.linear.length()), 1e-5);
    EXPECT_LT(double((now.angular - first.angular).length() / first.angular.length()), 1e-5);
    const Ledger& ledger = w.destruction->ledger();
    EXPECT_LT(std::abs(ledger.linearError), 1e-6);
    EXPECT_LT(std::abs(ledger.angularError), 1e-5);
    EXPECT_LT(ledger.energyError, 1e-4);
    for (int tick = 0; tick < 24; ++tick) w.world.stepSimulation(1 / kRate, 1, 1 / kRate);
    ASSERT_TRUE(wall->isWhole());
    ASSERT_EQ(w.destruction->lastSubsteps(), 0);
  }
}

#ifdef RUBBLE_SANITIZED  // the same code at every rate and mass
constexpr std::array kCrateRates = {60}, kCrateMasses = {10}, kBeamRates = {60};
#else
constexpr std::array kCrateRates = {60, 120, 240, 480};
constexpr std::array kBeamRates = {60, 240};
constexpr std::array kCrateMasses = {1, 10, 50};
#endif

// A crate falls 20 mm onto a slab, whose elements take the blow. It rests on a rigid body of Bullet's again
// soon, once and for all, and both fall asleep.
TEST(Regime, ASlabUnderARestingCrateGoesBackToBulletAndSleeps) {
  btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  for (const int rate : kCrateRates) {
    for (const int mass : kCrateMasses) {
      SCOPED_TRACE(std::to_string(rate) + " Hz, " + std::to_string(mass) + " kg");
      BulletWorld w;
      const DestructibleBody* slab =
          w.destruction->addBody(blockDef({10, 2, 10}, {btScalar(-0.25), 0, btScalar(-0.25)}));
      btRigidBody* crate = w.add(btScalar(mass), shape, {0, btScalar(0.22), 0});
      int changes = 0;
      bool whole = true;
      double jump = 0, errorStep = 0;
      for (int tick = 0; tick < 4 * rate; ++tick) {
        const std::vector<ElementPose> before = posesOf(*slab);
        const double error = w.destruction->ledger().energyError;
        w.world.stepSimulation(btScalar(1) / btScalar(rate), 1, btScalar(1) / btScalar(rate));
        if (slab->isWhole() == whole) continue;
        whole = !whole;
        ++changes;
        if (!whole) continue;
        jump = largestJump(before, posesOf(*slab));
        errorStep = w.destruction->ledger().energyError - error;
      }
      EXPECT_EQ(changes, 2) << "elements once, and back";
      EXPECT_TRUE(slab->isWhole());
      EXPECT_TRUE(slab->isAsleep());
      EXPECT_FALSE(crate->isActive());
      EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.2, 1e-3);
      EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
      EXPECT_LT(jump, 0.1 * slab->asset()->radius);
      EXPECT_LT(errorStep, 1e-3);
    }
  }
}

TEST(Regime, AnAnchoredWallGoesBackToWhereItStood) {
  constexpr btScalar kRate = 240;
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  const std::vector<ElementPose> stood = posesOf(*wall);
  for (int cycle = 0; cycle < 2; ++cycle) {
    btRigidBody* ball = w.add(btScalar(0.3), w.ballShape, {0, btScalar(0.4), btScalar(-0.16)});
    ball->setLinearVelocity({0, 0, btScalar(1.5)});
    ASSERT_LT(ticksUntil(w, *wall, false, kRate, 24), 24);
    ASSERT_LT(ticksUntil(w, *wall, true, kRate, 960), 960);
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_LT(largestJump(stood, posesOf(*wall)), 1e-6);
    EXPECT_LT(w.destruction->ledger().linearError, 1e-4);
    EXPECT_LT(w.destruction->ledger().energyError, 0.02);
  }
  for (int tick = 0; tick < 960; ++tick) w.world.stepSimulation(1 / kRate, 1, 1 / kRate);
  EXPECT_TRUE(wall->isWhole());
  EXPECT_TRUE(wall->isAsleep());
}

TEST(Regime, TheApplicationsSettingsComeBackWithTheBody) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 1, 0}));
  block->setFlags(block->getFlags() | BT_DISABLE_WORLD_GRAVITY);
  block->setGravity({0, btScalar(0.01), 0});
  block->setLinearFactor({1, 1, 0});
  block->setAngularFactor({0, 0, 1});
  block->setFriction(btScalar(0.123));
  block->setActivationState(DISABLE_DEACTIVATION);
  w.destruction->strike(block);
  ASSERT_EQ(ticksUntil(w, *block, false, 60, 2), 1);
  ASSERT_LT(ticksUntil(w, *block, true, 60, 60), 60);
  EXPECT_EQ(block->getGravity(), btVector3(0, btScalar(0.01), 0));
  EXPECT_EQ(block->getLinearFactor(), btVector3(1, 1, 0));
  EXPECT_EQ(block->getAngularFactor(), btVector3(0, 0, 1));
  EXPECT_EQ(block->getFriction(), btScalar(0.123));
  EXPECT_EQ(block->getActivationState(), DISABLE_DEACTIVATION);
}

// In whatever tick of a call it goes back, it falls as it should in the others of the same call.
TEST(Regime, GravityActsInTheTicksAfterTheWayBack) {
  constexpr double kGravity = 0.01;  // it stays slow enough for a second [m/s^2]
  BulletWorld w;
  w.world.setGravity({0, btScalar(-kGravity), 0});
  DestructibleBody* block = w.destruction->addBody(blockDef({2, 2, 2}, {0, 1, 0}));
  w.destruction->strike(block);
  for (int frame = 0; frame < 20; ++frame) w.world.stepSimulation(btScalar(1) / 30, 8, btScalar(1) / 240);
  ASSERT_TRUE(block->isWhole());
  // Half a substep, for the elements' velocities are of half steps; a tick lost would be 4e-5 m/s.
  EXPECT_NEAR(double(block->getLinearVelocity().y()), -kGravity * 20 / 30, 2e-6);
}

TEST(Regime, WhatBrokeStaysElements) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(wallDef(Regime::RigidUntilStruck));
  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), btScalar(-0.145)});
  ball->setLinearVelocity({0, 0, 3});
  for (int tick = 0; tick < 60; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
  EXPECT_FALSE(wall->isWhole());
}

TEST(Regime, TheWayBackIsTheSameInEveryRun) {
  const auto run = [] {
    BulletWorld w;
    btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
    w.destruction->addBody(blockDef({10, 2, 10}, {btScalar(-0.25), 0, btScalar(-0.25)}));
    btRigidBody* crate = w.add(10, shape, {0, btScalar(0.22), 0});
    for (int tick = 0; tick < 60; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
    return std::pair(w.destruction->hash(), crate->getWorldTransform().getOrigin().y());
  };
  EXPECT_EQ(run(), run());
}

// A weight that a force lowers onto what is below it.
class LoweredWeight {
 public:
  LoweredWeight(BulletWorld& w, btScalar rate, btScalar mass, btCollisionShape& shape, const btVector3& at)
      : m_world(w), m_rate(rate), m_mass(mass), m_body(w.add(mass, shape, at)) {
    m_body->setActivationState(DISABLE_DEACTIVATION);
  }
  // Lets a force on the body below grow steadily from `from` to `to` [N] until something breaks; returns the
  // force then, or none.
  std::optional<double> press(double from, double to, double seconds) {
    const int ticks = int(seconds * double(m_rate));
    for (int tick = 0; tick < ticks; ++tick) {
      const double force = from + (to - from) * (tick + 1) / ticks;
      m_body->applyCentralForce({0, m_mass * btScalar(9.81) - btScalar(force), 0});
      m_world.world.stepSimulation(1 / m_rate, 1, 1 / m_rate);
      if (m_world.destruction->counts().springsBroken > 0) return force;
    }
    return std::nullopt;
  }

 private:
  BulletWorld& m_world;
  btScalar m_rate, m_mass;
  btRigidBody* m_body;
};

// A beam of 1 x 0.1 x 0.1 m on two posts 0.05 m wide, 0.9 m apart in the clear, with a plate 0.1 m wide on
// its middle. The moment there, of the force F on the plate and of the beam's own q, is F (l - b / 2) / 4 +
// q (l^2 / 8 - o^2 / 2), o what stands over each end; the stress M / (t^3 / 6).
struct BeamUnderWeight {
  static constexpr double kSpan = 0.88, kOver = 0.06, kThick = 0.1, kPlate = 0.12;

  explicit BeamUnderWeight(btScalar rate) {
    m.youngsModulus *= 4;  // four times as strong as concrete_soft: it carries more than itself
    m.tensileStrength *= 4;
    m.compressiveStrength *= 4;
    w.add(0, post, {btScalar(0.03), btScalar(0.1), btScalar(0.05)});
    w.add(0, post, {btScalar(0.97), btScalar(0.1), btScalar(0.05)});
    DestructibleBodyDef def = blockDef({20, 2, 2}, {0, btScalar(0.2), 0});
    def.material = m;
    beam = w.destruction->addBody(def);
    const double most = 1.5 * forceAt(1) / 9.81;
    weight.emplace(w, rate, btScalar(most), plate, btVector3(btScalar(0.5), btScalar(0.325), btScalar(0.05)));
  }
  // On the plate, for this share of the tensile strength [N].
  double forceAt(double share) const {
    const double modulus = kThick * kThick * kThick / 6,
                 own = m.density * kThick * kThick * 9.81 * (kSpan * kSpan / 8 - kOver * kOver / 2);
    return (share * m.tensileStrength * modulus - own) * 4 / (kSpan - kPlate / 2);
  }

  BulletWorld w;
  Material m = material("concrete_soft");
  btBoxShape post{{btScalar(kOver / 2), btScalar(0.1), btScalar(0.1)}};
  btBoxShape plate{{btScalar(kPlate / 2), btScalar(0.025), btScalar(0.1)}};
  DestructibleBody* beam = nullptr;
  std::optional<LoweredWeight> weight;
};

TEST(Regime, ABeamBreaksUnderAWeightLoweredOnItsMiddle) {
  for (const int rate : kBeamRates) {
    SCOPED_TRACE(rate);
    BeamUnderWeight gentle{btScalar(rate)};
    EXPECT_FALSE(gentle.weight->press(0, gentle.forceAt(0.4), 2));
    EXPECT_FALSE(gentle.weight->press(gentle.forceAt(0.4), gentle.forceAt(0.4), 1));
    EXPECT_TRUE(gentle.beam->isWhole());
    BeamUnderWeight rising{btScalar(rate)};
    const auto broke = rising.weight->press(0, rising.forceAt(1.5), 4);
    ASSERT_TRUE(broke);
    EXPECT_NEAR(*broke, rising.forceAt(1), 0.25 * rising.forceAt(1));
  }
}

// It bends under a load, for which it became elements, and goes back without it. Of that load it knows now.
TEST(Regime, WhatALoadDidNotBreakThawsForALargerOneOnly) {
  BeamUnderWeight c(240);
  EXPECT_FALSE(c.weight->press(0, c.forceAt(0.55), 2));
  EXPECT_FALSE(c.beam->isWhole());
  EXPECT_FALSE(c.weight->press(c.forceAt(0.55), c.forceAt(0.3), 1));
  EXPECT_FALSE(c.weight->press(c.forceAt(0.3), c.forceAt(0.3), 3));
  EXPECT_TRUE(c.beam->isWhole());
  EXPECT_FALSE(c.weight->press(c.forceAt(0.3), c.forceAt(0.7), 2));
  EXPECT_TRUE(c.beam->isWhole());
  EXPECT_FALSE(c.weight->press(c.forceAt(0.7), c.forceAt(0.85), 2));
  EXPECT_FALSE(c.beam->isWhole());
  EXPECT_LT(std::abs(c.w.destruction->ledger().linearError), 1e-4);
}

TEST(Regime, AColumnIsCrushedByAWeightLoweredOnIt) {
  Material m = material("concrete_soft");
  m.tensileStrength = 0.1e6;
  m.compressiveStrength = 0.15e6;
  constexpr double kArea = 0.01, kHeight = 0.3;
  const auto forceAt = [&](double share) {  // at its foot
    return (share * m.compressiveStrength - m.density * kHeight * 9.81) * kArea;
  };
  for (const int rate : {240}) {
    SCOPED_TRACE(rate);
    for (const double share : {0.4, 1.5}) {
      BulletWorld w;
      DestructibleBodyDef def = blockDef({2, 6, 2}, {0, 0, 0});
      def.material = m;
      const DestructibleBody* column = w.destruction->addBody(def);
      btBoxShape plate({btScalar(0.1), btScalar(0.05), btScalar(0.1)});
      LoweredWeight weight(w, btScalar(rate), btScalar(forceAt(1.5) / 9.81), plate,
                           {btScalar(0.05), btScalar(kHeight + 0.05), btScalar(0.05)});
      const auto broke = weight.press(0, forceAt(share), 4);
      EXPECT_EQ(column->isWhole(), share < 1);
      EXPECT_EQ(broke.has_value(), share > 1);
      if (broke) {
        EXPECT_NEAR(*broke, forceAt(1), 0.25 * forceAt(1));
      }
    }
  }
}

// Anchored at one end: sigma = 3 rho g l^2 / t there.
TEST(Regime, ACantileverBreaksByItsOwnWeight) {
  const Material m = material("concrete_soft");
  const double length = std::sqrt(m.tensileStrength * 0.1 / (3 * m.density * 9.81));  // 0.53 m
  const int longer = int(std::ceil(1.1 * length / 0.05));
  for (const int cubes : {longer, longer / 2}) {
    SCOPED_TRACE(cubes);
    BulletWorld w;
    w.world.setGravity({btScalar(9.81), 0, 0});
    DestructibleBodyDef def = blockDef({2, cubes, 2}, {0, btScalar(0.5), 0});
    def.asset =
        std::make_shared<const Asset>(gridAsset({.cubes = {2, cubes, 2}, .edge = 0.05, .anchored = true}));
    def.anchored = true;
    const DestructibleBody* beam = w.destruction->addBody(def);
    for (int tick = 0; tick < 3 * 240; ++tick)
      w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    EXPECT_EQ(w.destruction->counts().springsBroken > 0, cubes == longer);
    EXPECT_EQ(beam->isWhole(), cubes != longer);
  }
}

}  // namespace
}  // namespace rubble::test
