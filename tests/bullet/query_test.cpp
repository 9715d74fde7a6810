// What applications ask Bullet about a destructible body: rays, sweeps, contact tests, manifolds.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bullet/bullet_world.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

// Front of the small wall for something that comes along +z; sweeps stop 0.1 mm before it.
void expectAtFront(double z) {
  EXPECT_GE(z, -0.04 - 1.1e-4);
  EXPECT_LE(z, -0.04 + 1e-5);
}

TEST(Query, RayHitsTheFrontElement) {
  BulletWorld w;
  const DestructibleBody* wall = w.addWall(material("concrete_soft"));
  const btVector3 from(0, btScalar(0.25), -2), to(0, btScalar(0.25), 2);
  btCollisionWorld::ClosestRayResultCallback hit(from, to);
  w.world.rayTest(from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_EQ(hit.m_collisionObject, wall);
  expectAtFront(double(hit.m_hitPointWorld.z()));
}

TEST(Query, SweptBallStopsAtTheFront) {
  BulletWorld w;
  const DestructibleBody* wall = w.addWall(material("concrete_soft"));
  const btTransform from(btQuaternion::getIdentity(), {0, btScalar(0.25), -2}),
      to(btQuaternion::getIdentity(), {0, btScalar(0.25), 2});
  btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
  w.world.convexSweepTest(&w.ballShape, from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_EQ(hit.m_hitCollisionObject, wall);
  expectAtFront(-2 + 4 * double(hit.m_closestHitFraction) + double(w.ballShape.getRadius()));
  EXPECT_LT(double(hit.m_hitNormalWorld.z()), -0.5);
}

TEST(Query, SweepBesideTheWallIsFree) {
  BulletWorld w;
  w.addWall(material("concrete_soft"));
  // The wall ends at x = 0.25 m; the ball's side passes 5 mm beside it.
  const btTransform from(btQuaternion::getIdentity(), {btScalar(0.355), btScalar(0.25), -2}),
      to(btQuaternion::getIdentity(), {btScalar(0.355), btScalar(0.25), 2});
  btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
  w.world.convexSweepTest(&w.ballShape, from, to, hit);
  EXPECT_FALSE(hit.hasHit());
}

// A free wall across z, 1 x 1 m.
struct WallCase {
  const char* name;
  double thickness;
  std::size_t elements;
  double radius;  // 0: by the number of elements
};

class QueryWall : public testing::TestWithParam<WallCase> {
 protected:
  QueryWall() {
    w.world.setGravity({0, 0, 0});
    CookOptions options;
    options.elements = GetParam().elements;
    options.radius = GetParam().radius;
    def.asset = std::make_shared<const Asset>(cookStrictly(boxMesh({1, 1, GetParam().thickness}), options));
    def.material = material("concrete_soft");
    def.anchored = false;
    def.regime = Regime::Elements;
    def.transform.setOrigin({0, 5, 0});
  }
  void addAndStep(int ticks) {
    wall = w.destruction->addBody(def);
    for (int i = 0; i < ticks; ++i) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  }
  // A place of the wall's inner 0.9 x 0.9 m, in its own axes.
  btVector3 place(double z) {
    std::uniform_real_distribution<float> along(-0.45F, 0.45F);
    return {btScalar(along(random)), btScalar(along(random)), btScalar(z)};
  }

  BulletWorld w;
  DestructibleBodyDef def;
  DestructibleBody* wall = nullptr;
  std::mt19937 random{7};
};

struct ElementRay : btCollisionWorld::ClosestRayResultCallback {
  using ClosestRayResultCallback::ClosestRayResultCallback;
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool inWorld) override {
    element = result.m_localShapeInfo ? result.m_localShapeInfo->m_triangleIndex : -1;
    return ClosestRayResultCallback::addSingleResult(result, inWorld);
  }
  int element = -1;
};

// How far a place is from the nearest of a cell's triangles on the surface, by the edges that it is outside
// of [m].
double outsideOf(const Asset& asset, std::size_t element, const Eigen::Vector3d& place) {
  double nearest = 1;
  const Cell& cell = asset.cells[element];
  for (std::uint32_t t = 0; t < cell.outerTriangles; ++t) {
    Eigen::Vector3d at[3];
    for (int k = 0; k < 3; ++k)
      at[k] = asset.vertices[asset.corners[asset.triangles[cell.firstTriangle + t][k]].vertex]
                  .position.cast<double>();
    const Eigen::Vector3d normal = (at[1] - at[0]).cross(at[2] - at[0]).normalized();
    double outside = std::abs(normal.dot(place - at[0]));
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d out = (at[(k + 1) % 3] - at[k]).cross(normal).normalized();
      outside = std::max(outside, out.dot(place - at[k]));
    }
    nearest = std::min(nearest, outside);
  }
  return nearest;
}

// Expected: the plane of the face, in one of the triangles of the cell that is hit.
TEST_P(QueryWall, EveryRayHitsTheFace) {
  def.transform.setRotation(btQuaternion({0, 1, 0}, btScalar(0.5)));
  addAndStep(1);
  const double half = GetParam().thickness / 2;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const btVector3 at = place(1);
    const btVector3 from = def.transform * at, to = def.transform * btVector3(at.x(), at.y(), -1);
    ElementRay hit(from, to);
    w.world.rayTest(from, to, hit);
    if (!hit.hasHit() || hit.m_collisionObject != wall) continue;
    ++hits;
    const btVector3 point = def.transform.inverse() * hit.m_hitPointWorld;
    ASSERT_NEAR(double(point.z()), half, 1e-5);
    ASSERT_NEAR(double(hit.m_hitNormalWorld.dot(def.transform.getBasis().getColumn(2))), 1, 1e-5);
    ASSERT_GE(hit.element, 0);
    const Eigen::Vector3d x(double(point.x()), double(point.y()), double(point.z()));
    ASSERT_LT(outsideOf(*def.asset, std::size_t(hit.element), x), 1e-5);
  }
  EXPECT_EQ(hits, 2000);
}

// Of a whole body Bullet knows no index: the body tells it of the place. The same ray in another state.
TEST_P(QueryWall, TellsWhichElementWasHitInEitherState) {
  def.transform.setRotation(btQuaternion({0, 1, 0}, btScalar(0.5)));
  for (const Regime regime : {Regime::Elements, Regime::RigidUntilStruck}) {
    def.regime = regime;
    addAndStep(1);
    ASSERT_EQ(wall->isWhole(), regime == Regime::RigidUntilStruck);
    for (int i = 0; i < 200; ++i) {
      const btVector3 at = place(1);
      const btVector3 from = def.transform * at, to = def.transform * btVector3(at.x(), at.y(), -1);
      ElementRay hit(from, to);
      w.world.rayTest(from, to, hit);
      ASSERT_EQ(hit.m_collisionObject, wall);
      // Bullet's rays end before a box, by up to 1 cm.
      const btVector3 point = def.transform.inverse() * hit.m_hitPointWorld;
      ASSERT_NEAR(double(point.z()), GetParam().thickness / 2, wall->isWhole() ? 0.01 : 1e-5);
      const std::uint32_t element = wall->elementAt(hit.m_hitPointWorld);
      ASSERT_LT(element, def.asset->elementCount());
      const Eigen::Vector3d onFace(double(point.x()), double(point.y()), GetParam().thickness / 2);
      // 1 cm before it the next cell is as near within sqrt(2 x 1 cm x the rounding of a place, 1 um).
      ASSERT_LT(outsideOf(*def.asset, element, onFace), wall->isWhole() ? 1.5e-4 : 1e-5);
    }
    w.destruction->removeBody(wall);
  }
}

// Sweeps stop 0.1 mm before the surface.
TEST_P(QueryWall, EverySmallBallStopsAtTheFace) {
  addAndStep(1);
  const btSphereShape ball(btScalar(0.005));
  int hits = 0;
  for (int i = 0; i < 100; ++i) {
    const btVector3 at = place(1);
    const btTransform from(btQuaternion::getIdentity(), def.transform * at);
    const btTransform to(btQuaternion::getIdentity(), def.transform * btVector3(at.x(), at.y(), -1));
    btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
    w.world.convexSweepTest(&ball, from, to, hit);
    if (!hit.hasHit() || hit.m_hitCollisionObject != wall) continue;
    ++hits;
    const double gap = 1 - 2 * double(hit.m_closestHitFraction) - 0.005 - GetParam().thickness / 2;
    ASSERT_GT(gap, -1e-5);
    ASSERT_LT(gap, 1.1e-4);
    ASSERT_NEAR(double(hit.m_hitNormalWorld.z()), 1, 1e-3);
  }
  EXPECT_EQ(hits, 100);
}

TEST_P(QueryWall, RaysFollowItAsItFlies) {
  def.velocity = {0, 0, 6};
  def.spin = {0, 0, 4};
  addAndStep(4);
  for (int i = 0; i < 100; ++i) {
    // Within the circle that the square holds however it has turned.
    const btVector3 from = def.transform * (btScalar(0.7) * place(3 / 0.7)), to = from - btVector3(0, 0, 4);
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    w.world.rayTest(from, to, hit);
    ASSERT_TRUE(hit.hasHit());
    ASSERT_NEAR(double(hit.m_hitPointWorld.z()), 0.1 + GetParam().thickness / 2, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Query, QueryWall,
                         testing::Values(WallCase{"Demo", 0.08, 2048, 0.0165},
                                         WallCase{"Coarse", 0.08, 300, 0},
                                         WallCase{"Pane", 0.006, 400, 0.003}),
                         [](const auto& wall) { return wall.param.name; });

// A ray in each tick, straight at the wall.
struct AskingAction : btActionInterface {
  void updateAction(btCollisionWorld* world, btScalar) override {
    const btVector3 from(0, btScalar(0.25), -1), to(0, btScalar(0.25), 1);
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    world->rayTest(from, to, hit);
    hits += hit.hasHit();
  }
  void debugDraw(btIDebugDraw*) override {}
  int hits = 0;
};

TEST(Query, ActionsThatRunFirstSeeTheWall) {
  BulletWorld w;
  w.destruction.reset();
  AskingAction action;
  w.world.addAction(&action);
  DestructionDef def;
  def.log = strictLog();
  w.destruction = std::make_unique<Destruction>(w.world, def);
  w.addWall(material("concrete_soft"));
  for (int i = 0; i < 4; ++i) w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_EQ(action.hits, 4);
}

TEST(Query, LongRodTurningInItsSweepHits) {
  BulletWorld w;
  w.addWall(material("concrete_soft"));
  // Upright beside the wall, which ends at x = 0.25 m and y = 0.5 m; its upper half turns towards it.
  btCapsuleShape rod(btScalar(0.01), 1);
  const btVector3 at(btScalar(0.5), btScalar(0.25), 0);
  const btTransform from(btQuaternion::getIdentity(), at), to(btQuaternion({0, 0, 1}, btScalar(1.5)), at);
  btCollisionWorld::ClosestConvexResultCallback hit(at, at);
  hit.m_collisionFilterMask = btBroadphaseProxy::DefaultFilter;  // not the ground
  w.world.convexSweepTest(&rod, from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  // Its side meets the wall's upper edge, which is 0.25 m above and 0.25 m beside its middle: at 45 degrees
  // less what its radius takes. A sweep ends 0.1 mm before.
  const double lever = std::hypot(0.25, 0.25);
  const double angle = std::atan2(0.25, 0.25) - std::asin((0.01 + 1e-4) / lever);
  EXPECT_NEAR(1.5 * double(hit.m_closestHitFraction), angle, 3e-4);
}

struct Contacts : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    ++count;
    deepest = std::min(deepest, double(point.getDistance()));
    return 0;
  }
  int count = 0;
  double deepest = 1;
};

TEST(Query, ContactTestTellsAndTouchesNothing) {
  BulletWorld w;
  DestructibleBody* wall = w.addWall(material("concrete_soft"));
  btCollisionObject ghost;
  ghost.setCollisionShape(&w.ballShape);
  const std::uint64_t before = w.destruction->hash();
  Contacts far, near;
  ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(0.25), btScalar(-0.2)}));
  w.world.contactPairTest(&ghost, wall, far);
  EXPECT_EQ(far.count, 0);
  // 40 mm into the cells.
  ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(0.25), btScalar(-0.1)}));
  w.world.contactPairTest(&ghost, wall, near);
  EXPECT_GT(near.count, 0);
  EXPECT_NEAR(near.deepest, -0.04, 1e-5);
  EXPECT_EQ(w.destruction->hash(), before);
  w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_TRUE(w.destruction->takeEvents().contacts.empty()) << "a query became a contact";
}

// By the plane of the wall's face, z = -0.04 m.
TEST(Query, ContactTestTellsTheDepthInTheCells) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});  // under its weight the wall leans by 0.01 mm
  DestructibleBody* wall = w.addWall(material("concrete_soft"));
  btBoxShape box({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  btStaticPlaneShape plane({0, 0, 1}, btScalar(-0.035));
  btCompoundShape compound;
  compound.addChildShape(btTransform(btQuaternion::getIdentity(), {0, 0, btScalar(-0.3)}), &box);
  struct Case {
    const char* name;
    btCollisionShape* shape;
    double z, depth;
  };
  for (const Case& c : {Case{"box", &box, -0.13, 0.01}, Case{"box beyond its margin", &box, -0.09, 0.05},
                        Case{"box in a compound", &compound, 0.17, 0.01}, Case{"plane", &plane, 0, 0.005}}) {
    btCollisionObject ghost;
    ghost.setCollisionShape(c.shape);
    ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(0.25), btScalar(c.z)}));
    Contacts first, second;
    w.world.contactPairTest(&ghost, wall, first);
    w.world.contactPairTest(wall, &ghost, second);
    EXPECT_NEAR(first.deepest, -c.depth, 1e-4) << c.name;
    EXPECT_NEAR(second.deepest, -c.depth, 1e-4) << c.name;
  }
  // Between the spheres, too, which touch the face here and there.
  btSphereShape pea(btScalar(0.005));
  btCollisionObject ghost;
  ghost.setCollisionShape(&pea);
  for (int i = 0; i < 100; ++i) {
    ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(),
                                        {btScalar(-0.2 + 0.004 * i), btScalar(0.25), btScalar(-0.042)}));
    Contacts contacts;
    w.world.contactPairTest(&ghost, wall, contacts);
    EXPECT_NEAR(contacts.deepest, -0.003, 1e-5) << "place " << i;
  }
}

TEST(Query, ManifoldShowsTheBlowAndBulletLeavesItAlone) {
  DestructionDef definition;
  definition.breaking = false;
  BulletWorld w(definition);
  w.world.setGravity({0, 0, 0});
  DestructibleBody* wall = w.addWall(material("concrete_soft"));
  btRigidBody* ball = w.add(1, w.ballShape, {0, btScalar(0.25), btScalar(-0.2)});
  ball->setLinearVelocity({0, 0, 5});
  double shown = 0, given = 0;
  for (int tick = 0; tick < 24; ++tick) {
    w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    for (const ContactImpulse& c : w.destruction->takeEvents().contacts)
      if (c.other == ball) given += double(c.impulse);
    for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold* manifold = w.dispatcher.getManifoldByIndexInternal(m);
      if (manifold->getBody0() != wall && manifold->getBody1() != wall) continue;
      if (manifold->getBody0() != ball && manifold->getBody1() != ball) continue;
      for (int c = 0; c < manifold->getNumContacts(); ++c) {
        shown += double(manifold->getContactPoint(c).getAppliedImpulse());
        // Under the ball: x^2 + (y - 0.25)^2 < r^2.
        const btVector3 off =
            manifold->getContactPoint(c).getPositionWorldOnA() - btVector3(0, btScalar(0.25), 0);
        EXPECT_LT(double(off.x() * off.x() + off.y() * off.y()), 0.01);
      }
    }
  }
  EXPECT_GT(given, 1);
  // A blow that begins and ends within one tick is over when the next manifold is made.
  EXPECT_GT(shown, 0.5 * given);
  EXPECT_LE(shown, given * (1 + 1e-5));
  EXPECT_LT(double(ball->getLinearVelocity().z()), 0);
}

// Rubble on the ground, while more and more of it sleeps: the lowest sphere is at the manifold's deepest
// point.
TEST(Query, ManifoldShowsWhatSleepsAndWhatMoves) {
  BulletWorld w;
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = std::make_shared<const Asset>(gridAsset({{8, 2, 4}, 0.05, Eigen::Vector3d::Zero()}));
  def.anchored = false;
  DestructibleBody* slab = w.destruction->addBody(def);
  btRigidBody* ball = w.add(20, w.ballShape, {btScalar(0.2), btScalar(0.25), btScalar(0.1)});
  ball->setLinearVelocity({0, -10, 0});
  int looked = 0;
  std::vector<ElementPose> poses(slab->asset()->elementCount());
  for (int tick = 0; tick < 480; ++tick) {
    if (tick == 40) w.remove(ball);
    w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    slab->poses(poses);
    double lowest = 1;
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (slab->elementsAlive()[i]) lowest = std::min(lowest, double(poses[i].position.y()));
    // The manifold is of the tick's beginning: nothing may move by more in it than 1e-4.
    if (slab->isAsleep() || tick < 120) continue;
    for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold* manifold = w.dispatcher.getManifoldByIndexInternal(m);
      double deepest = 1;
      for (int c = 0; c < manifold->getNumContacts(); ++c)
        deepest = std::min(deepest, double(manifold->getContactPoint(c).getDistance()));
      EXPECT_EQ(manifold->getNumContacts(), 4);
      EXPECT_NEAR(deepest, lowest - slab->asset()->radius, 1e-4) << tick;
      ++looked;
    }
  }
  EXPECT_GT(w.destruction->counts().fragments, 3u);
  EXPECT_GT(looked, 30);
}

}  // namespace
}  // namespace rubble::test
