// The book of the dust: emitted = in the air + settled + left, in the worst of plumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

// A ball swung through the plume at 10 m/s.
DustObstacle ball(int frame) {
  DustObstacle o;
  o.position = Eigen::Vector3f(-2 + 10 * float(frame) / 60, 1, 0);
  o.halfExtents.x() = 0.3f;
  o.velocity = Eigen::Vector3f(10, 0, 0);
  return o;
}

TEST(Mass, ViolentPlumeClosesWithinTwoPercentAndNowhereNegative) {
  DustGridDef def = test::cube(32, 3);
  def.grainRadius = 30e-6f;
  const Lattice lattice(def);
  CpuDust grid(def);
  test::Sequence random;
  std::vector<float> density;
  for (int frame = 0; frame < 90; ++frame) {
    const std::vector<DustSource> sources = frame < 45 ? test::burst(random) : std::vector<DustSource>{};
    const DustObstacle obstacle = ball(frame);
    grid.step(1.0f / 60, sources, {&obstacle, 1});
    grid.readDensity(density);
    ASSERT_GE(*std::min_element(density.begin(), density.end()), 0.0f) << "frame " << frame;
    // The balance must close each frame, not only at the end. Fluxes cancel: 1e-4 is rounding, 0.02 the
    // promise.
    ASSERT_LT(grid.totals().error(), 1e-4) << "frame " << frame;
  }
  const DustTotals t = grid.totals();
  EXPECT_NEAR(t.emitted, 45 * 32 * 0.01, 1e-6);
  // `left` is a flux, not the difference that would close any book: both ways must lose a share of it.
  EXPECT_GT(t.left, 0.05 * t.emitted);
  EXPECT_GT(t.settled, 0.01 * t.emitted);
  EXPECT_GT(t.air, 0.01 * t.emitted);
  // The air's share against a sum of our own.
  const double sum = std::accumulate(density.begin(), density.end(), 0.0) * lattice.volume();
  EXPECT_NEAR(t.air, sum, 1e-9 * t.emitted);
}

// Were `left` what is missing, dust taken out behind the grid's back would count as left.
TEST(Mass, DustTakenAwayIsAnErrorNotDustThatLeft) {
  const DustGridDef def = test::cube(16, 3);
  CpuDust grid(def);
  const DustSource source{Eigen::Vector3f(0, 1.5f, 0), Eigen::Vector3f::Zero(), 1, 1e-6f};
  grid.step(0.01f, {&source, 1}, {});
  grid.write(Field::Density, std::vector<float>(grid.valuesOf(Field::Density), 0.0f));
  grid.step(0.01f, {}, {});
  EXPECT_NEAR(grid.totals().error(), 1, 1e-6);
  EXPECT_LT(grid.totals().left, 1e-6);
}

}  // namespace
}  // namespace rubble::test
