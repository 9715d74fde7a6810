// Bullet's transform of a body of elements: where it is, as the application sees it, and what asks through
// it.
#include <gtest/gtest.h>

#include <cmath>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

constexpr btScalar kFollowTick = btScalar(1) / 240;

void stepTicks(BulletWorld& w, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) w.world.stepSimulation(kFollowTick, 1, kFollowTick);
}

double turnBetween(const btTransform& a, const btTransform& b) {
  const btMatrix3x3 turn = a.getBasis().transposeTimes(b.getBasis());
  btVector3 axis(turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]);
  return std::asin(std::min(1.0, 0.5 * double(axis.length())));
}

// 0.3 x 0.2 x 0.2 m, its lowest corner at the asset's origin.
DestructibleBodyDef flyingBlock(Regime regime) {
  DestructibleBodyDef def = blockDef({6, 4, 4}, {0, 3, 0}, regime);
  def.transform.setRotation(btQuaternion({0, 0, 1}, btScalar(0.4)));
  return def;
}

// Against a box of Bullet's of the same mass and inertia. Without forces both are exact for a spin about an
// axis of inertia, but for the stretch by the spin: w^2 L^2 rho / E = 4e-5 of the angle, and rounding.
TEST(Follow, FliesAndTurnsAsABulletBox) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = flyingBlock(Regime::Elements);
  def.velocity = {1, 2, btScalar(-0.5)};
  def.spin = {0, 0, 2};
  const DestructibleBody* block = w.destruction->addBody(def);
  btBoxShape shape({btScalar(0.15), btScalar(0.1), btScalar(0.1)});
  btRigidBody* box = w.add(btScalar(block->elementMass()), shape, {0, 0, 0});
  btTransform at = def.transform;
  at.setOrigin(def.transform * btVector3(btScalar(0.15), btScalar(0.1), btScalar(0.1)));
  EXPECT_LT((block->getWorldTransform().getOrigin() - at.getOrigin()).length(), btScalar(1e-6));
  EXPECT_LT(turnBetween(block->getWorldTransform(), at), 1e-6);
  box->setWorldTransform(at);
  box->setInterpolationWorldTransform(at);
  box->setIgnoreCollisionCheck(block, true);
  box->setLinearVelocity(def.velocity);
  box->setAngularVelocity(def.spin);
  stepTicks(w, 120);
  for (const btTransform& shown :
       {block->getCenterOfMassTransform(), block->getInterpolationWorldTransform()}) {
    EXPECT_LT((shown.getOrigin() - box->getWorldTransform().getOrigin()).length(), btScalar(2e-5));
    EXPECT_LT(turnBetween(shown, box->getWorldTransform()), 2e-4);
  }
  EXPECT_NEAR(double(block->getLocalInertia().x()), double(box->getLocalInertia().x()), 1e-3);
  EXPECT_NEAR(double(block->getLocalInertia().z()), double(box->getLocalInertia().z()), 1e-3);
}

// Bullet's steps put the box g t dt / 2 below the parabola, 10 mm; ours are a thirtieth as long.
TEST(Follow, FallsAsAThrownBody) {
  BulletWorld w;
  DestructibleBodyDef def = flyingBlock(Regime::Elements);
  def.velocity = {1, 2, 0};
  const DestructibleBody* block = w.destruction->addBody(def);
  const btVector3 from = block->getCenterOfMassPosition();
  stepTicks(w, 120);
  const btVector3 expected = from + btVector3(btScalar(0.5), btScalar(1 - 9.81 / 8), 0);
  EXPECT_LT((block->getCenterOfMassPosition() - expected).length(), btScalar(5e-4));
}

// What becomes elements, and what was never whole, stand where Bullet's rigid body would.
TEST(Follow, AWholeBodyDoesNotJumpWhenItBecomesElements) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* block = w.destruction->addBody(flyingBlock(Regime::RigidUntilStruck));
  DestructibleBodyDef def = flyingBlock(Regime::Elements);
  def.transform.getOrigin().setX(2);
  const DestructibleBody* other = w.destruction->addBody(def);
  stepTicks(w, 2);
  ASSERT_TRUE(block->isWhole());
  const btTransform before = block->getWorldTransform();
  w.destruction->strike(block);
  stepTicks(w, 2);
  ASSERT_FALSE(block->isWhole());
  const btTransform after = block->getWorldTransform();
  EXPECT_LT((after.getOrigin() - before.getOrigin()).length(), btScalar(1e-6));
  EXPECT_LT(turnBetween(after, before), 1e-6);
  EXPECT_LT((other->getWorldTransform().getOrigin() - before.getOrigin() - btVector3(2, 0, 0)).length(),
            btScalar(1e-6));
  EXPECT_LT(turnBetween(other->getWorldTransform(), before), 1e-6);
}

// A quarter of a turn on and far from where it was: a ray, a sweep, a contact test and bounds, all at the
// face of 0.3 m x 0.2 m that then is at its place + 0.1 m along z.
TEST(Follow, QueriesFindItWhereItHasFlown) {
  BulletWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = blockDef({6, 4, 4}, {0, 3, 0}, Regime::Elements);
  def.velocity = {4, 0, 0};
  def.spin = {0, 0, btScalar(3.14159265 * 0.5 / 0.5)};
  DestructibleBody* block = w.destruction->addBody(def);
  stepTicks(w, 120);
  const btVector3 centre = block->getCenterOfMassPosition();
  EXPECT_NEAR(double(centre.x()), 2.15, 1e-3);
  // Now 0.2 m wide and 0.3 m high.
  for (const btVector3& off : {btVector3(0, btScalar(0.13), 0), btVector3(btScalar(0.08), 0, 0)}) {
    const btVector3 from = centre + off + btVector3(0, 0, 1), to = from - btVector3(0, 0, 2);
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    w.world.rayTest(from, to, hit);
    ASSERT_TRUE(hit.hasHit());
    EXPECT_NEAR(double(hit.m_hitPointWorld.z() - centre.z()), 0.1, 1e-4);
    EXPECT_NEAR(double(hit.m_hitNormalWorld.z()), 1, 1e-4);
    btSphereShape pea(btScalar(0.01));
    btCollisionWorld::ClosestConvexResultCallback swept(from, to);
    w.world.convexSweepTest(&pea, btTransform(btQuaternion::getIdentity(), from),
                            btTransform(btQuaternion::getIdentity(), to), swept);
    ASSERT_TRUE(swept.hasHit());
    EXPECT_NEAR(1 - 2 * double(swept.m_closestHitFraction), 0.11, 2e-4);
    EXPECT_NEAR(double(swept.m_hitNormalWorld.z()), 1, 1e-3);
  }
  const btVector3 beside = centre + btVector3(btScalar(0.13), 0, 1);
  btCollisionWorld::ClosestRayResultCallback miss(beside, beside - btVector3(0, 0, 2));
  w.world.rayTest(beside, beside - btVector3(0, 0, 2), miss);
  EXPECT_FALSE(miss.hasHit());
  btVector3 low, high;
  block->getAabb(low, high);
  EXPECT_LT(double((0.5 * (low + high) - centre).length()), 0.01);
}

// Two halves fly apart: as one body they turn about the centre of both, with the heavier.
TEST(Follow, WhatIsBrokenHasItsPlaceInItsCentreOfMass) {
  BulletWorld w;
  DestructibleBodyDef def = blockDef({6, 1, 1}, {0, 2, 0}, Regime::Elements);
  def.material.tensileStrength = 1e3;
  def.material.compressiveStrength = 1e6;
  const DestructibleBody* beam = w.destruction->addBody(def);
  w.add(0, w.ballShape, {btScalar(0.1), btScalar(1.8), btScalar(0.02)});
  stepTicks(w, 120);
  ASSERT_GT(w.destruction->counts().fragments, 1u);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const ElementPose& e : posesOf(*beam)) centre += e.position.cast<double>() / 6;
  const btVector3 shown = beam->getCenterOfMassPosition();
  EXPECT_LT((centre - Eigen::Vector3d(double(shown.x()), double(shown.y()), double(shown.z()))).norm(), 1e-5);
}

}  // namespace
}  // namespace rubble::test
