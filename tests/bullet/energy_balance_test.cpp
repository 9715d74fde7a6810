// A run whose elements hold more than was put in stops; what an application does to them, or to what they
// touch, does not stop it.
#include <gtest/gtest.h>

#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bullet/bullet_world.h"
#include "bullet/energy_balance.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr double kTolerated = bullet::EnergyBalance::kTolerance;

// 100 J that bodies brought, 20 J of gravity, 30 J of Bullet's bodies, 10 J taken by anchors: 140 J.
edem::Books booksOf140() {
  edem::Books books;
  books.initialEnergy = 100;
  books.gravity.work.add(20, 0);
  books.bullet.work.add(30, 0);
  books.anchors.work.add(-10, 0);
  return books;
}

std::optional<double> beyondOf(bullet::EnergyBalance& balance, edem::Books books, double held,
                               double rigid = 0, double rounding = 0) {
  books.kinetic = 0.75 * held;
  books.elastic = 0.25 * held;
  return balance.beyond(books, rigid, rounding);
}

TEST(EnergyBalance, TellsWhatIsHeldBeyondWhatWasPutIn) {
  bullet::EnergyBalance balance;
  EXPECT_FALSE(beyondOf(balance, booksOf140(), 140));
  EXPECT_FALSE(beyondOf(balance, booksOf140(), (1 + kTolerated) * 140 - 1));
  const auto held = beyondOf(balance, booksOf140(), (1 + kTolerated) * 140 + 1);
  ASSERT_TRUE(held);
  EXPECT_NEAR(*held, (1 + kTolerated) * 140 + 1, 1e-9);
  EXPECT_NEAR(balance.most(), 140, 1e-9);
}

TEST(EnergyBalance, AllowsForWhatRigidBodiesStillHaveAndForRounding) {
  bullet::EnergyBalance balance;
  EXPECT_FALSE(beyondOf(balance, booksOf140(), (1 + kTolerated) * 520 - 1, 400)) << "120 J and 400 J";
  EXPECT_FALSE(beyondOf(balance, booksOf140(), (1 + kTolerated) * 520 + 6, 0, 7));
  EXPECT_TRUE(beyondOf(balance, booksOf140(), (1 + kTolerated) * 520 + 8, 0, 1)) << "the most there ever was";
}

// Where things stand for hours the books' errors add up, up to more than all that was put in.
TEST(EnergyBalance, ErrorsThatAddUpStopNothing) {
  bullet::EnergyBalance balance;
  edem::Books books = booksOf140();
  EXPECT_FALSE(beyondOf(balance, books, 140));
  books.bullet.work.add(-1000, 0);
  EXPECT_FALSE(beyondOf(balance, books, 140));
  EXPECT_TRUE(beyondOf(balance, books, (1 + kTolerated) * 140 + 1));
}

TEST(EnergyBalance, WhatNoBookHasIsPutIn) {
  bullet::EnergyBalance balance;
  balance.beginAnew();
  EXPECT_FALSE(beyondOf(balance, booksOf140(), 1e6));
  EXPECT_FALSE(beyondOf(balance, booksOf140(), 1e6)) << "from then on";
  EXPECT_TRUE(beyondOf(balance, booksOf140(), 1e6 + kTolerated * 1e6 + 1));
}

TEST(EnergyBalance, ASurfaceThatChangesBeginsAnew) {
  edem::RigidProxy proxy;
  proxy.key = 1;
  proxy.parts.emplace_back();
  bullet::EnergyBalance balance;
  balance.noteShapes({&proxy, 1});
  proxy.position.x() = 1;
  balance.noteShapes({&proxy, 1});
  EXPECT_TRUE(beyondOf(balance, booksOf140(), 1e6)) << "the same in its own axes";
  proxy.parts[0].place.translation().x() = 1;
  balance.noteShapes({&proxy, 1});
  EXPECT_FALSE(beyondOf(balance, booksOf140(), 1e6));
}

constexpr btScalar kBalanceTick = btScalar(1) / 240;

// 3 x 3 x 3 cubes of 0.1 m that stand on the ground.
struct Stands : BulletWorld {
  explicit Stands(Regime regime = Regime::Elements) : BulletWorld(silent()) {
    DestructibleBodyDef def;
    def.asset = std::make_shared<const Asset>(
        gridAsset({.cubes = {3, 3, 3}, .edge = 0.1, .origin = {-0.15, 0.001, -0.15}, .anchored = false}));
    def.material = material("concrete_soft");
    def.anchored = false;
    def.regime = regime;
    block = destruction->addBody(def);
    step(10, [](int) {});
  }
  static DestructionDef silent() {
    DestructionDef def;
    def.log = [](LogLevel, const std::string&) {};  // alarms, which only warn
    return def;
  }
  template <class Do>
  void step(int ticks, Do&& act) {
    for (int tick = 0; tick < ticks; ++tick) {
      act(tick);
      world.stepSimulation(kBalanceTick, 1, kBalanceTick);
    }
  }
  DestructibleBody* block = nullptr;
};

// Each moves a block of little energy, a few J of weight, by work that is in no book.
TEST(EnergyBalance, ShapesThatGrowOrMoveWithinTheirBodyStopNothing) {
  Stands grown;
  grown.add(0, grown.ballShape, {btScalar(-0.26), btScalar(0.15), 0});
  grown.step(60,
             [&](int) { grown.ballShape.setUnscaledRadius(grown.ballShape.getRadius() + btScalar(0.004)); });
  EXPECT_EQ(grown.destruction->failure(), "");

  btBoxShape arm({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  btCompoundShape machine;
  const auto at = [](double x) { return btTransform(btQuaternion::getIdentity(), {btScalar(x), 0, 0}); };
  machine.addChildShape(at(5), &arm);
  machine.addChildShape(at(-5), &arm);
  machine.addChildShape(at(-0.26), &arm);
  Stands pushed;
  pushed.add(0, machine, {0, btScalar(0.15), 0});
  pushed.step(60, [&](int tick) { machine.updateChildTransform(2, at(-0.26 + 0.005 * tick)); });
  EXPECT_EQ(pushed.destruction->failure(), "");
  EXPECT_GT(pushed.block->linearMomentum().x(), 0);
}

TEST(EnergyBalance, TrianglesThatRiseStopNothing) {
  std::vector<btScalar> places = {-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2};
  std::vector<int> corners = {0, 1, 2, 0, 2, 3};
  btTriangleIndexVertexArray mesh(2, corners.data(), int(3 * sizeof(int)), 4, places.data(),
                                  int(3 * sizeof(btScalar)));
  btGImpactMeshShape ground(&mesh);
  ground.setMargin(0);
  ground.updateBound();
  Stands w;
  w.add(0, ground, {0, 0, 0});
  double most = 0;
  w.step(60, [&](int) {
    most = std::max(most, w.destruction->ledger().kinetic + w.destruction->ledger().elastic);
    for (std::size_t y = 1; y < places.size(); y += 3) places[y] += btScalar(0.01);
    ground.postUpdate();
    ground.updateBound();
  });
  EXPECT_EQ(w.destruction->failure(), "");
  EXPECT_GT(most, 10) << "of 0.8 J that were put in";
}

TEST(EnergyBalance, WhatTheApplicationDoesStopsNothing) {
  for (const Regime regime : {Regime::Elements, Regime::RigidUntilStruck}) {
    Stands w(regime);
    DestructibleBody& block = *w.block;
    w.step(40, [&](int tick) {
      block.applyCentralImpulse({tick % 2 ? btScalar(-300) : btScalar(300), 0, 0});
    });
    EXPECT_EQ(w.destruction->failure(), "") << "impulses";
    w.step(40, [&](int tick) { block.setLinearVelocity({0, tick % 8 ? btScalar(4) : btScalar(-8), 0}); });
    EXPECT_EQ(w.destruction->failure(), "") << "velocities";
    w.step(40, [&](int tick) {
      btTransform at = block.getWorldTransform();
      at.setOrigin({0, tick % 10 ? btScalar(0.16) : btScalar(0.12), btScalar(tick)});
      block.setWorldTransform(at);
    });
    EXPECT_EQ(w.destruction->failure(), "") << "places, in the ground too";
    w.step(60, [&](int tick) {
      w.world.setGravity({0, tick % 20 < 10 ? btScalar(200) : btScalar(-200), 0});
    });
    w.world.setGravity({0, btScalar(-9.81), 0});
    EXPECT_EQ(w.destruction->failure(), "") << "gravity";
    w.step(40, [&](int) { block.applyCentralForce({0, 0, btScalar(2e4)}); });
    EXPECT_EQ(w.destruction->failure(), "") << "forces";
  }
}

TEST(EnergyBalance, WhatTheApplicationDrivesStopsNothing) {
  btBoxShape shape({btScalar(0.2), btScalar(0.2), btScalar(0.2)});
  Stands w;
  btRigidBody* driver = w.add(0, shape, {btScalar(-0.4), btScalar(0.2), 0});
  driver->setCollisionFlags(driver->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  driver->setActivationState(DISABLE_DEACTIVATION);
  const auto put = [&](double x) {
    btTransform at = driver->getWorldTransform();
    at.getOrigin().setX(btScalar(x));
    driver->setWorldTransform(at);
  };
  w.step(60, [&](int tick) { put(-0.4 + 0.02 * tick); });
  EXPECT_EQ(w.destruction->failure(), "") << "drives";
  w.step(60, [&](int tick) { put(tick % 2 ? 0.3 : -0.4); });
  EXPECT_EQ(w.destruction->failure(), "") << "jumps";
  w.world.removeRigidBody(driver);
  w.step(20, [](int) {});
  EXPECT_EQ(w.destruction->failure(), "") << "is removed";
  w.world.addRigidBody(driver);
  w.step(20, [](int) {});
  EXPECT_EQ(w.destruction->failure(), "") << "comes back";
}

}  // namespace
}  // namespace rubble::test
