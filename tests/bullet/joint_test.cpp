// Bullet's joints on bodies of elements.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

DestructionDef unbreakable() {
  DestructionDef def;
  def.breaking = false;
  return def;
}

// A column of 0.1 x 0.4 x 0.1 m on a joint at its upper end, which is at `kPivot`.
struct JointWorld : BulletWorld {
  explicit JointWorld(DestructionDef def = {}, btScalar ticksASecond = 240)
      : BulletWorld(def), rate(ticksASecond) {}
  ~JointWorld() {
    for (const auto& joint : joints) world.removeConstraint(joint.get());
  }
  template <class Joint, class... Args>
  Joint& join(Args&&... args) {
    auto joint = std::make_unique<Joint>(std::forward<Args>(args)...);
    Joint& out = *joint;
    world.addConstraint(joint.get(), true);
    joints.push_back(std::move(joint));
    return out;
  }
  DestructibleBody* hang(double angle, Regime regime, int cubes = 8) {
    DestructibleBodyDef def = blockDef({2, cubes, 2}, {0, 0, 0}, regime);
    const btVector3 top(btScalar(0.05), btScalar(0.05 * cubes), btScalar(0.05));
    def.transform.setRotation(btQuaternion({0, 0, 1}, btScalar(angle)));
    def.transform.setOrigin(kPivot - def.transform.getBasis() * top);
    DestructibleBody* body = destruction->addBody(def);
    join<btPoint2PointConstraint>(*body, body->getWorldTransform().inverse() * kPivot);
    return body;
  }
  void step(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) world.stepSimulation(1 / rate, 1, 1 / rate);
  }
  // Of the place of the first joint that is in the body from where it ought to be [m].
  double drift(const DestructibleBody& body) const {
    const auto& joint = static_cast<const btPoint2PointConstraint&>(*joints[0]);
    return double((body.getWorldTransform() * joint.getPivotInA() - kPivot).length());
  }
  void expectClosed() const {
    EXPECT_EQ(destruction->failure(), "");
    EXPECT_LT(destruction->ledger().linearError, 1e-4);
    EXPECT_LT(destruction->ledger().angularError, 1e-4);
    EXPECT_LT(destruction->ledger().energyError, 1e-3);
  }

  const btVector3 kPivot{btScalar(0.5), 3, btScalar(0.2)};
  btScalar rate;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
};

// In the first tick nothing is known of the joint, and it falls by g dt^2 / 2. Then its upper end is its
// middle and half the stretch under its weight, rho g L^2 / (2 E) = 0.06 mm; what is about the joint gives by
// as much again. It comes to rest, and sleeps.
TEST(Joint, AHungColumnDoesNotSag) {
  for (const btScalar rate : {btScalar(60), btScalar(240)}) {
    JointWorld w({}, rate);
    const DestructibleBody* column = w.hang(0, Regime::Elements);
    const double before = double(posesOf(*column)[0].position.y());
    double most = 0, late = 0;
    for (int tick = 0; tick < int(5 * rate); ++tick) {
      w.step(1);
      most = std::max(most, w.drift(*column));
      if (tick > int(rate)) late = std::max(late, w.drift(*column));
    }
    EXPECT_LT(most, 9.81 / 2 / double(rate * rate) + 2e-4) << rate;
    EXPECT_LT(late, 2e-4) << rate;
    EXPECT_NEAR(double(posesOf(*column)[0].position.y()), before, 3e-4) << rate;
    EXPECT_TRUE(column->isAsleep()) << rate;
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    w.expectClosed();
  }
}

// T = 2 pi sqrt(I / (m g d)) (1 + angle^2 / 16), I = m (a^2 + L^2) / 12 + m d^2, d = L / 2.
TEST(Joint, AColumnOnAPointIsAPendulum) {
  constexpr double kAngle = 0.3, kSide = 0.1, kLength = 0.4, kArm = kLength / 2;
  const double period = 2 * M_PI *
                        std::sqrt(((kSide * kSide + kLength * kLength) / 12 + kArm * kArm) / (9.81 * kArm)) *
                        (1 + kAngle * kAngle / 16);
  for (const btScalar rate : {btScalar(60), btScalar(240)}) {
    JointWorld w({}, rate);
    const DestructibleBody* column = w.hang(kAngle, Regime::Elements);
    std::vector<double> crossings;
    double last = 1, largest = 0, drift = 0;
    for (int tick = 1; tick <= int(6 * rate); ++tick) {
      w.step(1);
      const double x = double(column->getCenterOfMassPosition().x() - w.kPivot.x());
      if (last > 0 && x <= 0) crossings.push_back((tick - x / (x - last)) / double(rate));
      last = x;
      if (tick > int(4 * rate)) largest = std::max(largest, std::abs(x));
      drift = std::max(drift, w.drift(*column));
    }
    ASSERT_GE(crossings.size(), 4u);
    const double measured = (crossings.back() - crossings.front()) / double(crossings.size() - 1);
    EXPECT_NEAR(measured, period, 0.02 * period) << rate;
    // After five swings: it gains nothing, and loses more the longer the ticks are.
    EXPECT_LT(largest, 1.01 * kArm * std::sin(kAngle)) << rate;
    EXPECT_GT(largest, (rate > 100 ? 0.85 : 0.65) * kArm * std::sin(kAngle)) << rate;
    EXPECT_LT(drift, 2e-3) << rate;
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    w.expectClosed();
  }
}

TEST(Joint, AMotorTurnsADoor) {
  JointWorld w(unbreakable());
  DestructibleBodyDef def = blockDef({6, 8, 1}, {0, 1, 0}, Regime::Elements);
  DestructibleBody* door = w.destruction->addBody(def);
  const btTransform back = door->getWorldTransform().inverse();
  auto& hinge = w.join<btHingeConstraint>(*door, back * btVector3(0, btScalar(1.2), btScalar(0.025)),
                                          back.getBasis() * btVector3(0, 1, 0));
  hinge.enableAngularMotor(true, 1, 10);
  w.step(240);
  const double from = double(hinge.getHingeAngle());
  w.step(240);
  const double turned = std::remainder(double(hinge.getHingeAngle()) - from, 2 * M_PI);
  EXPECT_NEAR(std::abs(turned), 1, 0.01);
  EXPECT_NEAR(std::abs(double(door->getAngularVelocity().y())), 1, 0.02);
  const btVector3 edge = door->getWorldTransform() * (back * btVector3(0, btScalar(1.2), btScalar(0.025)));
  EXPECT_LT(double((edge - btVector3(0, btScalar(1.2), btScalar(0.025))).length()), 2e-3);
  w.expectClosed();
}

TEST(Joint, AFixedBlockFollowsAKinematicBody) {
  JointWorld w;
  btBoxShape shape({btScalar(0.1), btScalar(0.1), btScalar(0.1)});
  btRigidBody* carrier = w.add(0, shape, {0, 2, 0});
  carrier->setCollisionFlags(carrier->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  carrier->setActivationState(DISABLE_DEACTIVATION);
  carrier->setInterpolationWorldTransform(carrier->getWorldTransform());  // else it comes from the origin
  DestructibleBody* block = w.destruction->addBody(
      blockDef({4, 4, 4}, {btScalar(-0.1), btScalar(1.7), btScalar(-0.1)}, Regime::Elements));
  const btTransform apart(btQuaternion::getIdentity(), {0, btScalar(-0.2), 0});
  w.join<btFixedConstraint>(*carrier, *block, apart, btTransform::getIdentity());
  // It speeds up for a second and then keeps 0.5 m/s.
  double x = 0, speed = 0, most = 0;
  for (int tick = 0; tick < 480; ++tick) {
    speed = std::min(0.5, speed + 0.5 / 240);
    x += speed / 240;
    carrier->setWorldTransform(btTransform(btQuaternion::getIdentity(), {btScalar(x), 2, 0}));
    w.step(1);
    const btVector3 off = block->getCenterOfMassPosition() - btVector3(btScalar(x), btScalar(1.8), 0);
    most = std::max(most, double(off.length()));
  }
  // One tick's way: Bullet's own joints lead what is moved before the step by as much.
  EXPECT_LT(most, 0.5 / 240 + 5e-4);
  EXPECT_NEAR(double(block->getLinearVelocity().x()), 0.5, 0.01);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed();
}

// Thrown apart, they turn about each other: both momenta stay, to the rounding of Bullet's scalars in 480
// ticks.
TEST(Joint, TwoBodiesKeepTheirMomenta) {
  JointWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBodyDef def = blockDef({4, 4, 4}, {0, 2, 0}, Regime::Elements);
  DestructibleBody* first = w.destruction->addBody(def);
  def = blockDef({6, 4, 4}, {btScalar(0.3), 2, 0}, Regime::Elements);
  DestructibleBody* second = w.destruction->addBody(def);
  w.join<btPoint2PointConstraint>(*first, *second, btVector3(btScalar(0.15), 0, 0),
                                  btVector3(btScalar(-0.2), 0, 0));
  first->setLinearVelocity({0, btScalar(0.4), 0});
  second->setLinearVelocity({0, btScalar(-0.4), btScalar(0.2)});
  const double p0 = 0.4 * first->elementMass() + 0.45 * second->elementMass();
  const btVector3 linear = btScalar(first->elementMass()) * btVector3(0, btScalar(0.4), 0) +
                           btScalar(second->elementMass()) * btVector3(0, btScalar(-0.4), btScalar(0.2));
  w.step(120);
  const Momenta a(*first), b(*second);
  w.step(360);
  const Momenta c(*first), d(*second);
  EXPECT_LT(double((c.linear + d.linear - linear).length()), 1e-5 * p0);
  EXPECT_LT(double((c.angular + d.angular - a.angular - b.angular).length()), 5e-3 * p0 * 0.5);
  const btVector3 gap = first->getWorldTransform() * btVector3(btScalar(0.15), 0, 0) -
                        second->getWorldTransform() * btVector3(btScalar(-0.2), 0, 0);
  EXPECT_LT(double(gap.length()), 2e-3);
  EXPECT_GT(double(c.angular.length()), 0);
  w.expectClosed();
}

// AddressSanitizer tells, too.
TEST(Joint, AnActionMayDeleteTheJointOrTheBody) {
  for (const bool bodyToo : {false, true}) {
    JointWorld w;
    DestructibleBody* column = w.hang(0, Regime::Elements);
    w.step(10);
    Takes action([&] {
      w.world.removeConstraint(w.joints[0].get());
      w.joints.clear();
      if (bodyToo) w.destruction->removeBody(column);
    });
    w.actFirst(action);
    w.step(24);
    w.world.removeAction(&action);
    EXPECT_EQ(w.destruction->bodies().size(), bodyToo ? 0u : 1u);
    // It falls freely from where it hung, by g t^2 / 2 and half a tick's speed.
    if (!bodyToo) {
      const double fallen = double(w.kPivot.y()) - 0.2 - double(column->getCenterOfMassPosition().y());
      EXPECT_NEAR(fallen, 9.81 / 2 * 0.1 * 0.1, 9.81 * 0.1 / 240);
    }
    EXPECT_EQ(w.destruction->failure(), "");
  }
}

// What it gives a rigid body of Bullet's it has lost itself.
TEST(Joint, ARigidBodyOnItKeepsTheMomentum) {
  JointWorld w;
  w.world.setGravity({0, 0, 0});
  DestructibleBody* block = w.destruction->addBody(blockDef({4, 4, 4}, {0, 2, 0}, Regime::Elements));
  btRigidBody* ball = w.add(5, w.ballShape, {btScalar(0.4), btScalar(2.1), btScalar(0.1)});
  ball->setActivationState(DISABLE_DEACTIVATION);
  w.join<btPoint2PointConstraint>(*block, *ball, btVector3(btScalar(0.15), 0, 0),
                                  btVector3(btScalar(-0.15), 0, 0));
  ball->setLinearVelocity({0, 1, 0});
  w.step(240);
  const btVector3 sum = block->linearMomentum() + btScalar(5) * ball->getLinearVelocity();
  EXPECT_LT(double((sum - btVector3(0, 5, 0)).length()), 5e-5 * 5);
  const btVector3 gap = block->getWorldTransform() * btVector3(btScalar(0.15), 0, 0) -
                        ball->getWorldTransform() * btVector3(btScalar(-0.15), 0, 0);
  EXPECT_LT(double(gap.length()), 5e-3);
  w.expectClosed();
}

// Whole, elements, whole again.
TEST(Joint, AStruckColumnGoesOnHanging) {
  JointWorld w(unbreakable());
  DestructibleBody* column = w.hang(0, Regime::RigidUntilStruck);
  w.step(60);
  ASSERT_TRUE(column->isWhole());
  btRigidBody* ball =
      w.add(btScalar(0.3), w.ballShape, w.kPivot + btVector3(btScalar(-0.25), btScalar(-0.2), 0));
  ball->setLinearVelocity({2, 0, 0});
  double drift = 0;
  bool thawed = false;
  int ticks = 0;
  for (; ticks < 2400 && !(thawed && column->isWhole()); ++ticks) {
    w.step(1);
    thawed = thawed || !column->isWhole();
    drift = std::max(drift, w.drift(*column));
  }
  EXPECT_TRUE(thawed);
  EXPECT_TRUE(column->isWhole());
  w.step(240);
  EXPECT_LT(std::max(drift, w.drift(*column)), 5e-3);
  EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
  w.expectClosed();
}

// A column of 0.8 m that bears 0.3 m of itself breaks; what is on the joint stays there.
TEST(Joint, HoldsTheFragmentThatItIsAt) {
  JointWorld w;
  DestructibleBodyDef def = blockDef({1, 16, 1}, {0, 0, 0}, Regime::Elements);
  def.material.tensileStrength = 7e3;
  def.material.compressiveStrength = 7e5;
  def.transform.setOrigin(w.kPivot - btVector3(btScalar(0.025), btScalar(0.8), btScalar(0.025)));
  DestructibleBody* column = w.destruction->addBody(def);
  w.join<btPoint2PointConstraint>(*column, btVector3(0, btScalar(0.4), 0));
  w.step(480);
  ASSERT_GT(w.destruction->counts().fragments, 1u);
  const std::vector<ElementPose> poses = posesOf(*column);
  const auto fragment = column->fragments();
  EXPECT_NEAR(double(poses[15].position.y()), 3 - 0.025, 2e-3);
  EXPECT_LT(double(poses[0].position.y()), 1);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double count = 0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (fragment[i] == fragment[15]) {
      centre += poses[i].position.cast<double>();
      ++count;
    }
  const btVector3 shown = column->getCenterOfMassPosition();
  EXPECT_NEAR(double(shown.y()), centre.y() / count, 1e-4);
  EXPECT_LT(w.drift(*column), 2e-3);
  EXPECT_NEAR(1 / double(column->getInvMass()), count / 16 * column->elementMass(), 1e-3);
  w.expectClosed();
}

// A lamp on an anchored wall.
TEST(Joint, AnAnchoredWallBearsALamp) {
  for (const btScalar rate : {btScalar(60), btScalar(240)}) {
    JointWorld w({}, rate);
    DestructibleBody* wall = w.addWall(material("concrete_soft"));
    const btVector3 hook(0, btScalar(0.4), btScalar(-0.1));
    btRigidBody* lamp = w.add(5, w.ballShape, hook - btVector3(0, btScalar(0.12), btScalar(0.05)));
    lamp->setActivationState(DISABLE_DEACTIVATION);
    w.join<btPoint2PointConstraint>(*wall, *lamp, wall->getWorldTransform().inverse() * hook,
                                    btVector3(0, btScalar(0.12), btScalar(0.05)));
    const btTransform onWall = wall->getWorldTransform().inverse();
    double most = 0;
    for (int tick = 0; tick < int(2 * rate); ++tick) {
      w.step(1);
      const btVector3 at = lamp->getWorldTransform() * btVector3(0, btScalar(0.12), btScalar(0.05));
      const btVector3 place = wall->getWorldTransform() * (onWall * hook);
      most = std::max(most, double((at - place).length()));
    }
    // From where the wall has it, for that bends. It falls by g dt^2 in the first tick, for which Bullet does
    // not know yet that the wall is held.
    EXPECT_LT(most, 9.81 / double(rate * rate) + 3e-4) << rate;
    EXPECT_EQ(w.destruction->counts().springsBroken, 0u);
    EXPECT_LT(w.destruction->ledger().momentumError(), 1e-4);
    EXPECT_LT(w.destruction->ledger().energyError, 5e-3);  // of the little that trembles in a wall at rest
  }
}

}  // namespace
}  // namespace rubble::test
