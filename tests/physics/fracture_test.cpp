// What a break may not do: kick, or lose momentum or energy.
#include <algorithm>

#include "physics/bodies.h"

namespace rubble::test {
namespace {

template <class Real>
class Fracture : public ::testing::Test {};
TYPED_TEST_SUITE(Fracture, Scalars);

// Two elements whose spring breaks at the given strain, in tension or compression.
edem::BodyDef pairBreakingAt(double strain) {
  edem::BodyDef def = block({2, 1, 1});
  def.material.tensileStrength = strain * def.material.youngsModulus;
  def.material.compressiveStrength = strain * def.material.youngsModulus;
  return def;
}

TYPED_TEST(Fracture, BreakAtRestInCompressionGivesNoKick) {
  using Real = TypeParam;
  OneBody<Real> one(pairBreakingAt(0.149));
  one.body().state.displacement[0].x() = Real(0.15 * 0.2);  // 15 % shorter
  for (int n = 0; n < 200; ++n) one.substep(2e-4, true);
  ASSERT_EQ(one.report().broken.size(), 1u);
  EXPECT_EQ(one.report().broken[0].mode, BreakMode::Compression);
  // The spring held k/2 dx^2 = 2700 J; a thousandth of a millionth of that is rounding.
  EXPECT_LT(one.books().kinetic, 2700e-9);
  EXPECT_NEAR(one.books().fracture, 0.5 * 6e6 * 0.03 * 0.03, 1e-5 * 2700);
}

TYPED_TEST(Fracture, BreakWhileClosingGivesNoKick) {
  using Real = TypeParam;
  OneBody<Real> one(pairBreakingAt(0.15));
  one.body().state.velocity[0].x() = Real(14);
  one.body().state.velocity[1].x() = Real(-14);
  const double mass = one.body().constants->mass[0];
  const auto kinetic = [&] {
    return 0.5 * mass *
           double(one.body().state.velocity[0].squaredNorm() + one.body().state.velocity[1].squaredNorm());
  };
  while (one.report().broken.empty()) one.substep(5e-5, true);
  const double atBreak = kinetic();
  EXPECT_LT(atBreak, 0.5 * 2 * mass * 14 * 14) << "the spring has taken its share";
  EXPECT_GT(atBreak, 100) << "still closing, so that the contact is pressed";
  double most = 0, least = 1e300;
  for (int n = 0; n < 2000; ++n) {
    one.substep(5e-5, true);
    most = std::max(most, kinetic());
    least = std::min(least, kinetic());
  }
  EXPECT_LT(least, 0.1 * atBreak) << "the contact has stopped them";
  EXPECT_GT(one.body().state.velocity[1].x(), Real(0)) << "and thrown them back";
  // Leapfrog's full-step velocities differ from its conserved energy by (omega h)^2 / 8.
  EXPECT_LT(most, atBreak * 1.001);
  EXPECT_LT(kinetic(), atBreak * 1.001);
}

TYPED_TEST(Fracture, SpinningBarTornInTwoKeepsMomentumAndEnergy) {
  edem::BodyDef def = block({6, 2, 2});
  def.velocity = Eigen::Vector3d(0.5, 1, 0);
  def.spin = Eigen::Vector3d(0, 0, 20);
  // The middle of a bar of 1.2 m carries rho w^2 L^2 / 8 = 173 kPa, twice that as the launch overshoots. At
  // 230 kPa the halves' rebound breaks them again and again.
  def.material.tensileStrength = 290e3;
  def.material.compressiveStrength = 2.9e6;
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  for (int t = 0; t < 60; ++t) solver->tick(kFrame, kNoGravity, {});
  ASSERT_EQ(solver->failure(), "");
  ASSERT_GE(solver->view(id).fragments, 2u);
  const edem::Books& books = solver->books();
  EXPECT_GT(books.fracture, 0);
  EXPECT_LT((books.linear - books.initialLinear).norm(), 1e-5 * books.initialMomentumSize);
  EXPECT_LT((books.angular - books.initialAngular).norm(), 1e-5 * books.initialAngular.norm());
  EXPECT_NEAR(books.kinetic + books.elastic + books.fracture, books.initialEnergy,
              1e-4 * books.initialEnergy);
}

TYPED_TEST(Fracture, ReportNamesEveryBrokenSpring) {
  edem::BodyDef def = block({6, 2, 2});
  def.spin = Eigen::Vector3d(0, 0, 25);
  def.material.tensileStrength = 230e3;
  def.material.compressiveStrength = 2.3e6;
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  std::size_t reported = 0;
  double energy = 0;
  for (int t = 0; t < 30; ++t) {
    solver->tick(kFrame, kNoGravity, {});
    reported += solver->report().broken.size();
    for (const edem::BrokenSpring& b : solver->report().broken) {
      energy += b.energy;
      EXPECT_EQ(solver->view(id).intact[b.spring], 0);
    }
  }
  const edem::BodyView view = solver->view(id);
  EXPECT_GT(reported, 0u);
  EXPECT_EQ(reported, view.broken);
  EXPECT_EQ(reported, std::size_t(std::count(view.intact.begin(), view.intact.end(), 0)));
  // Books add half a step of the springs' power, by which leapfrog's kinetic energy is behind: below omega h
  // / 2 of it.
  EXPECT_NEAR(energy, solver->books().fracture, 0.3 * energy);
}

}  // namespace
}  // namespace rubble::test
