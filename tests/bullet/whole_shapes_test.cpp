// Shapes of whole bodies: shared by the bodies of an asset, of few corners, and in a world.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "bullet/hull_corners.h"
#include "bullet/regime_bodies.h"
#include "bullet/whole_shapes.h"
#include "bullet/whole_solids.h"

namespace rubble::test {
namespace {

TEST(WholeShapes, BodiesOfAnAssetShareTheirShapeAndHaveTheirMass) {
  BulletWorld w;
  DestructibleBodyDef def = defOf(ell());
  DestructibleBody* first = w.destruction->addBody(def);
  def.transform.setOrigin({2, 0, 0});
  def.material.density *= 2;
  DestructibleBody* second = w.destruction->addBody(def);
  ASSERT_TRUE(first->isWhole() && second->isWhole());
  EXPECT_EQ(first->getCollisionShape(), second->getCollisionShape());
  EXPECT_NEAR(double(second->getMass()), 2 * double(first->getMass()), 1e-5 * double(second->getMass()));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(double(first->getInvInertiaDiagLocal()[axis]),
                2 * double(second->getInvInertiaDiagLocal()[axis]),
                1e-5 * double(first->getInvInertiaDiagLocal()[axis]));
  // The one that made it leaves: the other still falls, turns and meets the ground with it.
  w.destruction->removeBody(first);
  DestructibleBody* third = w.destruction->addBody(def);
  EXPECT_EQ(third->getCollisionShape(), second->getCollisionShape());
  w.destruction->removeBody(second);
  for (int tick = 0; tick < 10; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_TRUE(third->isWhole());
}

TEST(WholeShapes, AreForgottenWithTheirAssetAndKnowAssetsOfOneOwnerApart) {
  struct Two {
    Asset a, b;
  };
  auto two = std::make_shared<Two>(Two{*ell(), *table()});
  std::shared_ptr<const Asset> a(two, &two->a), b(two, &two->b);
  bullet::WholeShapes shapes;
  const auto of = [&](const std::shared_ptr<const Asset>& asset) {
    std::vector<double> inertias;
    for (std::size_t i = 0; i < asset->elementCount(); ++i)
      inertias.push_back(asset->volumes[i] * asset->gyrations[i]);
    return shapes.of(asset, asset->volumes, inertias);
  };
  const bullet::WholeShape first = of(a), other = of(b);
  EXPECT_NE(first.shape, other.shape);
  EXPECT_EQ(first.shape, of(a).shape);
  EXPECT_EQ(shapes.assetCount(), 2u);
  // Where all masses are alike the axes are others, and so is the shape.
  const std::vector<double> equal(ell()->elementCount(), 1.0);
  EXPECT_NE(shapes.of(a, equal, equal).shape, first.shape);
  a.reset();
  b.reset();
  two.reset();
  of(ell());
  EXPECT_EQ(shapes.assetCount(), 1u);
  EXPECT_GT(first.parts.size(), 1u);  // what a body has stays
}

// A ball of 2000 points: a polyhedron of n corners in it lacks some 5.6 / n of its volume at the least.
TEST(WholeShapes, AHullOfFewCornersIsNearlyAsLarge) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Matrix3Xd on = bullet::directionsAround(2000);
  for (Eigen::Index i = 0; i < on.cols(); ++i) points.emplace_back(on.col(i));
  const double full = 4 * std::numbers::pi / 3;
  const bullet::ConvexHull few = bullet::hullOfFew(points, 64);
  EXPECT_LE(few.points.size(), 64u);
  EXPECT_GT(few.volume, (1 - 0.13) * full);
  EXPECT_LT(few.volume, full);
  for (const bullet::HullFace& face : few.faces) EXPECT_GT(face.offset, 0.5);  // outwards
}

TEST(WholeShapes, OfABoxWithPointsOnItsFacesTheCornersStay) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x <= 10; ++x)
    for (int y = 0; y <= 10; ++y)
      for (int z = 0; z <= 10; ++z) points.emplace_back(0.1 * x, 0.2 * y, 0.01 * z);
  const bullet::ConvexHull hull = bullet::hullOfFew(points, 64);
  EXPECT_EQ(hull.points.size(), 8u);
  EXPECT_NEAR(hull.volume, 1 * 2 * 0.1, 1e-9);
}

// Two L's that meet at 6 m/s: as elements from the start.
std::uint32_t brokenOfTwo(Regime regime) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = defOf(ell(), regime);
  def.velocity = {3, 0, 0};
  w.destruction->addBody(def);
  def.velocity = {-3, 0, 0};
  def.transform.setOrigin({btScalar(0.45), btScalar(0.02), btScalar(0.01)});
  w.destruction->addBody(def);
  for (int tick = 0; tick < 24; ++tick) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  return w.destruction->counts().springsBroken;
}

TEST(WholeShapes, TwoCompoundsThatStrikeEachOtherBreakAsElementsDo) {
  const std::uint32_t elements = brokenOfTwo(Regime::Elements), whole = brokenOfTwo(Regime::RigidUntilStruck);
  EXPECT_GT(elements, 10u);
  EXPECT_NEAR(double(whole), double(elements), 0.1 * double(elements) + 2);
}

// 0.83 m a tick, onto a plate of 20 mm.
TEST(WholeShapes, AFastCompoundDoesNotPassThroughAThinPlate) {
  btBoxShape plate({2, btScalar(0.01), 2});
  BulletWorld w;
  w.add(0, plate, {0, 0, 0});
  DestructibleBodyDef def = defOf(ell());
  def.transform.setOrigin({0, btScalar(1.3), 0});
  def.velocity = {0, -50, 0};
  DestructibleBody* body = w.destruction->addBody(def);
  ASSERT_TRUE(body->isWhole());
  for (int tick = 0; tick < 6; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
  EXPECT_FALSE(body->isWhole());
  std::size_t below = 0;
  for (const ElementPose& pose : posesOf(*body)) below += double(pose.position.y()) < -0.02;
  EXPECT_EQ(below, 0u);
}

TEST(WholeShapes, RaysAndSweepsFindTheNotchOfAnL) {
  BulletWorld w;
  DestructibleBody* body = w.destruction->addBody(defOf(ell()));
  ASSERT_TRUE(body->isWhole());
  // Down through the notch onto the lower arm, 0.1 m high; beside it onto the upright one, 0.4 m high. A
  // sweep finds the hull, which has a margin of 1 mm, to a tenth of that; Bullet's cast of a ray ends up to 6
  // mm before the same hull.
  for (const auto& [x, top] : {std::pair(0.25, 0.1), std::pair(0.05, 0.4)}) {
    const btVector3 from(btScalar(x), 1, 0), to(btScalar(x), -1, 0);
    btCollisionWorld::ClosestRayResultCallback ray(from, to);
    w.world.rayTest(from, to, ray);
    ASSERT_TRUE(ray.hasHit());
    EXPECT_EQ(ray.m_collisionObject, body);
    EXPECT_NEAR(double(ray.m_hitPointWorld.y()), top, 0.01);
    btSphereShape ball(btScalar(0.02));
    btCollisionWorld::ClosestConvexResultCallback sweep(from, to);
    w.world.convexSweepTest(&ball, btTransform(btQuaternion::getIdentity(), from),
                            btTransform(btQuaternion::getIdentity(), to), sweep);
    ASSERT_TRUE(sweep.hasHit());
    EXPECT_NEAR(1 - 2 * double(sweep.m_closestHitFraction) - 0.02, top + 1e-3, 2e-4);
  }
}

}  // namespace
}  // namespace rubble::test
