// Thresholds of the Mohr-Coulomb criterion and of the paper's stretch criterion.
#include "edem/criterion.h"

#include "physics/bodies.h"

namespace rubble::test {
namespace {

using edem::Vec3;

constexpr double kTension = 1e6, kCompression = 10e6, kModulus = 1e9;
constexpr double kFaceEdge = 0.2;  // of the square face [m]
// k_rot [N m]: so stiff that faces break before their angle shortens the spring.
constexpr double kRotational = 1e8;

template <class Real>
class Strength : public ::testing::Test {
 protected:
  // True if a spring along x, 0.2 m long, breaks under the tractions [Pa]; tension is positive. `turn` is the
  // relative rotation [rad].
  bool breaksAt(double normal, double shear, BreakMode& mode,
                const Eigen::Vector3d& turn = Eigen::Vector3d::Zero()) {
    Material material;
    material.tensileStrength = kTension;
    material.compressiveStrength = kCompression;
    edem::Spring<Real> spring{};
    spring.rest = Vec3<Real>(Real(0.2), 0, 0);
    spring.area = Real(0.04);
    spring.stiffness = Real(kModulus * 0.04 / 0.2);
    spring.rotational = Real(rotational);
    edem::SpringEnd<Real> first, second;
    second.displacement = Vec3<Real>(Real(normal * 0.2 / kModulus), Real(shear * 0.2 / kModulus), 0);
    // Half of the turn at either end, the opposite way: the relative rotation is `turn`, and the ends meet.
    const double angle = turn.norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX();
    const auto part = Eigen::Quaterniond(Eigen::AngleAxisd(angle / 2, axis));
    second.turn = edem::Quat<Real>(Real(part.w()), Real(part.x()), Real(part.y()), Real(part.z()));
    first.turn = second.turn.conjugate();
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
  double rotational = kRotational;
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

// The moment of k_rot by an angle about `axis`, so that M = `moment` [N m].
Eigen::Vector3d turnOf(double moment, const Eigen::Vector3d& axis) {
  return std::asin(moment / kRotational) * axis;
}

TYPED_TEST(Strength, BendsUntilTheEdgeReachesTensileStrength) {
  // A square face of edge a: sigma = M (a/2) / (a^4/12) = 6 M / a^3, beside the mean stress. At half the
  // tensile strength the other half is left for bending, and under pressure more than all of it.
  for (const double normal : {0.0, 0.5 * kTension, -2 * kTension, -9 * kTension}) {
    const double moment = (kTension - normal) * std::pow(kFaceEdge, 3) / 6;
    BreakMode mode{};
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0.6, -0.8)}) {
      EXPECT_FALSE(this->breaksAt(normal, 0, mode, turnOf(moment * (1 - 1e-4), axis))) << normal;
      EXPECT_TRUE(this->breaksAt(normal, 0, mode, turnOf(moment * (1 + 1e-4), axis))) << normal;
      EXPECT_EQ(mode, BreakMode::Tension);
    }
  }
}

TYPED_TEST(Strength, ItsPressedEdgeAloneBreaksNothing) {
  // Mean pressure 0.9 f_c, at the pressed edge 1.8 f_c, at the other edge none.
  BreakMode mode{};
  const double moment = 0.9 * kCompression * std::pow(kFaceEdge, 3) / 6;
  EXPECT_FALSE(this->breaksAt(-0.9 * kCompression, 0, mode, turnOf(moment, Eigen::Vector3d::UnitY())));
}

TYPED_TEST(Strength, TwistsUntilTheEdgeReachesShearStrength) {
  // Torsion of a square bar: tau = T / (0.208 a^3) in the middle of its sides (Timoshenko and Goodier, Theory
  // of Elasticity, 3rd ed., article 109); there it adds to the mean shear.
  const double c = 0.5 * std::sqrt(kCompression * kTension);
  const double mu = (kCompression - kTension) / (2 * std::sqrt(kCompression * kTension));
  for (const double pressure : {0.0, 2e6}) {
    for (const double shear : {0.0, 0.7e6}) {
      const double torque = (c + mu * pressure - shear) * 0.208 * std::pow(kFaceEdge, 3);
      BreakMode mode{};
      EXPECT_FALSE(
          this->breaksAt(-pressure, shear, mode, turnOf(torque * (1 - 1e-4), Eigen::Vector3d::UnitX())));
      EXPECT_TRUE(
          this->breaksAt(-pressure, shear, mode, turnOf(torque * (1 + 1e-4), Eigen::Vector3d::UnitX())));
      EXPECT_EQ(mode, BreakMode::Shear);
    }
  }
}

TYPED_TEST(Strength, ThePapersAngleIsOfThePaperAlone) {
  const double angle = Material{}.breakingAngle;
  BreakMode mode{};
  this->rotational = 0;
  const auto twist = [](double by) { return Eigen::Vector3d(by, 0, 0); };
  EXPECT_FALSE(this->breaksAt(0, 0, mode, twist(89.0 / 180 * edem::kPi)));
  EXPECT_TRUE(this->breaksAt(0, 0, mode, twist(91.0 / 180 * edem::kPi))) << "k_rot sin(phi) falls from here";
  this->model.breakCriterion = BreakCriterion::Stretch;
  EXPECT_FALSE(this->breaksAt(0, 0, mode, twist(angle * (1 - 1e-4))));
  EXPECT_TRUE(this->breaksAt(0, 0, mode, twist(angle * (1 + 1e-4))));
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
