// An anchored body stands from its first step.
#include "edem/prestress.h"

#include "physics/bodies.h"

namespace rubble::test {
namespace {

template <class Real>
class Prestress : public ::testing::Test {};
TYPED_TEST_SUITE(Prestress, Scalars);

TYPED_TEST(Prestress, UndampedColumnStandsStillFromTheFirstTick) {
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(block({2, 10, 2}, true), kGravity);
  double fastest = 0;
  for (int t = 0; t < 120; ++t) {
    solver->tick(kFrame, kGravity, {});
    fastest = std::max(fastest, solver->maxSpeed(id));
  }
  EXPECT_LT(fastest, 1e-3);
  EXPECT_EQ(solver->view(id).broken, 0u);
  EXPECT_EQ(solver->view(id).fragments, 1u);
}

TYPED_TEST(Prestress, AnchorsCarryTheWeight) {
  const auto solver = makeSolver<TypeParam>();
  solver->addBody(block({2, 10, 2}, true), kGravity);
  for (int t = 0; t < 30; ++t) solver->tick(kFrame, kGravity, {});
  const edem::Books& books = solver->books();
  EXPECT_NEAR(books.gravity.linear.y(), -9.81 * books.mass * 0.5, 1e-6 * books.gravity.size);
  EXPECT_NEAR(books.anchors.linear.y(), -books.gravity.linear.y(), 1e-4 * books.gravity.size);
}

TYPED_TEST(Prestress, LeavesNoResidualForce) {
  auto body = edem::makeBody<TypeParam>(block({5, 6, 1}, true), 0);
  double residual = 1;
  ASSERT_TRUE(edem::prestress(body, kGravity, &residual));
  EXPECT_LT(residual, 1e-6);  // of an element's weight
}

TEST(PrestressedColumn, SettlesAsAUniformColumn) {
  // A lattice of cubes has no Poisson's ratio: a column of n elements under its own weight is n springs in a
  // row, spring j carries (n - j) elements; the anchor is half a spring long and so twice as stiff.
  constexpr int kElements = 10;
  const edem::BodyDef def = block({1, kElements, 1}, true);
  auto body = edem::makeBody<double>(def, 0);
  ASSERT_TRUE(edem::prestress(body, kGravity));
  const double weight = 9.81 * body.mass[0], k = def.material.youngsModulus * 0.2;
  double expected = kElements * weight / (2 * k);
  for (int j = 1; j < kElements; ++j) expected += (kElements - j) * weight / k;
  EXPECT_NEAR(-body.displacement[kElements - 1].y(), expected, 1e-6 * expected);
}

TYPED_TEST(Prestress, DoesNothingWithoutAnAnchor) {
  auto body = edem::makeBody<TypeParam>(block({2, 2, 2}), 0);
  EXPECT_FALSE(edem::prestress(body, kGravity));
  for (const auto& u : body.displacement) EXPECT_EQ(u.norm(), TypeParam(0));
}

}  // namespace
}  // namespace rubble::test
