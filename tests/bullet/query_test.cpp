// What applications ask Bullet about a destructible body: rays, sweeps, contact tests, manifolds.
#include <gtest/gtest.h>

#include "bullet/bullet_world.h"

namespace rubble::test {
namespace {

// Front of the small wall's elements for something that comes along +z: its cells begin at -0.04 m, its
// spheres at most one radius behind.
void expectAtFront(double z) {
  EXPECT_GE(z, -0.04 - 1e-4);
  EXPECT_LE(z, -0.04 + smallWall()->radius);
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
  EXPECT_LT(near.deepest, -0.04 + smallWall()->radius);
  EXPECT_GE(near.deepest, -0.04 - 1e-4);
  EXPECT_EQ(w.destruction->hash(), before);
  w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
  EXPECT_TRUE(w.destruction->takeEvents().contacts.empty()) << "a query became a contact";
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

}  // namespace
}  // namespace rubble::test
