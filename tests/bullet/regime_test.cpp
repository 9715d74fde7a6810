// Bodies that are Bullet's until they are struck.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

// A comb of 24 teeth of 0.02 x 0.2 m, as far apart as they are wide: 16 parts do not fit it.
std::shared_ptr<const Asset> comb() {
  constexpr std::uint32_t kTeeth = 24, kPoints = 2 + 4 * kTeeth;
  constexpr double kWidth = 0.02, kBase = 0.05, kTop = 0.25, kDepth = 0.03;
  SurfaceMesh mesh;
  for (const double z : {0.0, kDepth}) {
    mesh.vertices.emplace_back(0, 0, z);
    mesh.vertices.emplace_back((2 * kTeeth - 1) * kWidth, 0, z);
    for (std::uint32_t tooth = kTeeth; tooth-- > 0;) {
      const double left = 2 * tooth * kWidth, right = left + kWidth;
      mesh.vertices.emplace_back(right, kBase, z);
      mesh.vertices.emplace_back(right, kTop, z);
      mesh.vertices.emplace_back(left, kTop, z);
      mesh.vertices.emplace_back(left, kBase, z);
    }
  }
  const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({c, b, a});
    mesh.triangles.push_back({a + kPoints, b + kPoints, c + kPoints});
  };
  for (std::uint32_t tooth = 0, last = 1; tooth < kTeeth; ++tooth) {
    const std::uint32_t first = 2 + 4 * tooth;
    addTriangle(0, last, first);
    addTriangle(0, first, first + 3);
    addTriangle(first, first + 1, first + 2);
    addTriangle(first, first + 2, first + 3);
    last = first + 3;
  }
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const std::uint32_t j = (i + 1) % kPoints;
    mesh.triangles.push_back({i, j, j + kPoints});
    mesh.triangles.push_back({i, j + kPoints, i + kPoints});
  }
  CookOptions options;
  options.elements = 1000;
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
  // A solid whose elements have another centre of mass than it, as those of few elements may.
  const auto shifted = std::make_shared<Asset>(*def.asset);
  for (Eigen::Vector3d& place : shifted->positions) place.y() += 0.05 * shifted->radius;
  def.asset = shifted;
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

// What gravity adds on the last bit of the way makes the blow: Bullet would take the block 9 mm deep first.
TEST(Regime, WhatFallsIsElementsBeforeItIsInTheGround) {
  BulletWorld w;
  const DestructibleBody* block = w.destruction->addBody(blockDef({4, 2, 4}, {0, btScalar(0.01), 0}));
  bool struck = false;
  for (int tick = 0; tick < 60; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1);
    if (block->isWhole()) continue;
    struck = true;
    for (const ElementPose& e : posesOf(*block)) EXPECT_GT(double(e.position.y()) - 0.025, -5e-4) << tick;
  }
  EXPECT_TRUE(struck);
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

// Bullet's gyroscopic term is one Newton step over a tick, in which it turns five times.
TEST(Regime, WhatTurnsManyTimesATickGetsNoEnergyByIt) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = blockDef({2, 6, 10}, {0, 5, 0});
  def.spin = {300, 2000, 200};
  const DestructibleBody* plate = w.destruction->addBody(def);
  const auto energy = [&] { return double(plate->angularMomentum().dot(plate->getAngularVelocity())); };
  const double begin = energy();
  for (int tick = 0; tick < 60; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    ASSERT_LE(energy(), 1.05 * begin) << tick;
  }
  EXPECT_EQ(w.destruction->failure(), "");
  // Slow again it has the term back, as the application's flags say.
  const_cast<DestructibleBody*>(plate)->setAngularVelocity({1, 2, 1});
  w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
  EXPECT_NE(plate->getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY, 0);
}

// What waits thaws in the next ones.
TEST(Regime, NoMoreThawInATickThanTheSettingSays) {
  DestructionDef definition;
  definition.maxThaws = 2;
  BulletWorld w(definition);
  std::vector<DestructibleBody*> blocks;
  for (int i = 0; i < 5; ++i) {
    blocks.push_back(w.destruction->addBody(blockDef({2, 2, 2}, {btScalar(i), 0, 0})));
    w.destruction->strike(blocks.back());
  }
  const auto thawed = [&] {
    return std::count_if(blocks.begin(), blocks.end(), [](const auto* b) { return !b->isWhole(); });
  };
  for (const int expected : {2, 4, 5}) {
    w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    EXPECT_EQ(thawed(), expected);
  }
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

TEST(Regime, ASolidThatFewConvexPartsDoNotFitStaysElementsAndThatIsSaid) {
  std::vector<std::string> lines;
  DestructionDef definition;
  definition.log = [&](LogLevel level, const std::string& line) {
    EXPECT_EQ(level, LogLevel::Info) << line;
    lines.push_back(line);
  };
  BulletWorld w(definition);
  DestructibleBodyDef def = blockDef({1, 1, 1}, {0, 0, 0});
  def.asset = comb();
  EXPECT_FALSE(w.destruction->addBody(def)->isWhole());
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find(": is elements from the start: few convex parts"), std::string::npos)
      << lines.back();
}

}  // namespace
}  // namespace rubble::test
