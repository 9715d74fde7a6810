// What a blow throws within a tick meets the bodies of the region that it crosses in that tick.
#include <gtest/gtest.h>

#include <cmath>

#include "bullet/body_impl.h"
#include "bullet/bullet_world.h"
#include "bullet/world_tick.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

// A shot at a pane of no strength, the front of the shot right before it: the pane is thrown in the first
// tick.
struct Shot {
  const char* material;  // of the pane
  double mass, speed;    // [kg], [m/s]
  double radius;         // [m]
};
constexpr Shot kBall{"concrete_soft", 20, 20, 0.1};
constexpr Shot kBallAtHardPane{"concrete", 20, 20, 0.1};
constexpr Shot kBullet{"concrete", 0.2, 300, 0.03};

constexpr double kPaneBack = 0.04, kThickness = 0.2;  // of smallWall, of the box behind it [m]

constexpr btScalar kWide = 10;  // half the box's width, so that nothing flies past its sides [m]

// z, which the shot flies along, is 0 in the pane's middle.
struct Range {
  explicit Range(double gap, btScalar boxMass = 0) : w(uncrushed()), face(kPaneBack + gap) {
    const btVector3 middle(0, kWide, btScalar(face + 0.5 * kThickness));
    box = w.add(boxMass, boxShape, middle);
  }
  // What crushes is not thrown.
  static DestructionDef uncrushed() {
    DestructionDef def;
    def.crushing = false;
    return def;
  }

  DestructibleBody* addPane(const char* name, double z = 0, double speed = 0) {
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = smallWall();
    def.material = material(name);
    def.material.tensileStrength = 1.5e3;  // bears hardly more than its weight
    def.material.compressiveStrength = 1.5e4;
    def.anchored = speed == 0;
    def.transform.setOrigin({0, 0, btScalar(z)});
    def.velocity = {0, 0, btScalar(speed)};
    return w.destruction->addBody(def);
  }
  void shoot(const Shot& shot) {
    constexpr double kBefore = 0.005;  // the pane [m]
    ballShape = std::make_unique<btSphereShape>(btScalar(shot.radius));
    const double z = -kPaneBack - kBefore - shot.radius;
    w.add(btScalar(shot.mass), *ballShape, {0, btScalar(0.25), btScalar(z)})
        ->setLinearVelocity({0, 0, btScalar(shot.speed)});
  }
  void run(int rate) {
    constexpr double kFallTime = 0.1;  // [s]
    const edem::Solver& solver = *implOf(*w.destruction).solver;
    for (int tick = 0; tick < int(std::lround(kFallTime * rate)); ++tick) {
      w.world.stepSimulation(btScalar(1) / btScalar(rate), 1, btScalar(1) / btScalar(rate));
      for (const DestructibleBody* pane : w.destruction->bodies()) {
        for (std::size_t i = 0; i < pane->asset()->elementCount(); ++i) {
          fastest = std::max(fastest, solver.velocity(pane->id(), i).norm());
          furthest = std::max(furthest, solver.position(pane->id(), i).z());
        }
      }
    }
  }

  std::unique_ptr<btSphereShape> ballShape;
  btBoxShape boxShape{{kWide, kWide, btScalar(0.5 * kThickness)}};
  BulletWorld w;
  double face;  // the box's near side [m]
  btRigidBody* box = nullptr;
  double fastest = 0, furthest = 0;  // of the elements, at the ticks' ends [m/s], centre's z [m]
};

TEST(Swept, BallThrowsThePaneAtAWall) {
  // Without any loss what a heavy ball strikes leaves at twice its speed; the elements give back less. Their
  // centres stay outside the wall.
  for (const Shot& shot : {kBall, kBallAtHardPane}) {
    for (const int rate : {60, 240}) {
      SCOPED_TRACE(std::string(shot.material) + " at " + std::to_string(rate) + " Hz");
      Range r(0.25);
      r.addPane(shot.material);
      r.shoot(shot);
      r.run(rate);
      EXPECT_GT(r.fastest, 10) << "nothing was thrown";
      EXPECT_LT(r.fastest, 2 * shot.speed);
      EXPECT_LT(r.furthest, r.face);
    }
  }
}

TEST(Swept, BulletThrowsThePaneAtAWall) {
  for (const int rate : {60, 240}) {
    Range r(0.25);
    r.addPane(kBullet.material);
    r.shoot(kBullet);
    r.run(rate);
    EXPECT_GT(r.fastest, 10) << rate;
    EXPECT_LT(r.fastest, 2 * kBullet.speed) << rate;
    EXPECT_LT(r.furthest, r.face) << rate;
  }
}

TEST(Swept, KinematicAndDynamicBodiesStandInTheWayToo) {
  {
    Range r(0.25);
    r.box->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    r.addPane(kBullet.material);
    r.shoot(kBullet);
    r.run(60);
    EXPECT_LT(r.furthest, r.face);
  }
  Range r(0.25, 2000);
  r.addPane(kBullet.material);
  r.shoot(kBullet);
  r.run(60);
  EXPECT_GT(double(r.box->getLinearVelocity().z()), 0);
  EXPECT_LT(r.furthest, double(r.box->getWorldTransform().getOrigin().z()));
}

TEST(Swept, OnePaneThrowsTheNext) {
  // Nothing of Bullet's comes near the panes: the first, thrown, strikes the second in the same tick.
  Range r(0.25);
  r.addPane("concrete", -2 * kPaneBack - 0.005, 60);
  r.addPane("concrete");
  r.run(60);
  EXPECT_GT(r.fastest, 10);
  EXPECT_LT(r.furthest, r.face);
}

TEST(Swept, ThrownPaneMeetsAWallInItsFirstTick) {
  // 0.25 m at 30 m/s are half a tick.
  Range r(0.25);
  r.addPane("concrete", 0, 30);
  r.run(60);
  EXPECT_LT(r.furthest, r.face);
}

TEST(Swept, WallThatIsFilteredOutIsFlownThrough) {
  enum class By { Mask, IgnoreList, NoResponse };
  for (const By by : {By::Mask, By::IgnoreList, By::NoResponse}) {
    Range r(0.25);
    DestructibleBody* pane = r.addPane(kBullet.material);
    if (by == By::Mask) {
      r.w.world.removeRigidBody(r.box);
      r.w.world.addRigidBody(r.box, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::CharacterFilter);
    } else if (by == By::IgnoreList) {
      r.box->setIgnoreCollisionCheck(pane, true);
      pane->setIgnoreCollisionCheck(r.box, true);
    } else {
      r.box->setCollisionFlags(r.box->getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
    }
    r.shoot(kBullet);
    r.run(60);
    EXPECT_GT(r.furthest, r.face + kThickness) << int(by);
  }
}

// The ball is free to pass the first wall, and meets the second while it is still in the first.
TEST(Filter, BodyThatIsFilteredOutIsNotTouchedBesideOneThatIsNot) {
  enum class By { Mask, IgnoreList };
  for (const By by : {By::Mask, By::IgnoreList}) {
    DestructionDef definition;
    definition.breaking = false;
    BulletWorld w(definition);
    w.world.setGravity({0, 0, 0});
    btRigidBody* ball = w.add(1, w.ballShape, {0, btScalar(0.25), btScalar(-0.2)});
    ball->setLinearVelocity({0, 0, 5});
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = smallWall();
    def.material = material("concrete_soft");
    def.transform.setOrigin({0, 0, btScalar(0.1)});
    const DestructibleBody* second = w.destruction->addBody(def);
    def.transform.setOrigin({0, 0, 0});
    if (by == By::Mask) def.collisionMask = btBroadphaseProxy::StaticFilter;
    DestructibleBody* first = w.destruction->addBody(def);
    if (by == By::IgnoreList) first->setIgnoreCollisionCheck(ball, true);
    double given = 0;
    for (int tick = 0; tick < 24; ++tick) {
      w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
      for (const ContactImpulse& c : w.destruction->takeEvents().contacts) {
        if (c.other != ball) continue;
        EXPECT_EQ(c.body, second->id()) << int(by);
        given += double(c.impulse);
      }
    }
    EXPECT_GT(given, 5) << "the ball turned round: 1 kg, 5 m/s";
    EXPECT_LT(double(ball->getLinearVelocity().z()), 0);
  }
}

TEST(Swept, ElementFirstSeenDeepIsNoFasterThanItCame) {
  // Its overlap was never pressed in, so that no spring gives it back, however fast it is and whatever stands
  // close by. Rounding: 1e-4 of its speed.
  constexpr double kEdge = 0.04, kRadius = 0.5 * kEdge;  // of the element [m]
  for (const double depth : {0.1, 0.9, 1.5}) {           // in radii
    for (const btVector3& velocity : {btVector3(0, -10, 0), btVector3(10, -100, 0), btVector3(10, 0, 0)}) {
      BulletWorld w(Range::uncrushed());
      w.world.setGravity({0, 0, 0});
      w.ground->setRestitution(1);
      btBoxShape side({btScalar(0.1), 1, 1});
      w.add(0, side, {btScalar(-0.1 - 1.3 * kRadius), 0, 0});
      DestructibleBodyDef def;
      def.regime = Regime::Elements;
      def.asset = std::make_shared<const Asset>(
          gridAsset({.cubes = {1, 1, 1}, .edge = kEdge, .origin = {0, 0, 0}, .anchored = false}));
      def.material = material("concrete");
      def.material.restitution = 1;
      def.anchored = false;
      // The cube's middle is where the grid puts it: half an edge above its corner.
      def.transform.setOrigin({btScalar(-kRadius), btScalar(-depth * kRadius), btScalar(-kRadius)});
      def.velocity = velocity;
      const std::uint32_t id = w.destruction->addBody(def)->id();
      const edem::Solver& solver = *implOf(*w.destruction).solver;
      ASSERT_NEAR(solver.position(id, 0).y(), (1 - depth) * kRadius, 1e-6);
      ASSERT_NEAR(solver.position(id, 0).x(), 0, 1e-6);
      for (int tick = 0; tick < 20; ++tick) {
        w.world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
        EXPECT_LT(solver.velocity(id, 0).norm(), (1 + 1e-4) * double(velocity.length())) << depth;
      }
    }
  }
}

}  // namespace
}  // namespace rubble::test
