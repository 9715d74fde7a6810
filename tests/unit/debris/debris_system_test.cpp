#include "debris/debris_system.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/debris/random.h"
#include "unit/debris/surroundings.h"

namespace rubble::test {
using namespace debris;
namespace {

using Eigen::Vector3d;
using test::Surroundings;

std::vector<DebrisParcel> cloud(std::uint32_t count, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<DebrisParcel> parcels;
  for (std::uint32_t i = 0; i < count; ++i) {
    DebrisParcel parcel =
        test::stone(Vector3d(0, 1.5, 0) + random.inBall(1), random.inBall(5), random.uniform(1e-5, 0.01));
    parcel.mass = random.uniform(1e-4, 1e-2);
    parcel.spin = random.inBall(30);
    parcel.body = i % 3;
    parcel.element = i;
    parcels.push_back(parcel);
  }
  return parcels;
}

void expectClosed(const Motion& before, const Exchange& x, const Motion& after, double tolerance) {
  const Vector3d linear =
      before.linear + x.added.linear - x.removed.linear + x.gravity.linear + x.air.linear + x.contact.linear;
  const Vector3d angular = before.angular + x.added.angular - x.removed.angular + x.gravity.angular +
                           x.air.angular + x.contact.angular;
  const double kinetic = before.kinetic + x.added.kinetic - x.removed.kinetic + x.gravity.energy +
                         x.air.energy + x.contact.energy;
  EXPECT_NEAR(before.mass + x.added.mass - x.removed.mass, after.mass, tolerance);
  EXPECT_LT((linear - after.linear).norm(), tolerance);
  EXPECT_LT((angular - after.angular).norm(), tolerance);
  EXPECT_NEAR(kinetic, after.kinetic, tolerance);
}

TEST(DebrisLedger, ClosesInEveryStepThroughFlightHitsRestAndRemoval) {
  DebrisSystemDef def;
  def.maxDebris = 400;
  DebrisSystem system(def);
  Surroundings world({{.normal = Vector3d::UnitY(), .velocity = {0.1, 0, 0}, .surface = 0},
                      {.normal = Vector3d::UnitX(), .offset = -0.5, .inverseMass = 1, .surface = 1},
                      {.normal = -Vector3d::UnitX(), .offset = -1}});
  world.surfaces = 2;
  bool rested = false, removed = false;
  for (std::uint32_t i = 0; i < 960; ++i) {
    if (i == 480) world.planes[0].velocity.setZero();
    if (i % 60 == 0 && i < 480) system.add(cloud(100, i));
    const Motion before = system.motion();
    const Exchange added = system.takeExchange();
    system.step(kTick, kDown, world);
    // 400 pieces of about 5 g and 5 m/s: sums of order 10, so 1e-11 is 1e-12 relative.
    expectClosed(before, system.takeExchange(), system.motion(), 1e-11);
    rested |= system.restingCount() > 0;
    removed |= added.removedCount > 0;
  }
  EXPECT_TRUE(rested && removed);
}

TEST(DebrisLedger, GravityAloneGivesWeightTimesTime) {
  DebrisSystemDef def;
  def.air = test::kVacuum;
  DebrisSystem system(def);
  system.add(cloud(200, 1));
  const Motion start = system.takeExchange().added;
  Surroundings nothing;
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, nothing);
  const Exchange x = system.takeExchange();
  EXPECT_LT((x.gravity.linear - start.mass * kDown).norm(), 1e-10);
  // Closed form of the work over 1 s: g . p0 + M g^2 / 2.
  EXPECT_NEAR(x.gravity.energy, kDown.dot(start.linear) + 0.5 * start.mass * kDown.squaredNorm(), 1e-9);
  EXPECT_LT(x.air.linear.norm() + x.air.angular.norm() + std::abs(x.air.energy), 1e-10);
  EXPECT_EQ(x.contact.linear, Vector3d::Zero());
}

TEST(DebrisLedger, AirOnlyTakesEnergy) {
  DebrisSystem system(DebrisSystemDef{});
  system.add(cloud(200, 1));
  Surroundings nothing;
  system.takeExchange();
  for (int i = 0; i < 240; ++i) {
    system.step(kTick, kDown, nothing);
    EXPECT_LT(system.takeExchange().air.energy, 0);
  }
}

TEST(DebrisLedger, MomentaShiftToAnyOrigin) {
  const Motion motion = motionOf(2, 0.5, {1, 2, 3}, {4, 5, 6}, {7, 8, 9});
  const Vector3d origin(-1, 0.5, 2);
  const Motion shifted = motionOf(2, 0.5, Vector3d(1, 2, 3) - origin, {4, 5, 6}, {7, 8, 9});
  EXPECT_LT((motion.angularAbout(origin) - shifted.angular).norm(), 1e-13);
}

TEST(Budget, FirstGivesUpWhatHasRestedLongest) {
  DebrisSystemDef def;
  def.maxDebris = 3;
  def.air = test::kVacuum;
  DebrisSystem system(def);
  Surroundings ground({test::TestPlane{}});
  const auto add = [&](double height, std::uint32_t element) {
    DebrisParcel parcel = test::stone(height);
    parcel.element = element;
    system.add({&parcel, 1});
  };
  add(50, 0);     // oldest, but in the air throughout
  add(0.2, 1);    // rests second
  add(0.006, 2);  // rests first
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, ground);
  ASSERT_EQ(system.restingCount(), 2u);
  const auto has = [&](std::uint32_t element) {
    for (const DebrisPiece& piece : system.pieces())
      if (piece.element == element) return true;
    return false;
  };
  add(40, 3);
  EXPECT_FALSE(has(2));
  add(40, 4);
  EXPECT_FALSE(has(1));
  add(40, 5);  // none rests: the oldest goes
  EXPECT_FALSE(has(0));
  EXPECT_TRUE(has(3) && has(4) && has(5));
  EXPECT_EQ(system.pieces().size(), 3u);
}

TEST(Budget, BooksWhatItRemoves) {
  DebrisSystemDef def;
  def.maxDebris = 50;
  DebrisSystem system(def);
  const std::vector<DebrisParcel> parcels = cloud(120, 4);
  system.add(parcels);
  Motion expected;
  for (std::size_t i = 0; i < 70; ++i) {
    const DebrisParcel& p = parcels[i];
    expected += motionOf(p.mass, p.inertia, p.position, p.velocity, p.spin);
  }
  const Exchange x = system.takeExchange();
  EXPECT_EQ(x.addedCount, 120u);
  EXPECT_EQ(x.removedCount, 70u);
  EXPECT_NEAR(x.removed.mass, expected.mass, 1e-14);
  EXPECT_LT((x.removed.linear - expected.linear).norm(), 1e-13);
  EXPECT_LT((x.removed.angular - expected.angular).norm(), 1e-13);
  EXPECT_NEAR(x.removed.kinetic, expected.kinetic, 1e-12);
}

TEST(Budget, PiecesBeyondReachLeaveAndAreBooked) {
  DebrisSystemDef def;
  def.reach = 100;
  def.air = test::kVacuum;
  DebrisSystem system(def);
  const DebrisParcel near = test::stone(0.0), far = test::stone({99, 0, 0}, {500, 0, 0});
  system.add({&far, 1});
  system.add({&near, 1});
  Surroundings nothing;
  system.step(kTick, Vector3d::Zero(), nothing);
  ASSERT_EQ(system.pieces().size(), 1u);
  EXPECT_EQ(system.pieces()[0].position, Eigen::Vector3f::Zero());
  EXPECT_NEAR(system.takeExchange().removed.linear.x(), 5, 1e-12);
}

TEST(Budget, BodyTakesItsPiecesAlong) {
  DebrisSystem system(DebrisSystemDef{});
  system.add(cloud(90, 2));
  EXPECT_EQ(system.removeBody(1), 30u);
  EXPECT_EQ(system.pieces().size(), 60u);
  for (const DebrisPiece& piece : system.pieces()) EXPECT_NE(piece.body, 1u);
  EXPECT_EQ(system.removeBody(0) + system.removeBody(2), 60u);
  EXPECT_EQ(system.motion().mass, 0);
  EXPECT_EQ(system.movingCount(), 0u);
}

TEST(Rest, PieceFallsWhenItsSupportIsGone) {
  DebrisSystemDef def;
  def.air = test::kVacuum;
  DebrisSystem system(def);
  const DebrisParcel parcel = test::stone(1.1);
  system.add({&parcel, 1});
  Surroundings shelf({test::TestPlane{.offset = 1, .surface = 2}});
  shelf.surfaces = 3;
  for (int i = 0; i < 480; ++i) system.step(kTick, kDown, shelf);
  ASSERT_EQ(system.restingCount(), 1u);
  const std::uint32_t other = 1, support = 2;
  EXPECT_EQ(system.wakeSupports({&other, 1}), 0u);
  EXPECT_EQ(system.wakeSupports({&support, 1}), 1u);
  Surroundings nothing;
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, nothing);
  EXPECT_NEAR(double(system.pieces()[0].position.y()), 1 + 0.005 - 9.81 / 2, 1e-4);
}

TEST(Rest, EverySurfaceThatHoldsAPieceIsItsSupport) {
  // In a corner of two walls and a floor: whichever goes, the piece is looked at again.
  for (const std::uint32_t leaving : {0u, 1u, 2u}) {
    DebrisSystem system(DebrisSystemDef{});
    const DebrisParcel parcel = test::stone({0.02, 0.02, 0.02}, {-1, 0, -1});
    system.add({&parcel, 1});
    const Vector3d slanting = Vector3d(1, 1, 0).normalized(), other = Vector3d(0, 1, 1).normalized();
    Surroundings dimple({{.normal = slanting, .surface = 0},
                         {.normal = other, .surface = 1},
                         {.normal = Vector3d(-1, 1, -1).normalized(), .surface = 2}});
    dimple.surfaces = 4;
    for (int i = 0; i < 480; ++i) system.step(kTick, kDown, dimple);
    ASSERT_EQ(system.restingCount(), 1u);
    EXPECT_EQ(dimple.supports.size(), 3u);
    const std::uint32_t another = 3;
    EXPECT_EQ(system.wakeSupports({&another, 1}), 0u);
    EXPECT_EQ(system.wakeSupports({&leaving, 1}), 1u);
  }
}

TEST(Rest, BoxWakesWhatIsInIt) {
  DebrisSystem system(DebrisSystemDef{});
  for (int i = 0; i < 10; ++i) {
    const DebrisParcel parcel = test::stone({0.1 * i, 0.006, 0}, Vector3d::Zero());
    system.add({&parcel, 1});
  }
  Surroundings ground({test::TestPlane{}});
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, ground);
  ASSERT_EQ(system.restingCount(), 10u);
  const Eigen::AlignedBox3d far(Vector3d(5, 5, 5), Vector3d(6, 6, 6));
  EXPECT_EQ(system.wake({&far, 1}), 0u);
  const Eigen::AlignedBox3d boxes[] = {far, {Vector3d(0.25, -1, -1), Vector3d(0.55, 1, 1)}};
  EXPECT_EQ(system.wake(boxes), 3u);
  EXPECT_EQ(system.movingCount(), 3u);
  for (int i = 0; i < 240; ++i) system.step(kTick, kDown, ground);
  EXPECT_EQ(system.restingCount(), 10u);
}

TEST(Determinism, SameCallsGiveTheSameBits) {
  const auto run = [] {
    DebrisSystemDef def;
    def.maxDebris = 300;
    DebrisSystem system(def);
    Surroundings ground({test::TestPlane{}});
    const Eigen::AlignedBox3d box(Vector3d(-1, -1, -1), Vector3d(0, 1, 0));
    for (std::uint32_t i = 0; i < 480; ++i) {
      if (i % 50 == 0) system.add(cloud(60, i));
      if (i % 90 == 89) system.wake({&box, 1});
      system.step(kTick, kDown, ground);
    }
    return system.hash();
  };
  EXPECT_EQ(run(), run());
}

TEST(Determinism, HashSeesOneBit) {
  DebrisSystem a(DebrisSystemDef{}), b(DebrisSystemDef{});
  std::vector<DebrisParcel> parcels = cloud(50, 1);
  a.add(parcels);
  parcels[20].velocity.x() = std::nextafter(parcels[20].velocity.x(), 100.0);
  b.add(parcels);
  EXPECT_NE(a.hash(), b.hash());
}

TEST(DebrisStep, TellsTheColliderWhereItWillSweep) {
  DebrisSystem system(DebrisSystemDef{});
  system.add(cloud(200, 3));
  Surroundings nothing;
  for (int i = 0; i < 100; ++i) {
    system.step(kTick, kDown, nothing);
    for (const DebrisPiece& piece : system.pieces())
      ASSERT_TRUE(nothing.swept.contains(piece.position.cast<double>()));
  }
}

TEST(DebrisStep, MemoryIsTakenAtLoad) {
  DebrisSystemDef def;
  def.maxDebris = 500;
  DebrisSystem system(def);
  system.add(cloud(1, 0));
  const DebrisPiece* first = system.pieces().data();
  system.add(cloud(2000, 1));
  EXPECT_EQ(system.pieces().data(), first);
}

}  // namespace
}  // namespace rubble::test
