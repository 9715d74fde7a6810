// Bullet's character controller and its ghost on destructible bodies, beside the same on Bullet's own boxes.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <gtest/gtest.h>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

constexpr btScalar kWalkerRadius = btScalar(0.15), kWalkerHeight = btScalar(0.4),
                   kWalkerStep = btScalar(0.15);
constexpr btScalar kWalkRate = 60,
                   kFoot = kWalkerRadius + kWalkerHeight / 2;  // the capsule's middle above its foot [m]

struct Walker {
  Walker(BulletWorld& world, const btVector3& foot) : w(world) {
    w.world.getPairCache()->setInternalGhostPairCallback(&callback);
    ghost.setCollisionShape(&capsule);
    ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), foot + btVector3(0, kFoot, 0)));
    w.world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter, btBroadphaseProxy::AllFilter);
    controller =
        std::make_unique<btKinematicCharacterController>(&ghost, &capsule, kWalkerStep, btVector3(0, 1, 0));
    controller->setGravity({0, btScalar(-9.81), 0});
    // It turns its ghost from z up.
    ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), foot + btVector3(0, kFoot, 0)));
    w.world.addAction(controller.get());
  }
  ~Walker() {
    w.world.removeAction(controller.get());
    w.world.removeCollisionObject(&ghost);
    w.world.getPairCache()->setInternalGhostPairCallback(nullptr);
  }
  void walk(const btVector3& velocity, double seconds) {
    controller->setWalkDirection(velocity / kWalkRate);
    for (int tick = 0; tick < int(std::lround(seconds * double(kWalkRate))); ++tick) {
      w.world.stepSimulation(1 / kWalkRate, 1, 1 / kWalkRate);
      lowest = std::min(lowest, foot().y());
    }
    controller->setWalkDirection({0, 0, 0});
  }
  btVector3 foot() const { return ghost.getWorldTransform().getOrigin() - btVector3(0, kFoot, 0); }
  bool overlaps(const btCollisionObject* object) {
    return ghost.getOverlappingPairs().findLinearSearch(const_cast<btCollisionObject*>(object)) <
           ghost.getNumOverlappingObjects();
  }

  BulletWorld& w;
  btCapsuleShape capsule{kWalkerRadius, kWalkerHeight};
  btGhostPairCallback callback;
  btPairCachingGhostObject ghost;
  std::unique_ptr<btKinematicCharacterController> controller;
  btScalar lowest = 1;  // foot, since it was made [m]
};

enum class Made { OfBullet, OfElements, Whole };

// A solid of cubes of 0.05 m, on the ground.
struct Course {
  Course(Made made, const Eigen::Vector3i& cubes, const btVector3& corner) : made_(made) {
    const btVector3 size(btScalar(0.05 * cubes.x()), btScalar(0.05 * cubes.y()), btScalar(0.05 * cubes.z()));
    shape = std::make_unique<btBoxShape>(size / 2);
    if (made == Made::OfBullet) {
      solid = w.add(0, *shape, corner + size / 2);
    } else {
      body = w.destruction->addBody(
          blockDef(cubes, corner, made == Made::Whole ? Regime::RigidUntilStruck : Regime::Elements));
      solid = body;
    }
  }
  Made made_;
  std::unique_ptr<btBoxShape> shape;
  BulletWorld w;
  DestructibleBody* body = nullptr;
  btRigidBody* solid = nullptr;
};

struct Ways {
  btVector3 end;
  btScalar lowest;
  bool whole = false, overlapped = false;
};

Ways along(Made made, const Eigen::Vector3i& cubes, const btVector3& corner, const btVector3& from,
           const btVector3& velocity, double seconds) {
  Course c(made, cubes, corner);
  Walker walker(c.w, from);
  walker.walk({0, 0, 0}, 0.5);
  walker.lowest = walker.foot().y();
  walker.walk(velocity, seconds);
  return {walker.foot(), walker.lowest, c.body && c.body->isWhole(), walker.overlaps(c.solid)};
}

class Character : public testing::TestWithParam<Made> {};

// What Bullet keeps between a capsule and a box, and what a slab gives under its own weight [m].
constexpr double kWalkMargin = 0.015;
// By which Bullet's controller sinks into whatever it stands on, its own boxes too [m].
constexpr double kSinks = 0.04;

TEST_P(Character, WalksOnASlab) {
  const auto walk = [](Made made) {
    return along(made, {24, 2, 10}, {btScalar(-0.6), 0, btScalar(-0.25)}, {btScalar(-0.4), btScalar(0.12), 0},
                 {btScalar(0.5), 0, 0}, 1.5);
  };
  const Ways box = walk(Made::OfBullet), own = walk(GetParam());
  EXPECT_NEAR(double(box.end.x()), 0.35, 0.02);  // it does walk
  EXPECT_NEAR(double(box.end.y()), 0.1 - kSinks, kWalkMargin);
  EXPECT_NEAR(double(own.end.x()), double(box.end.x()), kWalkMargin);
  EXPECT_NEAR(double(own.end.y()), double(box.end.y()), kWalkMargin);
  EXPECT_GT(double(own.lowest), double(box.lowest) - kWalkMargin);
  EXPECT_EQ(own.whole, GetParam() == Made::Whole);
  EXPECT_TRUE(own.overlapped);
}

TEST_P(Character, IsStoppedByAWall) {
  const auto walk = [](Made made) {
    return along(made, {4, 20, 20}, {btScalar(0.3), 0, btScalar(-0.5)}, {btScalar(-0.4), btScalar(0.02), 0},
                 {1, 0, 0}, 2);
  };
  const Ways box = walk(Made::OfBullet), own = walk(GetParam());
  EXPECT_NEAR(double(box.end.x()), 0.3 - double(kWalkerRadius), 0.05);
  EXPECT_NEAR(double(own.end.x()), double(box.end.x()), kWalkMargin);
  EXPECT_NEAR(double(own.end.y()), double(box.end.y()), kWalkMargin);
}

TEST_P(Character, StepsUpOnASlab) {
  const auto walk = [](Made made) {
    return along(made, {16, 2, 10}, {0, 0, btScalar(-0.25)}, {btScalar(-0.5), btScalar(0.02), 0},
                 {btScalar(0.5), 0, 0}, 2);
  };
  const Ways box = walk(Made::OfBullet), own = walk(GetParam());
  EXPECT_NEAR(double(box.end.y()), 0.1 - kSinks, kWalkMargin);
  EXPECT_NEAR(double(own.end.x()), double(box.end.x()), 2 * kWalkMargin);
  EXPECT_NEAR(double(own.end.y()), double(box.end.y()), kWalkMargin);
}

// A ball of 50 kg at 15 m/s breaks the slab; then it walks over what lies there. It stays above the ground,
// and is borne by elements somewhere on its way.
TEST_P(Character, WalksOnTheRubble) {
  Course c(GetParam(), {24, 2, 10}, {btScalar(-0.6), 0, btScalar(-0.25)});
  btRigidBody* ball = c.w.add(50, c.w.ballShape, {0, btScalar(0.25), 0});
  ball->setLinearVelocity({0, -15, 0});
  for (int tick = 0; tick < 40; ++tick) c.w.world.stepSimulation(1 / kWalkRate, 1, 1 / kWalkRate);
  c.w.remove(ball);
  const DestructionCounts counts = c.w.destruction->counts();
  ASSERT_GT(counts.fragments + counts.crushed, 1u);
  Walker walker(c.w, {btScalar(-0.4), btScalar(0.3), 0});
  walker.walk({0, 0, 0}, 1);
  EXPECT_GT(double(walker.foot().y()), 0.05 - kSinks);  // on the slab's end
  walker.walk({btScalar(0.4), 0, 0}, 2);
  EXPECT_GT(double(walker.foot().x()), 0.2);
  EXPECT_GT(double(walker.lowest), -kSinks - kWalkMargin);
}

INSTANTIATE_TEST_SUITE_P(On, Character, testing::Values(Made::OfElements), [](const auto& tested) {
  return tested.param == Made::Whole ? "Whole" : "Elements";
});

// A ghost of no controller: what it overlaps is listed, and it moves nothing.
TEST(Ghost, ListsADestructible) {
  for (const Made made : {Made::OfElements, Made::Whole}) {
    Course c(made, {4, 4, 4}, {0, 0, 0});
    btGhostPairCallback callback;
    c.w.world.getPairCache()->setInternalGhostPairCallback(&callback);
    btGhostObject ghost;
    ghost.setCollisionShape(&c.w.ballShape);
    ghost.setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
    ghost.setWorldTransform(
        btTransform(btQuaternion::getIdentity(), {btScalar(0.1), btScalar(0.15), btScalar(0.1)}));
    c.w.world.addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
    for (int tick = 0; tick < 10; ++tick) c.w.world.stepSimulation(1 / kWalkRate, 1, 1 / kWalkRate);
    bool listed = false;
    for (int i = 0; i < ghost.getNumOverlappingObjects(); ++i)
      listed |= ghost.getOverlappingObject(i) == c.body;
    EXPECT_TRUE(listed);
    EXPECT_LT(double(c.body->getLinearVelocity().length()), 0.05);
    c.w.destruction->removeBody(c.body);
    for (int i = 0; i < ghost.getNumOverlappingObjects(); ++i)
      EXPECT_NE(ghost.getOverlappingObject(i), static_cast<btCollisionObject*>(c.body));
    c.w.world.removeCollisionObject(&ghost);
    c.w.world.getPairCache()->setInternalGhostPairCallback(nullptr);
  }
}

}  // namespace
}  // namespace rubble::test
