// A packed body is as strong as its material says. More sizes and seeds are in strength_long_test.cpp.
#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

// Slow: less than 1 % of the speed of sound times the strain at which it breaks.
double tensileShare(const Material& m, Plates plates) {
  return strengthOf(packedCube(216, 1), m, plates, 0.05, 6 * m.tensileStrength / m.youngsModulus) /
         m.tensileStrength;
}
double compressiveShare(const Material& m, Plates plates) {
  return strengthOf(packedCube(216, 1), m, plates, -0.1, 4 * m.compressiveStrength / m.youngsModulus) /
         m.compressiveStrength;
}

TEST(PackedStrength, IsItsTensileStrengthWhenPulled) {
  const double share = tensileShare(material("concrete_soft"), Plates::Glued);
  EXPECT_GT(share, 0.6);
  EXPECT_LT(share, 1.3);
}

TEST(PackedStrength, IsItsCompressiveStrengthWhenCrushed) {
  for (const Plates plates : {Plates::Glued, Plates::Greased}) {
    const double share = compressiveShare(material("concrete_soft"), plates);
    EXPECT_GT(share, 0.6) << int(plates);
    EXPECT_LT(share, 1.3) << int(plates);
  }
}

TEST(PackedStrength, TwiceTheCompressiveStrengthIsTwiceTheStrengthWhenCrushed) {
  // Of a stiff material, so that both break at strains of 1e-3.
  Material weak = material("concrete_soft");
  weak.youngsModulus = 3e9;
  weak.breakingAngle = 2 * weak.tensileStrength / weak.youngsModulus;  // the paper's, of no effect here
  Material strong = weak;
  strong.compressiveStrength *= 2;
  const auto peak = [](const Material& m) {
    return strengthOf(packedCube(216, 1), m, Plates::Greased, -0.02,
                      4 * m.compressiveStrength / m.youngsModulus);
  };
  EXPECT_NEAR(peak(strong) / peak(weak), 2, 0.4);
}

}  // namespace
}  // namespace rubble::test
