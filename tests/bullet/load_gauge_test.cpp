// Which loads on a whole body are looked at again.
#include "bullet/load_gauge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "support/grid_asset.h"

namespace rubble::test {
namespace {

constexpr double kGaugeTick = 1.0 / 60;  // [s]

// Of a beam of 1 x 0.1 x 0.1 m along x.
struct GaugedBeam {
  Asset asset = gridAsset({.cubes = {20, 2, 2}, .edge = 0.05, .anchored = false});
  std::vector<double> masses = std::vector<double>(asset.elementCount(), 0.3),
                      inertias = std::vector<double>(asset.elementCount(), 1e-4);
  bullet::LoadGauge gauge{
      bullet::sectionsOf(asset, Eigen::Isometry3d::Identity(), {0.5, 0.05, 0.05}, masses, inertias),
      rubble::material("concrete_soft"), Model()};

  // Presses of 1 N s in a tick at these places along it.
  static bullet::Pressure at(std::initializer_list<double> places) {
    bullet::Pressure pressure;
    for (const double x : places) pressure.add(1, {x, 0.05, 0});
    return pressure;
  }
  bool settlesIn(double time, const bullet::Pressure& pressure, double spin = 0) {
    bool settled = false;
    for (double t = 0; t < time; t += kGaugeTick) settled = gauge.isSettled(pressure, spin, kGaugeTick);
    return settled;
  }
};

TEST(LoadGauge, LooksUntilALoadHasLainForHalfASecond) {
  GaugedBeam beam;
  const bullet::Pressure load = beam.at({-0.4, 0.4});
  EXPECT_FALSE(beam.settlesIn(0.4, load));
  EXPECT_TRUE(beam.settlesIn(0.3, load));
}

TEST(LoadGauge, LooksAgainWhenALoadChangesMovesOrSpreads) {
  const bullet::Pressure load = GaugedBeam::at({-0.4, 0.4});
  bullet::Pressure heavier = load;
  heavier.sum *= 1.2;
  for (const bullet::Pressure& changed : {heavier, GaugedBeam::at({-0.3, 0.5}), GaugedBeam::at({0, 0}),
                                          GaugedBeam::at({}), GaugedBeam::at({-0.4, 0.4, 0})}) {
    GaugedBeam beam;
    ASSERT_TRUE(beam.settlesIn(0.7, load));
    EXPECT_FALSE(beam.gauge.isSettled(changed, 0, kGaugeTick));
    EXPECT_TRUE(beam.settlesIn(0.7, changed)) << "and settles there";
  }
}

// A load that comes so slowly that no tick differs from the last: the first one counts, not the last.
TEST(LoadGauge, SeesWhatGrowsSlowly) {
  GaugedBeam beam;
  bullet::Pressure load = GaugedBeam::at({-0.4, 0.4});
  ASSERT_TRUE(beam.settlesIn(0.7, load));
  bool seen = false;
  for (int tick = 0; tick < 60; ++tick) {
    load.sum *= 1.002;
    seen = seen || !beam.gauge.isSettled(load, 0, kGaugeTick);
  }
  EXPECT_TRUE(seen);
}

TEST(LoadGauge, LooksAtWhatTurnsAndAtWhatGravityChangesOfTheHeld) {
  GaugedBeam beam;
  bullet::Pressure load = GaugedBeam::at({-0.4, 0.4});
  EXPECT_FALSE(beam.settlesIn(2, load, 1));
  ASSERT_TRUE(beam.settlesIn(0.7, load));
  load.gravity = {0, -20, 0};
  EXPECT_FALSE(beam.gauge.isSettled(load, 0, kGaugeTick));
}

// 1 kN on the middle of 0.8 m: M c / I = 200 N m / 1.67e-4 m^3 = 1.2 MPa, several times the strength.
TEST(LoadGauge, NeverSettlesNearAThaw) {
  GaugedBeam beam;
  std::vector<bullet::ContactPatch> patches;
  for (const auto& [x, push] : {std::pair(-0.4, 500.0), std::pair(0.4, 500.0), std::pair(0.0, -1000.0)}) {
    bullet::ContactPatch& patch = patches.emplace_back();
    const Eigen::Vector3d at(x, 0, 0), force(0, push, 0);
    patch.corners = {at};
    patch.middle = at;
    patch.press = std::abs(push);
    patch.load = {force, at.cross(force)};
  }
  bullet::RestingLoad load;
  load.contacts = patches;
  for (int tick = 0; tick < 60; ++tick) beam.gauge.note(load, kGaugeTick);
  EXPECT_GT(beam.gauge.share(), 1);
  EXPECT_FALSE(beam.settlesIn(2, GaugedBeam::at({-0.4, 0.4})));
}

}  // namespace
}  // namespace rubble::test
