// Several bodies in one solver: where they stand, how they meet, sleep and leave.
#include "physics/bodies.h"
#include "rubble/error.h"

namespace rubble::test {
namespace {

template <class Real>
class Bodies : public ::testing::Test {};
TYPED_TEST_SUITE(Bodies, Scalars);

// Everything that the ledger adds up, less what came from outside [J].
double closing(const edem::Books& b) {
  return b.kinetic + b.elastic - b.dissipated.done() + b.fracture + b.massDamped + b.slept + b.leftKinetic +
         b.leftElastic - b.initialEnergy - b.gravity.work.done() - b.bullet.work.done();
}

TYPED_TEST(Bodies, StandWhereTheyArePut) {
  edem::BodyDef def = block({3, 2, 1});
  def.transform =
      Eigen::Translation3d(120, -40, 7) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  def.spin = Eigen::Vector3d(0, 1, 0);
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  for (std::size_t i = 0; i < def.asset->elementCount(); ++i)
    EXPECT_LT((solver->position(id, i) - def.transform * def.asset->positions[i]).norm(), 1e-6);
  EXPECT_LT(solver->orientation(id, 0).angularDistance(Eigen::Quaterniond(def.transform.linear())), 1e-6);
  for (int t = 0; t < 60; ++t) solver->tick(kFrame, kNoGravity, {});
  // One radian about the upright axis through the centre of mass.
  const Eigen::Vector3d centre = def.transform * Eigen::Vector3d(0.3, 0.2, 0.1);
  const Eigen::AngleAxisd turn(1, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d expected = centre + turn * (def.transform * def.asset->positions[0] - centre);
  // A block of unequal axes precesses a little, and its lattice stretches: a few millimetres over 0.3 m.
  EXPECT_LT((solver->position(id, 0) - expected).norm(), 0.05);
}

TYPED_TEST(Bodies, CollisionKeepsMomentumAndEnergy) {
  edem::BodyDef left = block({2, 2, 2}), right = block({2, 2, 2});
  left.velocity = Eigen::Vector3d(3, 0, 0);
  right.transform = Eigen::Translation3d(0.55, 0.13, 0.05) * Eigen::Isometry3d::Identity();
  const auto solver = makeSolver<TypeParam>(false);
  solver->addBody(left, kNoGravity);
  const std::uint32_t id = solver->addBody(right, kNoGravity);
  for (int t = 0; t < 60; ++t) solver->tick(kFrame, kNoGravity, {});
  const edem::Books& b = solver->books();
  EXPECT_GT(solver->velocity(id, 0).norm(), 0.5) << "they have met";
  EXPECT_LT((b.linear - b.initialLinear).norm(), 1e-5 * b.initialMomentumSize);
  EXPECT_LT((b.angular - b.initialAngular).norm(), 1e-5 * b.initialMomentumSize * b.diagonal);
  // Without friction and damping; contacts that open and close within a substep leave a little.
  EXPECT_NEAR(closing(b), 0, 2e-3 * b.initialEnergy);
}

TYPED_TEST(Bodies, ShortAndLongTicksInTurnKeepTheLedger) {
  edem::BodyDef def = block({4, 2, 2});
  def.material.springDamping = 0.03;
  def.spin = Eigen::Vector3d(0, 3, 9);
  const auto solver = makeSolver<TypeParam>(false);
  solver->addBody(def, kNoGravity);
  for (int t = 0; t < 120; ++t) solver->tick(t % 3 == 0 ? kFrame / 50 : kFrame, kGravity, {});
  EXPECT_NEAR(closing(solver->books()), 0, 1e-3 * solver->books().initialEnergy);
}

TYPED_TEST(Bodies, SleepAndWakingKeepTheLedger) {
  const auto solver = makeSolver<TypeParam>();
  edem::BodyDef column = block({2, 10, 2}, true), flying = block({2, 2, 2});
  flying.transform.translation() = Eigen::Vector3d(5, 5, 5);
  flying.spin = Eigen::Vector3d(0, 0, 0.5);
  const std::uint32_t id = solver->addBody(column, kGravity);
  const double held = solver->books().elastic;
  solver->addBody(flying, kNoGravity);
  ASSERT_GT(held, 0);
  const auto run = [&] {
    for (int t = 0; t < 5; ++t) solver->tick(kFrame, kNoGravity, {});
  };
  for (int t = 0; t < 5; ++t) solver->tick(kFrame, kGravity, {});
  solver->setAsleep(id, true);
  run();
  EXPECT_NEAR(closing(solver->books()), 0, 1e-2 * held) << "asleep";
  solver->setAsleep(id, false);
  for (int t = 0; t < 5; ++t) solver->tick(kFrame, kGravity, {});
  EXPECT_NEAR(closing(solver->books()), 0, 1e-2 * held) << "awake";
}

TYPED_TEST(Bodies, RemovedBodyLeavesWithWhatItHad) {
  const auto solver = makeSolver<TypeParam>();
  edem::BodyDef def = block({2, 2, 2});
  def.velocity = Eigen::Vector3d(1, 2, 3);
  const std::uint32_t id = solver->addBody(def, kNoGravity);
  def.transform.translation() = Eigen::Vector3d(5, 5, 5);
  const std::uint32_t other = solver->addBody(def, kNoGravity);
  for (int t = 0; t < 5; ++t) solver->tick(kFrame, kNoGravity, {});
  solver->removeBody(id);
  for (int t = 0; t < 5; ++t) solver->tick(kFrame, kNoGravity, {});
  const edem::Books& b = solver->books();
  EXPECT_NEAR(closing(b), 0, 1e-5 * b.initialEnergy);
  EXPECT_NEAR(b.mass + b.leftMass, b.initialMass, 1e-9 * b.initialMass);
  EXPECT_LT((b.linear + b.leftLinear - b.initialLinear).norm(), 1e-5 * b.initialMomentumSize);
  EXPECT_THROW(solver->view(id), Error);
  EXPECT_FALSE(solver->view(other).asleep);
}

TYPED_TEST(Bodies, OneMaySleepAfterAnotherWasRemoved) {
  const auto solver = makeSolver<TypeParam>();
  const std::uint32_t large = solver->addBody(block({4, 4, 4}), kNoGravity);
  edem::BodyDef def = block({2, 1, 1});
  def.transform.translation() = Eigen::Vector3d(5, 5, 5);
  const std::uint32_t small = solver->addBody(def, kNoGravity);
  solver->tick(kFrame, kNoGravity, {});
  solver->removeBody(large);
  solver->setAsleep(small, true);
  solver->tick(kFrame, kNoGravity, {});
  EXPECT_EQ(solver->failure(), "");
  EXPECT_FALSE(solver->anyAwake());
}

}  // namespace
}  // namespace rubble::test
