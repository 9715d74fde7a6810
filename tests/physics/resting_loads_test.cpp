// What rests on what: the balance of forces, found step by step.
#include "edem/resting_loads.h"

#include <gtest/gtest.h>

namespace rubble::test {
namespace {

using edem::LoadedThing;
using edem::RestingLoads;

const Eigen::Vector3d kDown(0, -9.81, 0), kUp(0, 1, 0);
constexpr std::uint64_t kGround = edem::rigidName(1);

LoadedThing ground() {
  return {kGround, 0, kDown};
}
LoadedThing thing(std::uint32_t number, double mass) {
  return {edem::fragmentName(number, 0), 1 / mass, kDown};
}

TEST(RestingLoads, ATowerCarriesWhatIsAboveEachOfItsContacts) {
  RestingLoads loads;
  loads.beginTick(kDown);
  const double mass[] = {20, 600, 3};
  double rested[3] = {};
  for (int substep = 0; substep < 400; ++substep) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      // Each is pressed by 1e5 N, as in a blow.
      const std::size_t pair = loads.pairOf(i == 0 ? ground() : thing(i, mass[i - 1]), thing(i + 1, mass[i]));
      rested[i] = 1e5 * loads.share(pair);
      loads.push(pair, 1e5 * kUp);
    }
    loads.settle();
    if (substep == 200) loads.beginTick(kDown);  // keeps what it knows
  }
  EXPECT_NEAR(rested[0], 623 * 9.81, 0.01);
  EXPECT_NEAR(rested[1], 603 * 9.81, 0.01);
  EXPECT_NEAR(rested[2], 3 * 9.81, 0.01);
}

TEST(RestingLoads, NothingRestsOnWhatFallsWithIt) {
  RestingLoads loads;
  loads.beginTick(kDown);
  for (int substep = 0; substep < 10; ++substep) {
    const std::size_t pair = loads.pairOf(thing(1, 5), thing(2, 2));
    EXPECT_EQ(loads.share(pair), 0);
    loads.push(pair, 100 * kUp);
    loads.settle();
  }
}

TEST(RestingLoads, AWedgeCarriesTheComponentAlongItsNormal) {
  RestingLoads loads;
  loads.beginTick(kDown);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.6, 0.8, 0);
  std::size_t pair = 0;
  for (int substep = 0; substep < 10; ++substep) {
    pair = loads.pairOf(ground(), thing(1, 5));
    loads.push(pair, 1000 * normal);
    loads.settle();
  }
  EXPECT_NEAR(1000 * loads.share(pair), 5 * 9.81 * 0.8, 1e-9);
}

TEST(RestingLoads, WhatNoLongerTouchesIsForgotten) {
  RestingLoads loads;
  loads.beginTick(kDown);
  for (int substep = 0; substep < 2; ++substep) {
    loads.push(loads.pairOf(ground(), thing(1, 5)), 10 * kUp);
    loads.settle();
  }
  EXPECT_EQ(loads.share(loads.pairOf(ground(), thing(1, 5))), 1) << "no more than presses";
  loads.settle();
  EXPECT_EQ(loads.share(loads.pairOf(ground(), thing(1, 5))), 0);
}

}  // namespace
}  // namespace rubble::test
