// Elements that are pressed many times deeper into a rigid body than they are thick.
#include <numbers>

#include "physics/bodies.h"

namespace rubble::test {
namespace {

constexpr double kDeepEdge = 0.2;
constexpr double kDeepFall = 1000;                                           // [m/s^2]
constexpr double kDeepMass = 2400 * kDeepEdge * kDeepEdge * kDeepEdge;       // [kg]
constexpr double kDeepStiffness = 0.5 * 3000 * kDeepEdge;                    // k_n [N/m]
constexpr double kDeepest = 10 * std::numbers::sqrt3_v<double> * kDeepEdge;  // ten diagonals [m]

// A cube of 3 kPa that weighs what its contact would bear 64 m in the ground.
edem::BodyDef softCube(double spin) {
  edem::BodyDef def = block({1, 1, 1}, false, kDeepEdge);
  def.material.youngsModulus = 3000;
  def.spin = {0.6 * spin, 0, 0.8 * spin};
  return def;
}

edem::RigidProxy springyPlane() {
  edem::RigidProxy plane = fixedPlane();
  plane.restitution = 1;
  return plane;
}

template <class Real>
class DeepContact : public ::testing::Test {};
TYPED_TEST_SUITE(DeepContact, Scalars);

// As it turns, its faces press by their areas seen from above, which turn round where one stands upright.
TYPED_TEST(DeepContact, MakesNoEnergy) {
  for (const double spin : {0.2, 2.0}) {
    const auto solver = makeSolver<TypeParam>(false);
    solver->addBody(softCube(spin), kNoGravity);
    std::vector<edem::RigidProxy> proxies = {springyPlane()};
    double most = 0;
    for (int t = 0; t < 40; ++t) {
      solver->tick(kFrame, {0, -kDeepFall, 0}, proxies);
      ASSERT_EQ(solver->failure(), "");
      const edem::Books& books = solver->books();
      const double put = books.initialEnergy + books.gravity.work.done(),
                   held = books.kinetic + books.elastic;
      most = std::max(most, put);
      EXPECT_LE(held, put + 0.001 * most) << spin << " rad/s, tick " << t;
      EXPECT_NEAR(held - books.dissipated.done(), put, 0.001 * most) << spin << " rad/s, tick " << t;
      // A cube is seen with sqrt(3) of a face at most; its core weighs as much as a face.
      EXPECT_LE(books.elastic,
                0.5 * kDeepStiffness * (1 + std::numbers::sqrt3_v<double>)*kDeepest * kDeepest);
    }
  }
}

// Less deep all is given back: it falls on a ground that bears it, and comes up again as high as it was.
TYPED_TEST(DeepContact, SpringsBackFromLessThanThat) {
  const double weight = 0.25 * kDeepStiffness * kDeepest / kDeepMass;  // [m/s^2]
  const auto solver = makeSolver<TypeParam>(false);
  solver->addBody(softCube(0), kNoGravity);
  std::vector<edem::RigidProxy> proxies = {springyPlane()};
  const double begun = solver->position(0, 0).y();
  double lowest = begun, highest = -kDeepest;
  for (int t = 0; t < 240; ++t) {
    solver->tick(kFrame, {0, -weight, 0}, proxies);
    const double y = solver->position(0, 0).y();
    highest = y < lowest ? -kDeepest : std::max(highest, y);
    lowest = std::min(lowest, y);
  }
  EXPECT_LT(lowest, -3 * kDeepEdge);
  EXPECT_NEAR(highest, begun, 0.05 * (begun - lowest));
  EXPECT_NEAR(solver->books().dissipated.done(), 0, 1e-6 * solver->books().kinetic + 1e-6);
}

}  // namespace
}  // namespace rubble::test
