// Numbers that nobody should pass in: they are skipped or cut, and the grid stays finite and in balance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dust/solids.h"
#include "shared/dust.h"
#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

const float kHuge = std::numeric_limits<float>::max();

// Finite everywhere, no density below zero, no air faster than the limit of each component.
void expectSane(const CpuDust& grid) {
  std::vector<float> density;
  std::vector<Eigen::Vector3f> velocity;
  grid.readDensity(density);
  grid.readVelocity(velocity);
  EXPECT_TRUE(
      std::all_of(density.begin(), density.end(), [](float d) { return std::isfinite(d) && d >= 0; }));
  EXPECT_TRUE(
      std::all_of(velocity.begin(), velocity.end(), [](const Eigen::Vector3f& u) { return u.allFinite(); }));
  const DustTotals t = grid.totals();
  EXPECT_TRUE(std::isfinite(t.emitted) && std::isfinite(t.air) && std::isfinite(t.settled) &&
              std::isfinite(t.left));
  EXPECT_LT(t.error(), 1e-4);
}

DustSource good() {
  return {Eigen::Vector3f(0.1f, 1, 0.1f), Eigen::Vector3f(1, 2, 3), 0.01f, 1e-6f};
}

TEST(HostileDust, SourcesThatAreNoneAreSkipped) {
  std::vector<DustSource> sources(13, good());
  for (int a = 0; a < 3; ++a) {
    sources[a].position[a] = kNan;
    sources[3 + a].velocity[a] = kInfinity;
  }
  sources[6].position.setConstant(-kInfinity);
  sources[7].mass = kNan;
  sources[8].mass = kInfinity;
  sources[9].mass = -1;
  sources[10].mass = 0;
  sources[11].mass = kHuge;
  CpuDust grid(test::cube(16, 2));
  for (int i = 0; i < 5; ++i) grid.step(1.0f / 60, sources, {});
  expectSane(grid);
  EXPECT_NEAR(grid.totals().emitted, 5 * 0.01, 1e-8);  // of the one good source
}

TEST(HostileDust, HugeVelocitiesAreCut) {
  std::vector<DustSource> sources(3, good());
  sources[0].velocity = Eigen::Vector3f(kHuge, -kHuge, kHuge);
  sources[1].velocity = Eigen::Vector3f(0, 1e30f, 0);
  sources[1].position.x() = -0.5f;
  sources[2].position = Eigen::Vector3f(kHuge, -kHuge, 0);
  CpuDust grid(test::cube(16, 2));
  for (int i = 0; i < 20; ++i) grid.step(1.0f / 60, sources, {});
  expectSane(grid);
}

TEST(HostileDust, HeaviestSourceInTheSmallestBoxStaysFinite) {
  DustGridDef def = test::cube(16, 1e-3f);
  def.gravity = 1e3f;
  def.airDensity = 1e-3f;
  def.vorticity = 1;
  DustSource heavy{Eigen::Vector3f(0, 5e-4f, 0), Eigen::Vector3f(kHuge, 0, 0), shared::kDustMaxSourceMass, 1};
  CpuDust grid(def);
  for (int i = 0; i < 10; ++i) grid.step(0.1f, {&heavy, 1}, {});
  expectSane(grid);
}

// 10 s and infinity count as the longest step; less than nothing and not a number count as none.
TEST(HostileDust, TimesOutOfRangeAreCut) {
  const DustSource source = good();
  const auto after = [&](float dt) {
    CpuDust grid(test::cube(16, 2));
    grid.step(0.02f, {&source, 1}, {});
    for (int i = 0; i < 3; ++i) grid.step(dt, {&source, 1}, {});
    expectSane(grid);
    std::vector<float> density;
    grid.readDensity(density);
    return density;
  };
  EXPECT_EQ(after(10), after(shared::kDustMaxStep));
  EXPECT_EQ(after(kInfinity), after(shared::kDustMaxStep));
  EXPECT_EQ(after(-1), after(0));
  EXPECT_EQ(after(kNan), after(0));
  EXPECT_NE(after(10), after(0));
}

TEST(HostileDust, StepOfNothingAddsTheSourceAndMovesNothing) {
  const DustSource source = good();
  CpuDust grid(test::cube(16, 2));
  grid.step(0, {&source, 1}, {});
  std::vector<float> first, second;
  grid.readDensity(first);
  grid.step(0, {}, {});
  grid.readDensity(second);
  EXPECT_EQ(first, second);
  EXPECT_NEAR(grid.totals().air, 0.01, 1e-8);
}

TEST(HostileDust, ObstaclesThatAreNoneAreSkipped) {
  std::vector<DustObstacle> bad(8);
  bad[0].position.x() = kNan;
  bad[1].velocity.y() = kInfinity;
  bad[2].spin.z() = kNan;
  bad[3].halfExtents.x() = -1;
  bad[4].halfExtents.setZero();
  bad[5].orientation.coeffs().setZero();
  bad[6].orientation.w() = kNan;
  bad[7].position = Eigen::Vector3f(kHuge, 0, 0);
  std::vector<SolidCells> solids;
  const Lattice lattice(test::cube(16, 2));
  gatherSolids(lattice, bad, solids);
  EXPECT_TRUE(solids.empty());
  // A body the size of the grid leaves no air at all, and a spin without bound a velocity within it.
  DustObstacle all;
  all.kind = DustObstacle::Kind::Box;
  all.halfExtents.setConstant(kHuge);
  all.spin.setConstant(kHuge);
  bad.push_back(all);
  const DustSource source = good();
  CpuDust grid(test::cube(16, 2));
  for (int i = 0; i < 5; ++i) grid.step(1.0f / 60, {&source, 1}, bad);
  expectSane(grid);
  for (int i = 0; i < 5; ++i) grid.step(1.0f / 60, {&source, 1}, {});
  expectSane(grid);
}

// Cut in length, not in direction.
TEST(HostileDust, VelocityOfABodyIsCutToTheLimit) {
  DustObstacle fast;
  fast.position.y() = 1;
  fast.velocity = Eigen::Vector3f(0, 0, -1e30f);
  std::vector<SolidCells> solids;
  gatherSolids(Lattice(test::cube(16, 2)), {&fast, 1}, solids);
  ASSERT_EQ(solids.size(), 1u);
  EXPECT_FLOAT_EQ(solids[0].solid.velocity.z, -shared::kDustMaxSpeed);
}

TEST(HostileDust, WrongNumberOfValuesIsRefused) {
  CpuDust grid(test::cube(8, 2));
  EXPECT_THROW(grid.write(Field::Density, std::vector<float>(7)), Error);
  EXPECT_THROW(grid.write(Field::Pressure, std::vector<float>(512)), Error);
}

}  // namespace
}  // namespace rubble::test
