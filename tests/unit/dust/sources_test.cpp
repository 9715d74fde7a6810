// Dust enters the nearest cell; the cell's air takes the mean velocity of what broke there (eq. (6), (7)).
#include "dust/sources.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

DustSource source(float x, float speed, float mass) {
  return {Eigen::Vector3f(x, 1.1f, 0.1f), Eigen::Vector3f(speed, 0, 0), mass, 1e-6f};
}

// (1 x 0.1 + 4 x 0.3) / 0.4 = 3.25 m/s and 0.4 kg in (2 / 16)^3 m^3.
TEST(Sources, CellTakesTheMassWeightedMeanVelocity) {
  const DustGridDef def = test::cube(16, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  const std::vector<DustSource> sources = {source(0.30f, 1, 0.1f), source(-0.5f, 7, 0.2f),
                                           source(0.33f, 4, 0.3f)};
  grid.step(0, sources, {});
  std::vector<Eigen::Vector3f> velocity;
  std::vector<float> density;
  grid.readVelocity(velocity);
  grid.readDensity(density);
  const int both = lattice.cellAt(sources[0].position), single = lattice.cellAt(sources[1].position);
  ASSERT_EQ(both, lattice.cellAt(sources[2].position));
  EXPECT_NEAR(double{velocity[both].x()}, 3.25, 1e-5);
  EXPECT_NEAR(double{density[both]}, 0.4 * 512, 1e-3);
  EXPECT_NEAR(double{velocity[single].x()}, 7, 1e-5);
  EXPECT_NEAR(double{density[single]}, 0.2 * 512, 1e-3);
  EXPECT_NEAR(grid.totals().air, 0.6, 1e-6);
}

TEST(Sources, OrderDoesNotMatterBetweenCells) {
  const Lattice lattice(test::cube(16, 2));
  const std::vector<DustSource> there = {source(0.3f, 1, 0.1f), source(-0.5f, 7, 0.2f)};
  const std::vector<DustSource> back = {there[1], there[0]};
  SourceCells a, b;
  a.gather(lattice, there);
  b.gather(lattice, back);
  ASSERT_EQ(a.cells().size(), 2u);
  ASSERT_EQ(b.cells().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.cells()[i].cell, b.cells()[i].cell);
    EXPECT_EQ(a.cells()[i].velocity.w, b.cells()[i].velocity.w);
  }
}

TEST(Sources, DustRaisedOutsideHasLeft) {
  CpuDust grid(test::cube(16, 2));
  const DustSource far = source(50, 1, 0.1f);
  grid.step(0.01f, {&far, 1}, {});
  EXPECT_NEAR(grid.totals().left, 0.1, 1e-7);
  EXPECT_EQ(grid.totals().air, 0);
  EXPECT_LT(grid.totals().error(), 1e-12);
}

}  // namespace
}  // namespace rubble::test
