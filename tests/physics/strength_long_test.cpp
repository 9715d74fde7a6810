// Strength of packed cubes over sizes, seeds, friction and strains: minutes. The table is in
// plugin/edem/README.md.
#include <string>
#include <tuple>

#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

// Strains at break of 0.011 and 0.11 (more than concrete_soft's), and of 1e-4 and 1e-3 (rock and concrete).
Material materialOf(bool stiff) {
  Material m = material("concrete_soft");
  m.youngsModulus = stiff ? 3e9 : 30e6;
  m.tensileStrength = stiff ? 0.3e6 : 0.33e6;
  m.compressiveStrength = 10 * m.tensileStrength;
  return m;
}

// Elements, seed, stiff.
class PackedCube : public ::testing::TestWithParam<std::tuple<int, int, bool>> {
 protected:
  // The attributes stand in the report of --gtest_output.
  void expect(const std::string& what, double share) {
    RecordProperty(what, std::to_string(share));
    EXPECT_GT(share, 0.6) << what;
    EXPECT_LT(share, 1.3) << what;
  }
};

TEST_P(PackedCube, BreaksAtTheStrengthOfItsMaterial) {
  const auto [elements, seed, stiff] = GetParam();
  const auto cube = packedCube(std::size_t(elements), std::uint64_t(seed));
  Material m = materialOf(stiff);
  const double strain = m.compressiveStrength / m.youngsModulus;  // at which it is crushed
  // Sound crosses the cube a hundred times until then.
  const double speed = 0.01 * strain * std::sqrt(m.youngsModulus / m.density);
  expect("pulled", strengthOf(cube, m, Plates::Glued, 0.1 * speed, 0.6 * strain) / m.tensileStrength);
  for (const double friction : {0.0, 0.6}) {
    m.friction = friction;
    const std::string suffix = friction > 0 ? "" : "_without_friction";
    const auto crushed = [&](Plates plates) {
      return strengthOf(cube, m, plates, -speed, 4 * strain) / m.compressiveStrength;
    };
    expect("crushed_glued" + suffix, crushed(Plates::Glued));
    expect("crushed_greased" + suffix, crushed(Plates::Greased));
  }
}
INSTANTIATE_TEST_SUITE_P(Long, PackedCube,
                         ::testing::Combine(::testing::Values(216, 512, 1000, 4096),
                                            ::testing::Values(1, 2, 3), ::testing::Bool()));

}  // namespace
}  // namespace rubble::test
