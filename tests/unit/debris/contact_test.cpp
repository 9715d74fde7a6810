#include <gtest/gtest.h>

#include <cmath>

#include "debris/debris_system.h"
#include "unit/debris/random.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
using namespace debris;
namespace {

using Eigen::Vector3d;
using test::Surroundings;
using test::TestPlane;

constexpr double kRadius = 0.005;
const TestPlane kGround{};

DebrisSystemDef inVacuum(double restitution = 0.3) {
  DebrisSystemDef def;
  def.maxDebris = 1000;
  def.air = test::kVacuum;
  def.restitution = restitution;
  return def;
}

void addOne(DebrisSystem& system, const DebrisParcel& parcel) {
  system.add({&parcel, 1});
}

TEST(Contact, BouncesRiseToTheSquareOfTheRestitution) {
  const double restitution = 0.7, drop = 2.0;
  DebrisSystem system(inVacuum(restitution));
  addOne(system, test::stone(kRadius + drop));
  Surroundings ground({kGround});
  double expected = drop, before = 1;
  int bounces = 0;
  bool rising = false;
  for (int i = 0; i < 1200 && bounces < 4; ++i) {
    system.step(kTick, kDown, ground);
    const DebrisPiece& piece = system.pieces()[0];
    const bool rises = piece.velocity.y() > 0;
    if (rising && !rises) {  // just past the top: h - v^2 / 2g is lost since
      const double v = double(piece.velocity.y());
      const double height = double(piece.position.y()) - kRadius + v * v / (2 * kGravity);
      expected *= restitution * restitution;
      // The chord of a step is up to g dt^2 / 8 = 2e-5 m off the parabola, and each bounce starts 1e-5 m up.
      EXPECT_NEAR(height, expected, 1e-4) << bounces;
      ++bounces;
    }
    rising = rises;
    before = double(piece.velocity.y());
  }
  EXPECT_EQ(bounces, 4);
  EXPECT_LE(before, 0);
}

TEST(Contact, FastPieceDoesNotPassThroughAThinWall) {
  DebrisSystem system(inVacuum(0));
  addOne(system, test::stone({0, 1, 0}, {0, -5000, 0}));
  Surroundings ground({kGround});
  system.step(1.0 / 30, kDown, ground);
  EXPECT_NEAR(double(system.pieces()[0].position.y()), kRadius, 2e-5);
}

TEST(Contact, SlidingStopsAfterVSquaredOverTwoMuG) {
  for (const double friction : {0.2, 0.6}) {
    for (const double speed : {1.0, 4.0}) {
      DebrisSystem system(inVacuum());
      DebrisParcel parcel = test::stone({0, kRadius, 0}, {0.6 * speed, 0, 0.8 * speed});
      parcel.friction = friction;
      addOne(system, parcel);
      Surroundings ground({kGround});
      for (int i = 0; i < 240 * 4; ++i) system.step(kTick, kDown, ground);
      const Eigen::Vector3f p = system.pieces()[0].position;
      const double way = std::hypot(double(p.x()), double(p.z()));
      EXPECT_NEAR(way, speed * speed / (2 * friction * kGravity), speed * kTick) << "to one step's way";
      EXPECT_EQ(system.restingCount(), 1u);
    }
  }
}

TEST(Contact, SlopeHoldsWhatFrictionHolds) {
  for (const double slope : {0.5, 0.58, 0.62, 0.7}) {  // tangent, mu is 0.6
    const Vector3d normal = Vector3d(slope, 1, 0).normalized();
    DebrisSystem system(inVacuum());
    addOne(system, test::stone(kRadius * normal, Vector3d::Zero()));
    Surroundings ramp({TestPlane{.normal = normal}});
    for (int i = 0; i < 240; ++i) system.step(kTick, kDown, ramp);
    const double way = (system.pieces()[0].position.cast<double>() - kRadius * normal).norm();
    const double angle = std::atan(slope);
    const double expected = std::max(0.0, 0.5 * kGravity * (std::sin(angle) - 0.6 * std::cos(angle)));
    // Until it rests, 60 steps, a piece falls through its gap of 1e-5 m in each, straight down: it creeps by
    // gap x slope.
    EXPECT_NEAR(way, expected, 0.02 * expected + 60e-5 * slope + 1e-5) << slope;
  }
}

TEST(Contact, RestsOnAPlaneForEver) {
  DebrisSystem system(inVacuum());
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    DebrisParcel parcel = test::stone({0.1 * i, random.uniform(0.1, 1), 0}, random.inBall(2));
    parcel.spin = random.inBall(50);
    addOne(system, parcel);
  }
  Surroundings ground({kGround});
  for (int i = 0; i < 240 * 8; ++i) system.step(kTick, kDown, ground);
  ASSERT_EQ(system.restingCount(), 200u);
  const std::uint64_t hash = system.hash();
  ground.sweeps = 0;
  for (const DebrisPiece& piece : system.pieces()) {
    EXPECT_NEAR(double(piece.position.y()), kRadius, 2e-5);
    EXPECT_TRUE(piece.resting);
    EXPECT_EQ(piece.velocity, Eigen::Vector3f::Zero());
    EXPECT_EQ(piece.spin, Eigen::Vector3f::Zero());
  }
  for (int i = 0; i < 10000; ++i) system.step(kTick, kDown, ground);
  EXPECT_EQ(system.hash(), hash);
  EXPECT_EQ(ground.sweeps, 0u) << "resting pieces ask for no collision";
}

TEST(Contact, TinyAndLongStepsComeToRestToo) {
  for (const double tick : {1.0 / 5000, 1.0 / 30, 0.5}) {
    DebrisSystem system(inVacuum());
    addOne(system, test::stone({0, 0.1, 0}, {0.5, 0, 0}));
    Surroundings ground({kGround});
    for (int i = 0; i < std::lround(3 / tick); ++i) system.step(tick, kDown, ground);
    EXPECT_EQ(system.restingCount(), 1u) << tick;
    EXPECT_NEAR(double(system.pieces()[0].position.y()), kRadius, 3e-5) << tick;
  }
}

TEST(Contact, CornerHoldsAPiece) {
  DebrisSystem system(inVacuum());
  addOne(system, test::stone({0.3, 0.3, 0.3}, {-20, -20, -20}));
  Surroundings corner(
      {{.normal = Vector3d::UnitX()}, {.normal = Vector3d::UnitY()}, {.normal = Vector3d::UnitZ()}});
  for (int i = 0; i < 240 * 5; ++i) system.step(kTick, kDown, corner);
  const Eigen::Vector3f p = system.pieces()[0].position;
  EXPECT_GE(p.minCoeff(), float(kRadius));
  EXPECT_EQ(system.restingCount(), 1u);
}

TEST(Contact, PieceSunkenIntoASurfaceIsPutOutside) {
  DebrisSystem system(inVacuum());
  addOne(system, test::stone({0, -0.2, 0}, Vector3d::Zero()));
  Surroundings ground({kGround});
  system.step(kTick, kDown, ground);
  EXPECT_NEAR(double(system.pieces()[0].position.y()), kRadius, 2e-5);
  EXPECT_LT(system.motion().kinetic, 1e-12) << "and gets no speed from it";
  // By hand: m g (0.2 m + radius) more than it had.
  const Exchange exchange = system.takeExchange();
  EXPECT_NEAR(exchange.placed, 0.01 * kGravity * (0.2 + kRadius), 2e-6);
  EXPECT_NEAR(exchange.contact.energy, exchange.placed, 2e-6) << "that contacts did not give";
}

// On what goes away as fast a piece waits until there is room, and has the speed of a fall that it did not
// make: m g dt v = 0.0245 J.
TEST(Contact, WhatAWaitingPieceGainsIsBooked) {
  DebrisSystem system(inVacuum(0));
  addOne(system, test::stone({0, kRadius, 0}, {0, -5, 0}));
  Surroundings slab({TestPlane{.velocity = {0, -5, 0}, .surface = 0}});
  slab.surfaces = 1;
  system.step(0.05, kDown, slab);
  const Exchange exchange = system.takeExchange();
  EXPECT_NEAR(exchange.placed, 0.01 * kGravity * 0.05 * 5, 1e-5);
  EXPECT_NEAR(exchange.contact.energy + exchange.workOnSurfaces, exchange.placed, 1e-5);
}

// A fall, a bounce and rest are no place.
TEST(Contact, WhatFallsIsNotPlaced) {
  DebrisSystem system(inVacuum());
  addOne(system, test::stone({0, 1, 0}, {2, 0, 0}));
  Surroundings ground({kGround});
  for (int i = 0; i < 240 * 4; ++i) system.step(kTick, kDown, ground);
  EXPECT_EQ(system.restingCount(), 1u);
  EXPECT_LT(system.takeExchange().placed, 1e-5 * 0.01 * kGravity);
}

TEST(Contact, RisingPlatformLiftsAPiece) {
  DebrisSystem system(inVacuum(0));
  addOne(system, test::stone(kRadius));
  Surroundings platform({TestPlane{.velocity = {0, 0.5, 0}, .surface = 0}});
  platform.surfaces = 1;
  for (int i = 0; i < 240; ++i) {
    system.step(kTick, kDown, platform);
    platform.planes[0].offset += 0.5 * kTick;
  }
  EXPECT_NEAR(double(system.pieces()[0].position.y()), kRadius + 0.5, 0.5 * kTick + 1e-4);
  EXPECT_EQ(system.movingCount(), 1u) << "what rides along is not at rest";
}

TEST(Contact, ConveyorTakesAPieceToItsSpeed) {
  DebrisSystem system(inVacuum());
  addOne(system, test::stone(kRadius));
  Surroundings belt({TestPlane{.velocity = {1.5, 0, 0}, .surface = 0}});
  belt.surfaces = 1;
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, belt);
  EXPECT_NEAR(double(system.pieces()[0].velocity.x()), 1.5, 1e-6);
}

TEST(Contact, SurfaceReceivesWhatThePieceLoses) {
  DebrisSystem system(inVacuum(0.5));
  const DebrisParcel parcel = test::stone({0.3, 0.01, 0}, {0, -4, 0});
  addOne(system, parcel);
  Surroundings body({TestPlane{.surface = 1}});
  body.surfaces = 2;
  system.step(kTick, Vector3d::Zero(), body);
  ASSERT_EQ(system.surfaceImpulses().size(), 1u);
  const SurfaceImpulse& received = system.surfaceImpulses()[0];
  EXPECT_EQ(received.surface, 1u);
  EXPECT_NEAR(received.linear.y(), -parcel.mass * 4 * 1.5, 1e-12);
  EXPECT_NEAR(received.angularAbout({0.3, 0, 0}).norm(), 0, 1e-12) << "it passes through the point hit";
  EXPECT_NEAR(received.angular.z(), 0.3 * received.linear.y(), 1e-12);
}

TEST(Contact, LightBodyYields) {
  // Two masses of 0.01 kg with restitution 1 exchange their velocities.
  DebrisSystem system(inVacuum(1));
  addOne(system, test::stone({0, 0.01, 0}, {0, -4, 0}));
  Surroundings body({TestPlane{.inverseMass = 100, .surface = 0}});
  body.surfaces = 1;
  system.step(kTick, Vector3d::Zero(), body);
  const Exchange exchange = system.takeExchange();
  EXPECT_NEAR(double(system.pieces()[0].velocity.y()), 0, 1e-6);
  EXPECT_NEAR(system.surfaceImpulses()[0].linear.y(), -0.04, 1e-12);
  EXPECT_NEAR(exchange.workOnSurfaces, 0.08, 1e-12) << "its whole kinetic energy";
  EXPECT_NEAR(exchange.contact.energy, -0.08, 1e-12);
}

TEST(Contact, HitLeavesTheRestitutionsShareOfTheSpin) {
  DebrisSystem system(inVacuum(0.5));
  DebrisParcel parcel = test::stone({0, 0.01, 0}, {0, -4, 0});
  parcel.spin = {10, -20, 30};
  addOne(system, parcel);
  Surroundings ground({kGround});
  system.step(kTick, Vector3d::Zero(), ground);
  EXPECT_EQ(system.pieces()[0].spin, Eigen::Vector3f(5, -10, 15));
}

TEST(Contact, NeverGivesEnergyFromSurfacesThatStandStill) {
  DebrisSystem system(inVacuum(0.6));
  test::Random random(9);
  for (int i = 0; i < 300; ++i)
    addOne(system, test::stone(Vector3d(0.5, 0.5, 0.5) + random.inBall(0.4), random.inBall(10)));
  Surroundings box({{.normal = Vector3d::UnitX()},
                    {.normal = -Vector3d::UnitX(), .offset = -1},
                    {.normal = Vector3d::UnitY()},
                    {.normal = -Vector3d::UnitY(), .offset = -1},
                    {.normal = Vector3d::UnitZ()},
                    {.normal = -Vector3d::UnitZ(), .offset = -1}});
  double kinetic = system.motion().kinetic;
  for (int i = 0; i < 480; ++i) {
    system.step(kTick, Vector3d::Zero(), box);
    EXPECT_LE(system.motion().kinetic, kinetic * (1 + 1e-12));
    kinetic = system.motion().kinetic;
    for (const DebrisPiece& piece : system.pieces()) {
      ASSERT_GT(piece.position.minCoeff(), 0);
      ASSERT_LT(piece.position.maxCoeff(), 1);
    }
  }
}

// What a ball has after the step: its motion before and what it received.
Motion pushed(TestBall ball, std::span<const SurfaceImpulse> impulses) {
  for (const SurfaceImpulse& impulse : impulses) {
    if (impulse.surface != ball.surface) continue;
    ball.body.velocity += ball.body.inverseMass.cwiseProduct(impulse.linear);
    ball.body.spin += ball.body.inverseInertia * impulse.angularAbout(ball.body.centre);
  }
  return ball.motion();
}

// Pieces of 6.4 g at 10 m/s from random sides of a half space, all within reach of one tick.
std::vector<DebrisParcel> volley(std::uint32_t count, double reach, test::Random& random) {
  std::vector<DebrisParcel> parcels;
  for (std::uint32_t i = 0; i < count; ++i) {
    Vector3d from = random.inBall(1).normalized();
    from.y() = std::abs(from.y());
    DebrisParcel parcel = test::stone(reach * from, -10 * from + random.inBall(3));
    parcel.mass = 0.0064;
    parcel.spin = random.inBall(100);
    parcels.push_back(parcel);
  }
  return parcels;
}

TEST(Contact, ManyHitsOfOneStepMakeNoEnergy) {
  // An element of 90 g and its sphere's inertia. Against its motion at the step's start 60 pieces would throw
  // it off with six times the energy they had.
  for (const std::uint32_t count : {1u, 20u, 60u}) {
    for (const double restitution : {0.0, 0.3, 1.0}) {
      TestBall ball{.radius = 0.0168, .surface = 0};
      ball.body.centre = {0.4, -0.3, 0.2};
      ball.body.spin = {20, -30, 10};
      ball.body.inverseMass.setConstant(1 / 0.09);
      ball.body.inverseInertia = Eigen::Matrix3d::Identity() / (0.4 * 0.09 * 0.0168 * 0.0168);
      DebrisSystem system(inVacuum(restitution));
      test::Random random(count);
      std::vector<DebrisParcel> parcels = volley(count, ball.radius + kRadius + 0.005, random);
      for (DebrisParcel& parcel : parcels) parcel.position += ball.body.centre;
      system.add(parcels);
      Surroundings world;
      world.surfaces = 1;
      world.balls = {ball};
      const Motion pieces = system.motion(), before = ball.motion();
      system.step(kTick, Vector3d::Zero(), world);
      const Motion after = pushed(ball, system.surfaceImpulses());
      const Motion left = system.motion();
      const double energy = pieces.kinetic + before.kinetic;
      EXPECT_LE(left.kinetic + after.kinetic, energy * (1 + 1e-12)) << count << " at " << restitution;
      EXPECT_GT((after.linear - before.linear).norm(), 0.03) << "they did hit";
      // Sums of 60 terms of 0.1: rounding.
      EXPECT_LT((left.linear + after.linear - pieces.linear - before.linear).norm(), 1e-14);
      EXPECT_LT((left.angular + after.angular - pieces.angular - before.angular).norm(), 1e-14);
      const Exchange exchange = system.takeExchange();
      EXPECT_NEAR(exchange.workOnSurfaces, after.kinetic - before.kinetic, 1e-12 * energy);
      EXPECT_NEAR(exchange.contact.energy, left.kinetic - pieces.kinetic, 1e-12 * energy);
    }
  }
}

TEST(Contact, HitsInARowAreHitsOfOneAfterTheOther) {
  // Head-on and without restitution each piece ends at the speed of ball and pieces so far: after k of them
  // v = sum m_i v_i / (M + k m) if they stuck; a piece that was left behind is hit no more, so the ball's
  // speed is V_k = V_{k-1} + m (v - V_{k-1}) / (M + m).
  const double m = 0.0064, mass = 0.09, speed = 10;
  TestBall ball{.radius = 0.0168, .surface = 0};
  ball.body.inverseMass.setConstant(1 / mass);
  ball.body.inverseInertia = Eigen::Matrix3d::Identity() / (0.4 * mass * 0.0168 * 0.0168);
  DebrisSystem system(inVacuum(0));
  DebrisParcel parcel = test::stone({0, 0.03, 0}, {0, -speed, 0});
  parcel.mass = m;
  double expected = 0;
  for (int k = 0; k < 20; ++k) {
    system.add({&parcel, 1});
    expected += m * (speed - expected) / (mass + m);
  }
  Surroundings world;
  world.surfaces = 1;
  world.balls = {ball};
  system.step(kTick, Vector3d::Zero(), world);
  EXPECT_NEAR(pushed(ball, system.surfaceImpulses()).linear.y(), -mass * expected, 1e-12);
}

TEST(Contact, ASpinningSurfaceGivesNoMoreEnergyThanItHas) {
  // Piece and ball spin the same way, the ball faster: what the piece gains the ball loses, and more.
  TestBall ball{.radius = 0.0168, .surface = 0};
  ball.body.spin = {0, 300, 0};
  ball.body.inverseMass.setConstant(1 / 0.01);
  ball.body.inverseInertia = Eigen::Matrix3d::Identity() / 1e-6;
  DebrisSystem system(inVacuum(0));
  DebrisParcel parcel = test::stone({0, 0.03, 0}, {0, -5, 0});
  parcel.spin = {0, 100, 0};
  system.add({&parcel, 1});
  Surroundings world;
  world.surfaces = 1;
  world.balls = {ball};
  const double before = system.motion().kinetic + ball.motion().kinetic;
  system.step(kTick, Vector3d::Zero(), world);
  const Motion after = pushed(ball, system.surfaceImpulses());
  EXPECT_LT(system.motion().kinetic + after.kinetic, before);
  // Both inertias are 1e-6, so without restitution both end at the mean spin.
  EXPECT_NEAR(double(system.pieces()[0].spin.y()), 200, 1e-4);
}

}  // namespace
}  // namespace rubble::test
