// A body that nothing touches.
#include "edem/damping.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

template <class Real>
class FreeBody : public ::testing::Test {};
TYPED_TEST_SUITE(FreeBody, Scalars);

TYPED_TEST(FreeBody, SpinningIntactBlockKeepsAngularMomentumForTenSeconds) {
  edem::BodyDef def = block({3, 3, 3});
  def.material.springDamping = 0.03;
  def.velocity = Eigen::Vector3d(1, -2, 0.5);
  def.spin = Eigen::Vector3d(3, -8, 5).normalized() * 10;
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  for (int t = 0; t < 600; ++t) solver->tick(kFrame, kNoGravity, {});
  ASSERT_EQ(solver->failure(), "");
  const edem::Books& books = solver->books();
  EXPECT_LT((books.angular - books.initialAngular).norm(), 1e-5 * books.initialAngular.norm());
  EXPECT_LT((books.linear - books.initialLinear).norm(), 1e-5 * books.initialLinear.norm());
  EXPECT_EQ(solver->view(id).fragments, 1u);
  EXPECT_EQ(solver->view(id).broken, 0u);
}

TYPED_TEST(FreeBody, FliesAsItWasThrown) {
  edem::BodyDef def = block({3, 2, 2});
  def.velocity = Eigen::Vector3d(4, 6, 0);
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  const Eigen::Vector3d start = solver->position(id, 0);
  for (int t = 0; t < 60; ++t) solver->tick(kFrame, kGravity, {});
  // x = v t + g t^2 / 2; symplectic Euler adds g t h / 2, h below a millisecond.
  const double h = solver->report().substep;
  const Eigen::Vector3d expected = start + def.velocity + 0.5 * kGravity + 0.5 * h * kGravity;
  // Float adds 1e-7 of the way a tick, sixty times.
  EXPECT_LT((solver->position(id, 0) - expected).norm(), 1e-5);
}

TYPED_TEST(FreeBody, PushGivesItsImpulseAndItsWorkAndNothingElse) {
  // A blow J on one element at rest with no damping: momentum J and x cross J + L for ever, energy
  // J^2 / 2 m + L^2 / 2 I.
  edem::BodyDef def = block({3, 2, 2});
  def.material.springDamping = 0;
  const auto solver = makeSolver<TypeParam>(false);
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  solver->tick(kFrame, kNoGravity, {});
  const Eigen::Vector3d linear(0.01, -0.02, 0.03), angular(2e-5, 1e-5, -3e-5);
  const edem::Books& books = solver->books();
  const Eigen::Vector3d arm = solver->position(id, 0) - books.centre;
  const double mass = solver->view(id).mass[0];
  solver->push(id, 0, linear, angular);
  const double work = 0.5 * linear.squaredNorm() / mass + 0.5 * angular.dot(solver->spin(id, 0));
  EXPECT_NEAR(books.kinetic, work, 1e-6 * work);
  for (int t = 0; t < 10; ++t) solver->tick(kFrame, kNoGravity, {});
  EXPECT_LT((books.linear - linear).norm(), 1e-5 * linear.norm());
  const Eigen::Vector3d moment = arm.cross(linear) + angular;
  EXPECT_LT((books.angular - moment).norm(), 1e-5 * moment.norm());
  // The sum of leapfrog is constant to the order of the pushed element's own vibration in a substep.
  EXPECT_NEAR(books.kinetic + books.elastic, work, 0.01 * work);
  EXPECT_NEAR(books.bullet.work.done(), work, 1e-5 * work);
}

TYPED_TEST(FreeBody, UndampedVibrationKeepsEnergyAndMomentum) {
  // Launched round and undeformed, it rings: centrifugal force overshoots. Soft, so that a tenth of the
  // energy is elastic.
  edem::BodyDef def = block({4, 3, 2});
  def.material.youngsModulus = 3e6;
  def.spin = Eigen::Vector3d(0, 5, 12);
  const auto solver = makeSolver<TypeParam>(false);
  solver->addBody(def, kNoGravity);
  const edem::Books& books = solver->books();
  double least = 1e300, most = 0, worst = 0, early = 0, late = 0;
  constexpr int kTicks = 300;
  for (int t = 0; t < kTicks; ++t) {
    solver->tick(kFrame, kNoGravity, {});
    const double error = (books.kinetic + books.elastic) / books.initialEnergy - 1;
    worst = std::max(worst, std::abs(error));
    (t < kTicks / 2 ? early : late) += error / (kTicks / 2);
    least = std::min(least, books.elastic);
    most = std::max(most, books.elastic);
  }
  ASSERT_EQ(solver->failure(), "");
  EXPECT_GT(most, 2 * least) << "the block must ring, or this tests nothing";
  EXPECT_GT(most, 0.01 * books.initialEnergy);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(std::abs(late - early), 1e-4) << "drift";
  EXPECT_LT((books.angular - books.initialAngular).norm(), 1e-5 * books.initialAngular.norm());
}

TYPED_TEST(FreeBody, RigidFlightIsNotBrakedByMassDamping) {
  edem::BodyDef def = block({3, 3, 3});
  def.velocity = Eigen::Vector3d(3, 0, 0);
  def.spin = Eigen::Vector3d(0, 2, 0);
  def.massDamping = 2;
  const auto solver = makeSolver<TypeParam>();
  solver->addBody(def, kNoGravity);
  for (int t = 0; t < 120; ++t) solver->tick(kFrame, kNoGravity, {});
  const edem::Books& books = solver->books();
  EXPECT_LT((books.linear - books.initialLinear).norm(), 1e-5 * books.initialLinear.norm());
  EXPECT_LT((books.angular - books.initialAngular).norm(), 1e-5 * books.initialAngular.norm());
  // Only the stretch that the launch excites goes; closes with what was booked.
  EXPECT_NEAR(books.kinetic + books.elastic + books.massDamped, books.initialEnergy,
              1e-4 * books.initialEnergy);
  EXPECT_GT(books.kinetic, 0.99 * books.initialEnergy);
}

TYPED_TEST(FreeBody, TheSameRunGivesTheSameHash) {
  const auto run = [](double spin) {
    edem::BodyDef def = block({4, 2, 2});
    def.material.springDamping = 0.03;
    def.spin = Eigen::Vector3d(1, spin, 40);
    const auto solver = makeSolver<TypeParam>();
    solver->addBody(def, kNoGravity);
    for (int t = 0; t < 20; ++t) solver->tick(kFrame, kGravity, {});
    return solver->hash();
  };
  EXPECT_EQ(run(2), run(2));
  EXPECT_NE(run(2), run(2.001));
}

// A ball strikes a block, both with a velocity in common. Returns the velocity of the ball beside that, and
// the most substeps of a tick.
std::pair<Eigen::Vector3d, int> blowAt(const Eigen::Vector3d& common, const Eigen::Vector3d& gravity) {
  const auto solver = makeSolver<double>(false);
  edem::BodyDef def = block({3, 3, 3});
  def.velocity = common;
  solver->addBody(def, kNoGravity);
  std::vector<edem::RigidProxy> proxies = {
      ball(0.2, 30, {0.3, 0.3, -0.25}, common + Eigen::Vector3d(0, 0, 5))};
  proxies[0].acceleration = gravity;
  int substeps = 0;
  for (int t = 0; t < 6; ++t) {
    solver->tick(kFrame, gravity, proxies);
    EXPECT_EQ(solver->report().warning, "");
    substeps = std::max(substeps, solver->report().substeps);
  }
  return {proxies[0].velocity - common - 6 * kFrame * gravity, substeps};
}

// Galilei: what falls together meets as at rest, and costs no more.
TEST(Drift, ABlowBetweenWhatFallsIsThatAtRest) {
  const auto [rest, substeps] = blowAt({0, 0, 0}, kNoGravity);
  EXPECT_LT(rest.z(), 2) << "it was braked, from 5 m/s";
  const Eigen::Vector3d fast(20, -400, 30);
  // The steps differ in length: they follow speeds beside that of the common centre of mass.
  for (const Eigen::Vector3d& gravity : {kNoGravity, kGravity}) {
    const auto [falling, fallingSubsteps] = blowAt(fast, gravity);
    EXPECT_LT((falling - rest).norm(), 2e-3 * 5);
    EXPECT_NEAR(fallingSubsteps, substeps, 1);
  }
}

// However fast they come: what stands is met, by elements and by a ball that they fall with. Two cubes of 19
// kg on k_n = 3e6 N/m are stopped from 40 m/s in 0.143 m, their centres 0.1 m above their faces.
TEST(Drift, WhatFallsFastMeetsWhatStands) {
  for (const bool onPlane : {false, true}) {
    const auto solver = makeSolver<double>(false);
    edem::BodyDef def = block({2, 2, 2});
    def.transform = Eigen::Translation3d(0, 6, 0);
    def.velocity = {0, -40, 0};
    solver->addBody(def, kNoGravity);
    std::vector<edem::RigidProxy> proxies = {onPlane ? fixedPlane() : fixedBox({2, 1, 2}, {0, -1, 0}),
                                             ball(0.2, 30, {0.2, 6.62, 0.2}, {0, -40, 0})};
    proxies[0].restitution = 1;
    for (int t = 0; t < 30; ++t) {
      solver->tick(kFrame, kNoGravity, proxies);
      ASSERT_EQ(solver->failure(), "");
      for (std::uint32_t i = 0; i < 8; ++i)
        ASSERT_GT(solver->position(0, i).y(), -0.15) << onPlane << ", " << t;
      ASSERT_GT(proxies[1].position.y(), 0) << onPlane << ", " << t;
    }
    EXPECT_GT(solver->books().bullet.linear.y(), 1e3);
  }
}

}  // namespace
}  // namespace rubble::test
