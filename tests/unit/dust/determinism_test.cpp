// The same bits on any number of threads, and on every run.
#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

// Bits of all that a step leaves behind.
std::vector<std::uint32_t> run(int threads) {
  DustGridDef def = test::cube(32, 3);  // large enough that every stage wakes the pool
  def.threads = threads;
  CpuDust grid(def);
  test::Sequence random;
  DustObstacle box;
  box.kind = DustObstacle::Kind::Box;
  box.position = Eigen::Vector3f(0.5f, 1, 0.3f);
  box.orientation = Eigen::Quaternionf(Eigen::AngleAxisf(0.5f, Eigen::Vector3f::UnitZ()));
  box.spin = Eigen::Vector3f(0, 3, 0);
  for (int i = 0; i < 20; ++i) grid.step(1.0f / 60, test::burst(random), {&box, 1});
  std::vector<std::uint32_t> bits;
  for (const Field field : {Field::Velocity, Field::Density, Field::Faces, Field::Pressure}) {
    std::vector<float> values;
    grid.read(field, values);
    for (const float v : values) bits.push_back(std::bit_cast<std::uint32_t>(v));
  }
  const DustTotals t = grid.totals();
  for (const double v : {t.air, t.settled, t.left}) {
    const auto word = std::bit_cast<std::uint64_t>(v);
    bits.push_back(std::uint32_t(word));
    bits.push_back(std::uint32_t(word >> 32));
  }
  return bits;
}

TEST(Determinism, OneTwoAndThreeThreadsGiveTheSameBits) {
  const std::vector<std::uint32_t> one = run(1);
  EXPECT_TRUE(one == run(2));
  EXPECT_TRUE(one == run(3));  // parts of unequal length
}

}  // namespace
}  // namespace rubble::test
