// Whole bodies of solids that are not convex: compounds of convex parts.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bullet/convex_hull.h"
#include "bullet/regime_bodies.h"
#include "bullet/whole_shape.h"
#include "bullet/whole_solids.h"

namespace rubble::test {
namespace {

bullet::WholeShape shapeOf(const Asset& asset, double density) {
  std::vector<double> masses, inertias;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    masses.push_back(density * asset.volumes[i]);
    inertias.push_back(masses.back() * asset.gyrations[i]);
  }
  return bullet::wholeShape(asset, bullet::solidHullsOf(asset), bullet::massFrameOf(asset, masses, inertias));
}

void addGround(BulletWorld& w) {
  static btStaticPlaneShape ground({0, 1, 0}, 0);
  w.add(0, ground, {0, 0, 0});
}

TEST(WholeShape, AnLIsItsTwoBoxes) {
  const bullet::WholeShape whole = shapeOf(*ell(), 1000);
  ASSERT_TRUE(whole.shape);
  ASSERT_EQ(whole.parts.size(), 2u);
  double volume = 0;
  for (const auto& part : whole.parts) {
    std::vector<Eigen::Vector3d> corners;
    const auto& hull = dynamic_cast<const btConvexHullShape&>(*part);
    EXPECT_LE(double(hull.getMargin()), 1.001e-3);
    for (int i = 0; i < hull.getNumPoints(); ++i) {
      const btVector3 p = hull.getScaledPoint(i);
      corners.emplace_back(double(p.x()), double(p.y()), double(p.z()));
    }
    EXPECT_EQ(corners.size(), 8u);
    volume += bullet::convexHullOf(corners).volume;
  }
  EXPECT_NEAR(volume, 0.1 * (0.4 * 0.1 + 0.1 * 0.3), 1e-8);
  // About the depth's axis through the centroid: that of two boxes, (a^2 + b^2) / 12 each, by Steiner.
  const double a = 4.0, b = 3.0;  // masses, 1000 kg/m^3
  const Eigen::Vector2d atA(0.2, 0.05), atB(0.05, 0.25), middle = (a * atA + b * atB) / (a + b);
  const double expected =
      a * (0.17 / 12 + (atA - middle).squaredNorm()) + b * (0.1 / 12 + (atB - middle).squaredNorm());
  EXPECT_NEAR(double(whole.inertia[whole.inertia.maxAxis()]), expected, 0.01 * expected);
  EXPECT_NEAR(whole.mass, 7, 1e-6);
}

TEST(WholeShape, AnLStandsWholeAndSleepsWithoutSubsteps) {
  BulletWorld w;
  addGround(w);
  const DestructibleBody* body = w.destruction->addBody(defOf(ell()));
  ASSERT_TRUE(body->isWhole());
  for (int tick = 0; tick < 300; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1);
    ASSERT_EQ(w.destruction->lastSubsteps(), 0) << tick;
  }
  EXPECT_TRUE(body->isWhole());
  EXPECT_TRUE(body->isAsleep());
}

TEST(WholeShape, ABallRollsBetweenTheLegsOfATable) {
  BulletWorld w;
  addGround(w);
  const DestructibleBody* body = w.destruction->addBody(defOf(table()));
  ASSERT_TRUE(body->isWhole());
  btRigidBody* ball = w.add(5, w.ballShape, {0, btScalar(0.1), -1});
  ball->setLinearVelocity({0, 0, 4});
  ball->setAngularVelocity({40, 0, 0});
  for (int tick = 0; tick < 60; ++tick) {
    w.world.stepSimulation(btScalar(1) / 60, 1);
    ASSERT_TRUE(body->isWhole()) << tick;
  }
  EXPECT_NEAR(double(ball->getWorldTransform().getOrigin().z()), 3, 0.05);
  EXPECT_NEAR(double(ball->getWorldTransform().getOrigin().x()), 0, 0.01);
}

struct TableBlow {
  std::uint32_t broken;
  double exit;
};

// A ball onto the side of a leg.
TableBlow strikeLeg(Regime regime) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  const DestructibleBody* body = w.destruction->addBody(defOf(table(), regime));
  EXPECT_EQ(body->isWhole(), regime == Regime::RigidUntilStruck);
  btRigidBody* ball = w.add(10, w.ballShape, {btScalar(-0.445), btScalar(0.15), 0});
  ball->setLinearVelocity({10, 0, 0});
  for (int tick = 0; tick < 12; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_LT(std::abs(w.destruction->ledger().linearError), 1e-4);
  return {w.destruction->counts().springsBroken, double(ball->getLinearVelocity().x())};
}

TEST(WholeShape, ABlowBreaksATableAsItsElements) {
  const TableBlow elements = strikeLeg(Regime::Elements), whole = strikeLeg(Regime::RigidUntilStruck);
  EXPECT_GT(elements.broken, 50u);
  EXPECT_NEAR(double(whole.broken), double(elements.broken), 0.05 * double(elements.broken));
  EXPECT_NEAR(whole.exit, elements.exit, 0.05 * std::abs(elements.exit));
}

TEST(WholeShape, MomentaOfAnLSurviveTheThawAndTheWayBack) {
  constexpr btScalar kRate = 240;
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = defOf(ell());
  def.transform = btTransform(btQuaternion({1, 2, 3}, btScalar(0.7)), {0, 2, 0});
  def.velocity = {btScalar(0.06), btScalar(0.03), btScalar(-0.05)};
  def.spin = {btScalar(0.1), btScalar(-0.1), btScalar(0.05)};
  DestructibleBody* body = w.destruction->addBody(def);
  ASSERT_TRUE(body->isWhole());
  const Momenta first(*body);
  for (const bool whole : {false, true}) {
    if (!whole) w.destruction->strike(body);
    ASSERT_LT(ticksUntil(w, *body, whole, kRate, 240), 240);
    const Momenta now(*body);
    EXPECT_LT(double((now.linear - first.linear).length() / first.linear.length()), 1e-5);
    EXPECT_LT(double((now.angular - first.angular).length() / first.angular.length()), 1e-5);
  }
}

// A crate falls 20 mm onto the top: elements once, and back for good.
TEST(WholeShape, ATableUnderACrateGoesBackToBulletAndSleeps) {
  btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  BulletWorld w;
  addGround(w);
  DestructibleBody* body = w.destruction->addBody(defOf(table()));
  btRigidBody* crate = w.add(5, shape, {0, btScalar(0.62), 0});
  ASSERT_LT(ticksUntil(w, *body, false, 60, 60), 60);
  ASSERT_LT(ticksUntil(w, *body, true, 60, 240), 240);
  for (int tick = 0; tick < 300; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_TRUE(body->isWhole());
  EXPECT_TRUE(body->isAsleep());
  EXPECT_FALSE(crate->isActive());
  EXPECT_NEAR(double(crate->getWorldTransform().getOrigin().y()), 0.6, 2e-3);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
}

}  // namespace
}  // namespace rubble::test
