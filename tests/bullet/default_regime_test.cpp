// What an application gets that fills in asset and material and leaves the rest as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

DestructibleBodyDef plainDef(std::shared_ptr<const Asset> asset) {
  DestructibleBodyDef def;
  def.asset = std::move(asset);
  def.material = material("concrete_soft");
  return def;
}

void tickDefault(BulletWorld& w, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) w.world.stepSimulation(btScalar(1) / 60, 1);
}

// Expected: Bullet's for 60 ticks, as cooked but for the sag of rho g H^2 / 2 E = 98 um of its pre-stress,
// and no event; then what a ball breaks that is 27 times as fast as the 0.37 m/s that strike it.
TEST(DefaultBody, AWallIsWholeAndFreeUntilABallBreaksIt) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(plainDef(smallWall()));
  ASSERT_TRUE(wall->isWhole());
  for (int tick = 0; tick < 60; ++tick) {
    tickDefault(w, 1);
    ASSERT_EQ(w.destruction->lastSubsteps(), 0) << tick;
  }
  EXPECT_TRUE(wall->isWhole());
  const std::vector<ElementPose> poses = posesOf(*wall);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].alive, 1);
    EXPECT_LT((poses[i].position.cast<double>() - wall->asset()->positions[i]).norm(), 1.2e-4) << i;
    EXPECT_EQ(wall->fragments()[i], 0u);
  }
  for (const std::uint8_t intact : wall->springsIntact()) ASSERT_EQ(intact, 1);
  const Events& calm = w.destruction->takeEvents();
  EXPECT_TRUE(calm.springsBroken.empty() && calm.contacts.empty() && calm.fragmentsSplit.empty());
  const btVector3 from(btScalar(0.1), btScalar(0.3), -2), to(btScalar(0.1), btScalar(0.3), 2);
  btCollisionWorld::ClosestRayResultCallback hit(from, to);
  w.world.rayTest(from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_EQ(hit.m_collisionObject, wall);
  EXPECT_NEAR(double(hit.m_hitPointWorld.z()), -0.04, 1e-5);

  btRigidBody* ball = w.add(10, w.ballShape, {0, btScalar(0.25), -1});
  ball->setLinearVelocity({0, 0, 10});
  tickDefault(w, 12);
  EXPECT_FALSE(wall->isWhole());
  EXPECT_GT(w.destruction->lastSubsteps(), 0);
  EXPECT_GT(w.destruction->counts().springsBroken, 50u);
  const Events& blow = w.destruction->takeEvents();
  EXPECT_EQ(blow.springsBroken.size(), w.destruction->counts().springsBroken);
  double given = 0;
  for (const ContactImpulse& contact : blow.contacts)
    if (contact.other == ball) given += double(contact.impulse);
  EXPECT_GT(given, 10);  // of 100 N s that it had
}

// The same of a block that only stands.
TEST(DefaultBody, ABlockOnTheGroundIsWholeUntilABallBreaksIt) {
  BulletWorld w;
  const GridAssetDef grid{.cubes = {8, 4, 4}, .edge = 0.05, .origin = {0, 0, 0}, .anchored = false};
  DestructibleBody* block = w.destruction->addBody(plainDef(std::make_shared<const Asset>(gridAsset(grid))));
  for (int tick = 0; tick < 60; ++tick) {
    tickDefault(w, 1);
    ASSERT_EQ(w.destruction->lastSubsteps(), 0) << tick;
  }
  EXPECT_TRUE(block->isWhole());
  EXPECT_NEAR(double(block->getWorldTransform().getOrigin().y()), 0.1, 2e-3);
  btRigidBody* ball = w.add(20, w.ballShape, {btScalar(0.2), btScalar(0.6), btScalar(0.1)});
  ball->setLinearVelocity({0, -10, 0});
  tickDefault(w, 12);
  EXPECT_FALSE(block->isWhole());
  EXPECT_GT(w.destruction->counts().springsBroken, 50u);
}

// Bullet has one user pointer and three user indices, and they are not ours.
TEST(DefaultBody, ItsUserPointerAndIndicesAreTheApplications) {
  BulletWorld w;
  DestructibleBody* body = w.destruction->addBody(blockDef({4, 4, 4}, {0, 1, 0}));
  w.world.setGravity({0, 0, 0});
  int marked = 0;
  body->setUserPointer(&marked);
  body->setUserIndex(11);
  body->setUserIndex2(12);
  body->setUserIndex3(13);
  const auto expectMarks = [&] {
    EXPECT_EQ(body->getUserPointer(), &marked);
    EXPECT_EQ(body->getUserIndex(), 11);
    EXPECT_EQ(body->getUserIndex2(), 12);
    EXPECT_EQ(body->getUserIndex3(), 13);
    EXPECT_EQ(DestructibleBody::upcast(static_cast<btCollisionObject*>(body)), body);
  };
  EXPECT_TRUE(body->isWhole());
  btRigidBody* ball = w.add(5, w.ballShape, {btScalar(0.1), btScalar(1.5), btScalar(0.1)});
  ball->setUserIndex3(13);
  EXPECT_EQ(DestructibleBody::upcast(static_cast<btCollisionObject*>(ball)), nullptr);
  ball->setLinearVelocity({0, -8, 0});
  for (int t = 0; t < 24; ++t) {
    w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    expectMarks();
  }
  EXPECT_FALSE(body->isWhole());
  EXPECT_GT(w.destruction->counts().springsBroken, 0u);
}

// What an application asks for by name.
TEST(DefaultBody, IsElementsFromTheStartWhereTheApplicationSaysSo) {
  BulletWorld w;
  DestructibleBodyDef def = plainDef(smallWall());
  def.regime = Regime::Elements;
  EXPECT_FALSE(w.destruction->addBody(def)->isWhole());
  tickDefault(w, 1);
  EXPECT_GT(w.destruction->lastSubsteps(), 0);
}

// Anchors may change what they hold to on a body of elements alone: the refusal says how to get one.
TEST(DefaultBody, ItsAnchorsStayWhereTheyAre) {
  BulletWorld w;
  DestructibleBody* wall = w.destruction->addBody(plainDef(smallWall()));
  try {
    w.destruction->setAnchorBody(wall, w.ground);
    ADD_FAILURE() << "taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("Regime::Elements"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(wall->isWhole());
}

}  // namespace
}  // namespace rubble::test
