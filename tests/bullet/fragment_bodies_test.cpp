// Fragments that become bodies of their own in the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "bullet/bullet_world.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

// A free bar that a ball breaks in its middle, high above the ground.
struct StruckBar : BulletWorld {
  static DestructionDef definition(std::uint32_t least, std::uint32_t most) {
    DestructionDef def;
    def.fragmentBodyElements = least;
    def.maxNewBodies = most;
    return def;
  }
  explicit StruckBar(std::uint32_t least, std::uint32_t most = 2, double height = 5)
      : BulletWorld(definition(least, most)) {
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = std::make_shared<const Asset>(gridAsset({.cubes = {16, 2, 2}, .edge = 0.1}));
    def.material = material("concrete_soft");
    def.transform.setOrigin({0, btScalar(height), 0});
    bar = destruction->addBody(def);
    ball = add(20, ballShape, {btScalar(0.8), btScalar(height + 0.35), btScalar(0.1)});
    ball->setLinearVelocity({0, -8, 0});
  }
  void step(int ticks) {
    for (int t = 0; t < ticks; ++t) {
      world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
      const Events& events = destruction->takeEvents();
      for (const BodySplit& s : events.bodiesSplit) splits.push_back(s);
      mostInATick = std::max(mostInATick, events.bodiesSplit.size());
    }
  }
  btVector3 momentum() const {
    btVector3 sum(0, 0, 0);
    for (const DestructibleBody* body : destruction->bodies()) sum += body->linearMomentum();
    return sum;
  }

  DestructibleBody* bar = nullptr;
  btRigidBody* ball = nullptr;
  std::vector<BodySplit> splits;
  std::size_t mostInATick = 0;
};

TEST(FragmentBodies, ComeFreeAndFallAsTheyWouldHave) {
  StruckBar one(0), w(8);
  one.step(60);
  w.step(60);
  ASSERT_GT(w.splits.size(), 0u);
  EXPECT_EQ(one.destruction->bodies().size(), 1u);
  EXPECT_EQ(w.destruction->bodies().size(), 1 + w.splits.size());
  // Counts and books are those of one body, and so is the motion: none touches another in flight.
  const DestructionCounts a = one.destruction->counts(), b = w.destruction->counts();
  EXPECT_EQ(b.elements, a.elements);
  EXPECT_EQ(b.springs, a.springs);
  EXPECT_EQ(b.springsBroken, a.springsBroken);
  EXPECT_EQ(b.crushed, a.crushed);
  EXPECT_EQ(b.fragments, a.fragments);
  EXPECT_LT(double((w.momentum() - one.momentum()).length()), 1e-4 * double(one.momentum().length()));
  const Ledger& ledger = w.destruction->ledger();
  EXPECT_LT(std::abs(ledger.energyError), 1e-3);
  EXPECT_LT(std::abs(ledger.massError), 1e-9);
  EXPECT_LT(ledger.momentumError(), 1e-5);
}

TEST(FragmentBodies, AreBodiesOfBullets) {
  StruckBar w(8);
  w.step(60);
  ASSERT_GT(w.splits.size(), 0u);
  for (const BodySplit& split : w.splits) {
    const DestructibleBody* part = w.destruction->body(split.newBody);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->source(), w.bar->id());
    EXPECT_EQ(part->asset(), w.bar->asset());
    EXPECT_TRUE(part->checkCollideWith(w.bar)) << "it ignores what its parent does, not its parent";
    EXPECT_NEAR(1 / double(part->getInvMass()), part->elementMass(), 1e-4 * part->elementMass());
    std::uint32_t alive = 0;
    btVector3 centre(0, 0, 0);
    std::vector<ElementPose> poses(part->asset()->elementCount());
    part->poses(poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!part->elementsAlive()[i]) continue;
      ++alive;
      EXPECT_EQ(w.bar->elementsAlive()[i], 0) << "in one of them";
      centre += btVector3(poses[i].position.x(), poses[i].position.y(), poses[i].position.z());
    }
    EXPECT_LE(alive, split.elements);
    EXPECT_LT(double((part->getWorldTransform().getOrigin() - centre / btScalar(alive)).length()), 1e-3);
    // Bullet's queries find it where it is.
    const btVector3 at = part->getWorldTransform().getOrigin();
    btCollisionWorld::AllHitsRayResultCallback ray(at + btVector3(0, 1, 0), at - btVector3(0, 1, 0));
    w.world.rayTest(ray.m_rayFromWorld, ray.m_rayToWorld, ray);
    bool isHit = false;
    for (int h = 0; h < ray.m_collisionObjects.size(); ++h) isHit |= ray.m_collisionObjects[h] == part;
    EXPECT_TRUE(isHit);
  }
}

// The bar lies on the ground, and its pieces against each other.
TEST(FragmentBodies, TouchOneAnother) {
  StruckBar w(4, 2, 0);
  w.step(30);
  ASSERT_GT(w.splits.size(), 0u);
  for (const DestructibleBody* body : w.destruction->bodies()) {
    std::map<std::uint32_t, int> elements;
    for (const std::uint32_t root : body->fragments())
      if (root != kNoElement) ++elements[root];
    EXPECT_EQ(std::ranges::count_if(elements, [](const auto& f) { return f.second >= 4; }), 1) << body->id();
  }
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_LT(std::abs(w.destruction->ledger().energyError), 1e-3);
  EXPECT_LT(w.destruction->ledger().momentumError(), 1e-5);
}

TEST(FragmentBodies, NoMoreInATickThanAllowed) {
  StruckBar two(1, 2), one(1, 1);
  two.step(60);
  one.step(60);
  EXPECT_EQ(two.mostInATick, 2u);
  EXPECT_EQ(one.mostInATick, 1u);
  EXPECT_GT(one.splits.size(), 2u) << "the others only wait";
}

// An impulse of the application moves that fragment alone.
TEST(FragmentBodies, TakeImpulses) {
  StruckBar w(8);
  w.step(60);
  ASSERT_GT(w.splits.size(), 0u);
  DestructibleBody* part = w.destruction->body(w.splits.front().newBody);
  const btVector3 before = part->getLinearVelocity(), others = w.bar->getLinearVelocity();
  part->applyCentralImpulse(btVector3(0, 0, 3) / part->getInvMass());
  w.step(1);
  EXPECT_NEAR(double(part->getLinearVelocity().z() - before.z()), 3, 0.05);
  EXPECT_NEAR(double(w.bar->getLinearVelocity().z() - others.z()), 0, 0.05);
}

TEST(FragmentBodies, ComeToRestAndSleepEachByItself) {
  StruckBar w(8, 2, 1);
  w.step(240 * 8);
  ASSERT_GT(w.splits.size(), 0u);
  for (const DestructibleBody* body : w.destruction->bodies()) {
    EXPECT_TRUE(body->isAsleep()) << body->id();
    EXPECT_GT(double(body->getWorldTransform().getOrigin().y()), 0.0);
  }
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_LT(std::abs(w.destruction->ledger().energyError), 1e-3);
}

// By the application, in any order, the first one as well.
TEST(FragmentBodies, AreRemovedAsOthersAre) {
  for (const bool first : {true, false}) {
    StruckBar w(8);
    w.step(60);
    ASSERT_GT(w.splits.size(), 0u);
    DestructibleBody* part = w.destruction->body(w.splits.front().newBody);
    const std::uint32_t id = part->id();
    const double mass = w.destruction->ledger().massElements;
    const double leaves = (first ? w.bar : part)->elementMass();
    w.destruction->removeBody(first ? w.bar : part);
    w.step(30);
    EXPECT_NEAR(w.destruction->ledger().massElements, mass - leaves, 1e-6 * mass);
    EXPECT_EQ(w.destruction->body(id) != nullptr, first);
    EXPECT_LT(std::abs(w.destruction->ledger().massError), 1e-9);
  }
}

TEST(FragmentBodies, KeepFilterFlagsGravityAndIgnoreList) {
  StruckBar w(8);
  w.bar->setGravity({0, 2, 0});
  btSphereShape small(btScalar(0.05));
  btRigidBody* other = w.add(1, small, {20, 5, 0});
  w.bar->setIgnoreCollisionCheck(other, true);
  constexpr int kTold = btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK;
  w.bar->setCollisionFlags(w.bar->getCollisionFlags() | kTold);
  w.step(60);
  ASSERT_GT(w.splits.size(), 0u);
  DestructibleBody* part = w.destruction->body(w.splits.front().newBody);
  const btVector3 before = part->getLinearVelocity();
  w.step(24);
  EXPECT_NEAR(double(part->getLinearVelocity().y() - before.y()), 0.2, 0.01);
  EXPECT_FALSE(part->checkCollideWith(other));
  EXPECT_TRUE(part->getCollisionFlags() & kTold);
  EXPECT_EQ(part->getBroadphaseProxy()->m_collisionFilterMask,
            w.bar->getBroadphaseProxy()->m_collisionFilterMask);
  w.clear();
}

}  // namespace
}  // namespace rubble::test
