// Strength of packed cubes over sizes, seeds, friction and strains: minutes. The table is in
// plugin/README.md.
#include <cstdio>

#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

// Strains at break of 0.011 and 0.11 (concrete_soft), and of 1e-4 and 1e-3 (rock and concrete).
Material stiff() {
  Material m = material("concrete_soft");
  m.name = "stiff";
  m.youngsModulus = 3e9;
  m.tensileStrength = 0.3e6;
  m.compressiveStrength = 3e6;
  return m;
}

class PackedStrength : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PackedStrength, IsWithinThirtyPercentOfItsMaterials) {
  for (const Material& base : {material("concrete_soft"), stiff()}) {
    const double strain = base.compressiveStrength / base.youngsModulus;  // at which it is crushed
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const auto cube = packedCube(GetParam(), seed);
      // The plates cross the strain at break in about a hundred echoes of sound.
      const double speed = 0.01 * strain * std::sqrt(base.youngsModulus / base.density);
      const double pulled =
          strengthOf(cube, base, Plates::Glued, 0.1 * speed, 0.6 * strain) / base.tensileStrength;
      EXPECT_GT(pulled, 0.6) << base.name << " seed " << seed;
      EXPECT_LT(pulled, 1.3) << base.name << " seed " << seed;
      for (const double friction : {0.0, 0.6}) {
        Material m = base;
        m.friction = friction;
        for (const Plates plates : {Plates::Glued, Plates::Greased}) {
          const double crushed = strengthOf(cube, m, plates, -speed, 4 * strain) / base.compressiveStrength;
          EXPECT_GT(crushed, 0.6) << base.name << " seed " << seed << " mu " << friction;
          EXPECT_LT(crushed, 1.3) << base.name << " seed " << seed << " mu " << friction;
          std::printf("%s %zu seed %d mu %.1f %s: crushed at %.3f f_c, pulled at %.3f f_t\n", m.name.c_str(),
                      GetParam(), int(seed), friction, plates == Plates::Glued ? "glued" : "greased", crushed,
                      pulled);
        }
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Sizes, PackedStrength, ::testing::Values(216, 512, 1000, 4096));

}  // namespace
}  // namespace rubble::test
