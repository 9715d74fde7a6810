// Bullet's round shapes on destructible slabs.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bullet/bullet_world.h"
#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr double kTop = 0.2;                                 // of the slab [m]
constexpr double kMass = 5;                                  // [kg]
const btVector3 kMiddle(btScalar(0.53), 0, btScalar(0.49));  // of nothing: not on a seam

struct Slab : BulletWorld {
  explicit Slab(const btVector3& gravity = {0, btScalar(-9.81), 0},
                const std::array<int, 3>& cubes = {6, 1, 6}) {
    world.setGravity(gravity);
    DestructibleBodyDef def;
    GridAssetDef grid;
    grid.cubes = cubes;
    grid.edge = kTop;
    grid.anchored = true;
    def.asset = std::make_shared<const Asset>(gridAsset(grid));
    def.material = material("concrete_soft");
    def.material.friction = 1;
    def.anchored = true;
    def.regime = Regime::Elements;
    slab = destruction->addBody(def);
  }
  btRigidBody* put(btCollisionShape& shape, double height,
                   const btQuaternion& turn = btQuaternion::getIdentity(), const btVector3& at = kMiddle) {
    btRigidBody* body = add(btScalar(kMass), shape, at + btVector3(0, btScalar(kTop + height), 0));
    body->getWorldTransform().setRotation(turn);
    body->setFriction(1);
    body->setActivationState(DISABLE_DEACTIVATION);
    return body;
  }
  // Impulse that the slab gets from `body` [N s].
  double step(const btRigidBody* body, double seconds) {
    double impulse = 0;
    for (int tick = 0; tick < int(seconds * 240 + 0.5); ++tick) {
      world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
      for (const ContactImpulse& c : destruction->takeEvents().contacts)
        if (c.other == body) impulse += double(c.impulse);
    }
    return impulse;
  }
  DestructibleBody* slab;
};

const btQuaternion kAlongX({0, 0, 1}, SIMD_HALF_PI);  // y to -x
const btQuaternion kAskew = btQuaternion({0, 1, 0}, btScalar(0.4)) * kAlongX;

// Comes to rest with its lowest point on the slab, and the slab bears it.
void expectRests(btCollisionShape& shape, double height, const btQuaternion& turn, const char* name) {
  Slab w;
  btRigidBody* body = w.put(shape, height + 0.002, turn);
  w.step(body, 2.5);
  const double impulse = w.step(body, 0.5);
  EXPECT_NEAR(double(body->getWorldTransform().getOrigin().y()), kTop + height, 1e-3) << name;
  EXPECT_NEAR(impulse, kMass * 9.81 * 0.5, 0.02 * kMass * 9.81 * 0.5) << name;
  EXPECT_LT(double(body->getLinearVelocity().length()), 1e-3) << name;
  EXPECT_LT(double(body->getAngularVelocity().length()), 1e-2) << name;
  const double turned = double(body->getWorldTransform().getRotation().angleShortestPath(turn));
  EXPECT_LT(turned, 0.02) << name;
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u) << name;
}

TEST(Round, CapsuleRestsLying) {
  btCapsuleShape shape(btScalar(0.05), btScalar(0.3));
  expectRests(shape, 0.05, kAlongX, "along the seams");
  expectRests(shape, 0.05, kAskew, "askew");
  btCapsuleShape little(btScalar(0.02), btScalar(0.05));
  expectRests(little, 0.02, kAskew, "within one cell");
}

TEST(Round, CylinderRestsOnItsEnd) {
  btCylinderShape small({btScalar(0.05), btScalar(0.08), btScalar(0.05)});
  expectRests(small, 0.08, btQuaternion::getIdentity(), "within one cell");
  btCylinderShape large({btScalar(0.3), btScalar(0.1), btScalar(0.3)});
  expectRests(large, 0.1, btQuaternion::getIdentity(), "over several");
}

TEST(Round, CylinderRestsOnItsMantle) {
  btCylinderShape shape({btScalar(0.1), btScalar(0.25), btScalar(0.1)});
  expectRests(shape, 0.1, kAlongX, "along the seams");
  expectRests(shape, 0.1, kAskew, "askew");
  btCylinderShapeX alongX({btScalar(0.25), btScalar(0.1), btScalar(0.1)});
  expectRests(alongX, 0.1, btQuaternion::getIdentity(), "x");
  btCylinderShapeZ alongZ({btScalar(0.1), btScalar(0.1), btScalar(0.25)});
  expectRests(alongZ, 0.1, btQuaternion::getIdentity(), "z");
}

TEST(Round, ConeRestsOnItsBase) {
  // Bullet's own margin is all round it.
  btConeShape shape(btScalar(0.1), btScalar(0.2));
  expectRests(shape, 0.1 + double(shape.getMargin()), btQuaternion::getIdentity(), "y");
  btConeShapeX alongX(btScalar(0.1), btScalar(0.2));
  expectRests(alongX, 0.1 + double(alongX.getMargin()), btQuaternion({0, 0, 1}, SIMD_HALF_PI), "x");
}

TEST(Round, TwoSpheresAreACapsule) {
  const btVector3 centres[] = {{0, btScalar(-0.1), 0}, {0, btScalar(0.1), 0}};
  const btScalar radii[] = {btScalar(0.06), btScalar(0.06)};
  btMultiSphereShape shape(centres, radii, 2);
  expectRests(shape, 0.06, kAskew, "two spheres");
}

TEST(Round, AScaledShapeIsAsLarge) {
  btCylinderShape child({btScalar(0.05), btScalar(0.1), btScalar(0.05)});
  btUniformScalingShape shape(&child, 2);
  expectRests(shape, 0.1, kAskew, "cylinder, twice as large");
}

// Way down a ramp in 0.5 s.
constexpr double kTilt = 0.15, kTime = 0.5;

double wayDown(btCollisionShape& shape, double radius, const btQuaternion& turn, double* expected) {
  Slab w({btScalar(9.81 * std::sin(kTilt)), btScalar(-9.81 * std::cos(kTilt)), 0}, {8, 1, 4});
  const btVector3 at(btScalar(0.23), 0, btScalar(0.41));
  btRigidBody* body = w.put(shape, radius, turn, at);
  w.step(body, kTime);
  // Rolling: a = g sin / (1 + I / (m r^2)), I about the axis.
  const btVector3& inverse = body->getInvInertiaDiagLocal();
  *expected = 0.5 * 9.81 * std::sin(kTilt) / (1 + 1 / double(inverse.y()) / (kMass * radius * radius)) *
              kTime * kTime;
  EXPECT_NEAR(double(body->getWorldTransform().getOrigin().z()), 0.41, 0.01);
  EXPECT_NEAR(double(body->getAngularVelocity().z()) * radius, -double(body->getLinearVelocity().x()),
              0.02 * double(body->getLinearVelocity().x()))
      << "it slips";
  EXPECT_NEAR(double(body->getWorldTransform().getOrigin().y()), kTop + radius, 1e-3);
  return double(body->getWorldTransform().getOrigin().x() - at.x());
}

TEST(Round, ACylinderRollsDownARamp) {
  const btQuaternion across({1, 0, 0}, SIMD_HALF_PI);
  btCylinderShape shape({btScalar(0.05), btScalar(0.15), btScalar(0.05)});
  double expected = 0;
  const double way = wayDown(shape, 0.05, across, &expected);
  EXPECT_NEAR(expected, 0.5 * 2.0 / 3 * 9.81 * std::sin(kTilt) * kTime * kTime, 1e-4 * expected);
  EXPECT_NEAR(way, expected, 0.05 * expected);
}

TEST(Round, ACapsuleRollsDownARamp) {
  const btQuaternion across({1, 0, 0}, SIMD_HALF_PI);
  btCapsuleShape shape(btScalar(0.05), btScalar(0.3));
  double expected = 0;
  const double way = wayDown(shape, 0.05, across, &expected);
  EXPECT_NEAR(way, expected, 0.05 * expected);
}

TEST(Round, ThrownSolidsStayOnTheSlab) {
  // Tumbling onto it, any way up; the energy alarm would warn, which fails the test.
  btCapsuleShape capsule(btScalar(0.05), btScalar(0.2));
  btCylinderShape cylinder({btScalar(0.08), btScalar(0.1), btScalar(0.08)});
  btConeShape cone(btScalar(0.1), btScalar(0.2));
  const std::array<btCollisionShape*, 3> shapes{&capsule, &cylinder, &cone};
  for (btCollisionShape* shape : shapes) {
    for (const double turn : {0.0, 0.4, 0.7, 1.2, 2.0}) {
      Slab w;
      btRigidBody* body = w.put(*shape, 0.4, btQuaternion({1, 0, 1}, btScalar(turn)));
      body->setLinearVelocity({1, -8, 0});
      body->setAngularVelocity({5, 3, -8});
      w.step(body, 0.4);
      EXPECT_GT(double(body->getWorldTransform().getOrigin().y()), kTop) << shape->getName() << ", " << turn;
      EXPECT_LT(double(body->getLinearVelocity().length()), std::sqrt(65 + 2 * 9.81 * 0.4))
          << shape->getName();
    }
  }
}

}  // namespace
}  // namespace rubble::test
