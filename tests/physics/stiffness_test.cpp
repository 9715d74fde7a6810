// A packed body is as stiff as its material says.
#include "edem/prestress.h"
#include "physics/strength_cube.h"

namespace rubble::test {
namespace {

// k = E A / |d0| over all faces of the cells, acting at their centroids, is the solid's modulus in any
// packing [BolanderSaito98]. What is missing: faces below 2 % of h^2, which have no spring, 0.15 % of all
// area.
TEST(PackedStiffness, IsYoungsModulusWhenPulled) {
  const Material m = material("concrete_soft");
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    // The cross-section and the length change by 1e-4.
    const double modulus = edem::modulusOf({packedCube(216, seed), kCubeEdge}, m, 1e-3);
    EXPECT_NEAR(modulus, m.youngsModulus, 0.01 * m.youngsModulus) << seed;
  }
}

// In an even strain a cell inside bears the same traction on all its faces, which is in balance, forces and
// torques alike, as the faces close; wherever in its cell the element stands. The cook stands it beside where
// its cell was cut around it (cook/balance.h), by a stretch of 1.9 to 3.2 % along the axes: what it is more
// along one than along another is out of balance.
TEST(PackedStiffness, EvenStrainTurnsNoElementInside) {
  constexpr double kUneven = 0.013;
  constexpr double kStrain = 1e-6;
  CookOptions options;
  options.elements = 216;
  options.minFaceArea = 0;  // a face left out would be missed
  edem::BodyDef def;
  def.asset =
      std::make_shared<const Asset>(cookStrictly(boxMesh(Eigen::Vector3d::Constant(kCubeEdge)), options));
  def.anchored = false;
  const Asset& asset = *def.asset;
  for (int axis = 0; axis < 3; ++axis) {
    auto body = edem::makeBody<double>(def, 0);
    for (std::size_t i = 0; i < body.elementCount(); ++i)
      body.state.displacement[i][axis] = kStrain * asset.positions[i][axis];
    edem::Books books;
    edem::beginSubstep(body.state, body.work);
    edem::accumulateSprings(body, body.work, 0, false, books);
    const double stress = def.material.youngsModulus * kStrain;
    double turning = 0, pushing = 0;
    int inside = 0;
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
      const auto faces = asset.cellFaces(i);
      if (std::any_of(faces.begin(), faces.end(),
                      [](const CellFace& f) { return f.neighbour == kNoElement; }))
        continue;
      turning = std::max(turning, body.work.torque[i].norm() / (stress * asset.volumes[i]));
      pushing = std::max(pushing, body.work.force[i].norm() / (stress * std::pow(asset.volumes[i], 2.0 / 3)));
      ++inside;
    }
    ASSERT_GT(inside, 20);
    EXPECT_LT(turning, kUneven) << axis;
    EXPECT_LT(pushing, kUneven) << axis;
  }
}

// Sag at x of a cantilever of square section under its own weight, w = q x^2 (6 L^2 - 4 L x + x^2) / (24 E I)
// + q (L x - x^2 / 2) / (kappa G A), with kappa = 5/6 and G = E/2 for a lattice of nu = 0 (Timoshenko,
// Strength of Materials I).
double sagOfBeam(double length, double height, double x, const Material& m) {
  const double load = m.density * kGravity.norm() * height * height;
  const double bending = m.youngsModulus * std::pow(height, 4) / 12;
  const double shear = 5.0 / 6 * 0.5 * m.youngsModulus * height * height;
  return load * x * x * (6 * length * length - 4 * length * x + x * x) / (24 * bending) +
         load * (length * x - x * x / 2) / shear;
}

TEST(PackedStiffness, CantileverSagsAsTimoshenkoSays) {
  constexpr double kLength = 1, kHeight = 0.1;
  for (const std::size_t elements : {80u, 640u}) {  // two layers, and four
    CookOptions options;
    options.elements = elements;
    options.anchorDirection = -Eigen::Vector3d::UnitX();
    edem::BodyDef def;
    // Of so few elements not as many fit as the default fill wants: a warning.
    def.asset = std::make_shared<const Asset>(cook(boxMesh({kLength, kHeight, kHeight}), options));
    def.material.youngsModulus = 3e9;
    auto body = edem::makeBody<double>(def, 0);
    ASSERT_EQ(edem::prestress(body, kGravity).outcome, edem::PrestressOutcome::Done);
    double ratio = 0;
    int count = 0;
    for (std::size_t i = 0; i < body.elementCount(); ++i) {
      const double x = def.asset->positions[i].x() + kLength / 2;
      if (x < 0.9 * kLength) continue;
      ratio -= body.state.displacement[i].y() / sagOfBeam(kLength, kHeight, x, def.material);
      ++count;
    }
    EXPECT_NEAR(ratio / count, 1, 0.08) << elements;
  }
}

}  // namespace
}  // namespace rubble::test
