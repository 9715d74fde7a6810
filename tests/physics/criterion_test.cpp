// Thresholds of the Mohr-Coulomb criterion and of the paper's stretch criterion.
#include "edem/criterion.h"

#include "physics/bodies.h"

namespace rubble::test {
namespace {

using edem::Vec3;

constexpr double kTension = 1e6, kCompression = 10e6, kModulus = 1e9;

template <class Real>
class Strength : public ::testing::Test {
 protected:
  // True if a spring along x, 0.2 m long, breaks under the tractions [Pa]; tension is positive.
  bool breaksAt(double normal, double shear, BreakMode& mode, double angle = 0) {
    Material material;
    material.tensileStrength = kTension;
    material.compressiveStrength = kCompression;
    edem::Spring<Real> spring{};
    spring.rest = Vec3<Real>(Real(0.2), 0, 0);
    spring.area = Real(0.04);
    spring.stiffness = Real(kModulus * 0.04 / 0.2);
    edem::SpringEnd<Real> first, second;
    second.displacement = Vec3<Real>(Real(normal * 0.2 / kModulus), Real(shear * 0.2 / kModulus), 0);
    // Opposite half turns about the spring's axis: no gap, relative rotation `angle`.
    first.turn = edem::Quat<Real>(Real(std::cos(angle / 4)), Real(-std::sin(angle / 4)), 0, 0);
    second.turn = first.turn.conjugate();
    return edem::breaks(edem::makeCriterion<Real>(material, model), spring,
                        edem::springLoad(spring, first, second), mode);
  }
  void expectThreshold(double normal, double shear, BreakMode expected) {
    BreakMode mode{};
    // The traction turns into strains of 1e-3 to 1e-2, whose squares bend nothing here; 1e-4 is far above
    // rounding.
    EXPECT_FALSE(breaksAt(normal * (1 - 1e-4), shear * (1 - 1e-4), mode)) << normal << " " << shear;
    EXPECT_TRUE(breaksAt(normal * (1 + 1e-4), shear * (1 + 1e-4), mode)) << normal << " " << shear;
    EXPECT_EQ(mode, expected);
  }
  Model model;
};
TYPED_TEST_SUITE(Strength, Scalars);

TYPED_TEST(Strength, BreaksInTensionAtTensileStrength) {
  this->expectThreshold(kTension, 0, BreakMode::Tension);
}

TYPED_TEST(Strength, BreaksInCompressionAtCompressiveStrength) {
  this->expectThreshold(-kCompression, 0, BreakMode::Compression);
}

TYPED_TEST(Strength, BreaksInPureShearAtTheCohesion) {
  // c = sqrt(f_c f_t) / 2
  this->expectThreshold(0, 0.5 * std::sqrt(kCompression * kTension), BreakMode::Shear);
}

TYPED_TEST(Strength, PressureRaisesShearStrengthByInternalFriction) {
  // |t| = c + mu_s p, mu_s = (f_c - f_t) / (2 sqrt(f_c f_t)); both tractions are scaled together, so the
  // threshold is crossed where it stands only if the shear grows faster: p is held.
  const double c = 0.5 * std::sqrt(kCompression * kTension);
  const double mu = (kCompression - kTension) / (2 * std::sqrt(kCompression * kTension));
  const double p = 3e6;
  BreakMode mode{};
  EXPECT_FALSE(this->breaksAt(-p, (c + mu * p) * (1 - 1e-4), mode));
  EXPECT_TRUE(this->breaksAt(-p, (c + mu * p) * (1 + 1e-4), mode));
  EXPECT_EQ(mode, BreakMode::Shear);
}

TYPED_TEST(Strength, BreaksAtTheBreakingAngle) {
  const double angle = Material{}.breakingAngle;
  BreakMode mode{};
  EXPECT_FALSE(this->breaksAt(0, 0, mode, angle * (1 - 1e-4)));
  EXPECT_TRUE(this->breaksAt(0, 0, mode, angle * (1 + 1e-4)));
  EXPECT_EQ(mode, BreakMode::Rotation);
}

TYPED_TEST(Strength, ThePapersStretchIsAlikeInAllDirections) {
  this->model.breakCriterion = BreakCriterion::Stretch;
  const double traction = Material{}.stretchThreshold * kModulus;
  this->expectThreshold(traction, 0, BreakMode::Stretch);
  this->expectThreshold(-traction, 0, BreakMode::Stretch);
  this->expectThreshold(0, traction, BreakMode::Stretch);
}

}  // namespace
}  // namespace rubble::test
