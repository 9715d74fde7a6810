// Links of Bullet's multibodies and destructible bodies, as elements and whole.
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

constexpr btScalar kLinkRate = 120;

struct LinkWorld {
  explicit LinkWorld(double gravity) {
    world.setGravity({0, btScalar(-gravity), 0});
    DestructionDef def;
    def.log = strictLog();
    destruction = std::make_unique<Destruction>(world, def);
  }
  ~LinkWorld() {
    destruction.reset();
    for (const auto& body : multibodies) world.removeMultiBody(body.get());
    while (world.getNumCollisionObjects() > 0) {
      btCollisionObject* object = world.getCollisionObjectArray()[0];
      world.removeCollisionObject(object);
      if (object == ground.get()) continue;
      delete object;
    }
  }

  void addGround() {
    ground = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &plane));
    world.addRigidBody(ground.get());
  }
  btMultiBody* add(int links, btScalar mass, btCollisionShape& shape, bool fixed, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    shape.calculateLocalInertia(mass, inertia);
    multibodies.push_back(std::make_unique<btMultiBody>(links, mass, inertia, fixed, true));
    btMultiBody* body = multibodies.back().get();
    body->setBaseWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    body->setLinearDamping(0);
    body->setAngularDamping(0);
    return body;
  }
  void finish(btMultiBody& body, btScalar dampingToo = 0) {
    body.finalizeMultiDof();
    body.setLinearDamping(dampingToo);
    world.addMultiBody(&body);
  }
  btMultiBodyLinkCollider* collide(btMultiBody& body, int link, btCollisionShape& shape,
                                   const btVector3& at) {
    auto* collider = new btMultiBodyLinkCollider(&body, link);
    collider->setCollisionShape(&shape);
    collider->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    world.addCollisionObject(collider, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    if (link < 0) {
      body.setBaseCollider(collider);
    } else {
      body.getLink(link).m_collider = collider;
    }
    return collider;
  }
  void run(double seconds) {
    for (int tick = 0; tick < int(std::lround(seconds * double(kLinkRate))); ++tick)
      world.stepSimulation(1 / kLinkRate, 1, 1 / kLinkRate);
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btStaticPlaneShape plane{{0, 1, 0}, 0};
  std::unique_ptr<btRigidBody> ground;
  std::vector<std::unique_ptr<btMultiBody>> multibodies;
  std::unique_ptr<Destruction> destruction;
};

class Multibody : public testing::TestWithParam<Regime> {};

// A free ball of one link, without weight: what it loses the block gains.
TEST_P(Multibody, AFreeLinkGivesWhatTheElementsGet) {
  LinkWorld w(0);
  DestructibleBody* block = w.destruction->addBody(blockDef({4, 4, 4}, {0, 0, 0}, GetParam()));
  btSphereShape ball(btScalar(0.1));
  const btVector3 from(btScalar(0.1), btScalar(0.1), btScalar(-0.25));
  btMultiBody* body = w.add(0, 5, ball, false, from);
  w.collide(*body, -1, ball, from);
  w.finish(*body);
  body->setBaseVel({0, 0, 2});
  w.run(0.5);
  ASSERT_TRUE(w.destruction->failure().empty()) << w.destruction->failure();
  const DestructionCounts counts = w.destruction->counts();
  ASSERT_EQ(counts.crushed, 0u);
  const double given = 5 * (2 - double(body->getBaseVel().z()));
  EXPECT_GT(given, 5.0);
  EXPECT_NEAR(double(block->linearMomentum().z()), given, 0.005 * given);
  EXPECT_FALSE(block->isWhole());
}

// A rod that hangs on a hinge at 1 m strikes a block that is free, without weight: the angular momentum about
// the hinge is kept (I = m l^2 / 3 of the rod, 1/3 of m l^2; its links' own in their inertia).
TEST_P(Multibody, AHingedLinkGivesItsAngularMomentum) {
  LinkWorld w(0);
  DestructibleBody* block =
      w.destruction->addBody(blockDef({4, 4, 4}, {btScalar(-0.1), 0, btScalar(0.15)}, GetParam()));
  btBoxShape rod({btScalar(0.03), btScalar(0.45), btScalar(0.03)});
  const btVector3 hinge(0, 1, 0);
  btMultiBody* body = w.add(1, 0, rod, true, hinge);
  constexpr btScalar kMass = 6;
  btVector3 inertia;
  rod.calculateLocalInertia(kMass, inertia);
  body->setupRevolute(0, kMass, inertia, -1, btQuaternion::getIdentity(), {1, 0, 0}, {0, 0, 0},
                      {0, btScalar(-0.45), 0}, true);
  w.collide(*body, 0, rod, hinge - btVector3(0, btScalar(0.45), 0));
  w.finish(*body);
  body->setJointVel(0, -2);
  const double about = double(inertia.x()) + double(kMass) * 0.45 * 0.45;
  const auto momentum = [&] {
    const Momenta own(*block);
    return about * double(body->getJointVel(0)) + double((own.angular - hinge.cross(own.linear)).x());
  };
  const double before = momentum();
  w.run(0.4);
  ASSERT_TRUE(w.destruction->failure().empty()) << w.destruction->failure();
  ASSERT_EQ(w.destruction->counts().crushed, 0u);
  EXPECT_GT(std::abs(double(body->getJointVel(0)) + 2), 0.5);
  EXPECT_GT(double(block->linearMomentum().z()), 1.0);
  EXPECT_NEAR(momentum(), before, 0.02 * std::abs(before));
}

// A multibody's base of 20 kg lies on the ground, a block of 19 kg on it.
TEST_P(Multibody, ABlockRestsOnABase) {
  LinkWorld w(9.81);
  w.addGround();
  btBoxShape box({btScalar(0.2), btScalar(0.1), btScalar(0.2)});
  btMultiBody* body = w.add(0, 20, box, false, {0, btScalar(0.1), 0});
  w.collide(*body, -1, box, {0, btScalar(0.1), 0});
  w.finish(*body);
  const btVector3 corner(btScalar(-0.1), btScalar(0.2), btScalar(-0.1));
  DestructibleBody* block = w.destruction->addBody(blockDef({4, 4, 4}, corner, GetParam()));
  const btScalar height = block->getWorldTransform().getOrigin().y();
  w.run(2);
  EXPECT_NEAR(double(block->getWorldTransform().getOrigin().y()), double(height), 0.004);
  EXPECT_NEAR(double(body->getBasePos().y()), 0.1, 0.004);
  EXPECT_LT(double(block->getLinearVelocity().length()), 0.01);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  EXPECT_EQ(block->isWhole(), GetParam() == Regime::RigidUntilStruck);
}

// Two boxes of 10 kg on a hinge lie on a slab.
TEST_P(Multibody, LinksRestOnASlab) {
  LinkWorld w(9.81);
  w.addGround();
  DestructibleBody* slab =
      w.destruction->addBody(blockDef({16, 2, 8}, {btScalar(-0.4), 0, btScalar(-0.2)}, GetParam()));
  btBoxShape box({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  const btVector3 at(btScalar(-0.12), btScalar(0.2), 0), away(btScalar(0.12), 0, 0);
  btMultiBody* body = w.add(1, 10, box, false, at);
  btVector3 inertia;
  box.calculateLocalInertia(10, inertia);
  body->setupRevolute(0, 10, inertia, -1, btQuaternion::getIdentity(), {0, 0, 1}, away, away, true);
  w.collide(*body, -1, box, at);
  btMultiBodyLinkCollider* link = w.collide(*body, 0, box, at + 2 * away);
  w.finish(*body, btScalar(0.04));
  double most = 0;
  w.run(1);
  for (int tick = 0; tick < 120; ++tick) {
    w.run(1 / double(kLinkRate));
    most = std::max({most, std::abs(double(body->getBasePos().y()) - 0.2),
                     std::abs(double(link->getWorldTransform().getOrigin().y()) - 0.2)});
  }
  EXPECT_LT(most, 0.006);
  // It trembles, by less than half of what gravity adds in a tick.
  EXPECT_LT(double(body->getBaseVel().length()), 0.5 * 9.81 / double(kLinkRate));
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  EXPECT_EQ(slab->isWhole(), GetParam() == Regime::RigidUntilStruck);
}

INSTANTIATE_TEST_SUITE_P(In, Multibody, testing::Values(Regime::Elements, Regime::RigidUntilStruck),
                         [](const auto& tested) {
                           return tested.param == Regime::Elements ? "Elements" : "Whole";
                         });

}  // namespace
}  // namespace rubble::test
