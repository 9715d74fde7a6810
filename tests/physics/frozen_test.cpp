// Elements that no allowed substep is stable for: they stand still until the tick ends, and are booked.
#include "physics/bodies.h"

namespace rubble::test {
namespace {

// A body that has just the substeps that its springs need by themselves, whatever touches it.
template <class Real>
class Frozen : public ::testing::Test {
 protected:
  void add(edem::BodyDef def) {
    def.material.contactStiffness = 100;  // of which a hundredth is as stiff as the springs
    const auto alone = makeSolver<Real>(false);
    alone->addBody(def, kNoGravity);
    edem::SolverDef tight;
    tight.breaking = tight.crushing = false;
    tight.maxSubstepsPerFrame = int(std::ceil(kFrame / (tight.substepSafety * alone->stableStep()) * 1.01));
    solver = edem::Solver::make(std::is_same_v<Real, float> ? Precision::Float : Precision::Double, tight);
    id = solver->addBody(def, kNoGravity);
  }
  // Energies and momenta are what was put in, less what is booked as taken: the sums of law 12, made here.
  void expectClosedBooks() {
    const edem::Books& b = solver->books();
    const double put = b.initialEnergy + b.gravity.work.done() + b.bullet.work.done() + b.anchors.work.done();
    const double held = b.kinetic + b.elastic - b.dissipated.done() + b.massDamped + b.fracture + b.slept;
    // The first tick softens contacts in the middle of a blow, by a hundred times; from then on it is frozen
    // and let go alone.
    if (ticks++ == 0) {
      softened = held - put;
      EXPECT_LT(std::abs(softened), 1e-2 * most);
    }
    EXPECT_NEAR(held - put, softened, 1e-4 * most);
    const Eigen::Vector3d linear = b.initialLinear + b.bullet.linear + b.gravity.linear + b.anchors.linear;
    EXPECT_LT((b.linear + b.sleptLinear - linear).norm(), 1e-5 * momentum);
    const Eigen::Vector3d angular =
        b.initialAngular + b.bullet.angular + b.gravity.angular + b.anchors.angular;
    EXPECT_LT((b.angular + b.sleptAngular - angular).norm(), 1e-5 * momentum);
  }

  std::unique_ptr<edem::Solver> solver;
  std::uint32_t id = 0;
  double most = 0, momentum = 0;  // in the world [J], [kg m/s]
  double softened = 0;            // error of the first tick [J]
  int ticks = 0;
};
TYPED_TEST_SUITE(Frozen, Scalars);

// A hundredth of so many contacts is still more than the one that a body is loaded for. They begin one after
// the other, for a substep is chosen for one that may begin at an element.
std::vector<edem::RigidProxy> ballsAbove(const std::vector<Eigen::Vector3d>& places) {
  std::vector<edem::RigidProxy> proxies;
  edem::Collider sphere;
  sphere.size.setConstant(0.1);
  for (const Eigen::Vector3d& at : places)
    for (int i = 0; i < 400; ++i) proxies.push_back(fixed(sphere, at + Eigen::Vector3d(0, 5e-5 * i, 0)));
  return proxies;
}

TYPED_TEST(Frozen, WhatIsPressedTooHardStandsStillAndIsBooked) {
  constexpr double kSpeed = 2;
  edem::BodyDef def = block({5, 1, 5});
  def.velocity = {0, kSpeed, 0};
  this->add(def);
  const double weight = 25 * 0.008 * def.material.density;
  this->most = 0.5 * weight * kSpeed * kSpeed;
  this->momentum = weight * kSpeed;
  // At the middle element of the upper face, 1 mm away.
  std::vector<edem::RigidProxy> proxies = ballsAbove({{0.5, 0.301, 0.5}});
  std::uint32_t frozen = 0;
  for (int t = 0; t < 20; ++t) {
    this->solver->tick(kFrame / 4, kNoGravity, proxies);
    ASSERT_EQ(this->solver->failure(), "");
    const edem::TickReport& report = this->solver->report();
    EXPECT_LE(report.frozen, 25u / 4);
    frozen += report.frozen;
    EXPECT_EQ(report.frozen > 0, this->solver->velocity(this->id, 12).isZero(0)) << t;
    EXPECT_EQ(report.frozen > 0, report.warning.find("stand still") != std::string::npos) << report.warning;
    for (std::size_t i = 0; i < 25; ++i) ASSERT_LT(this->solver->velocity(this->id, i).norm(), 5 * kSpeed);
    EXPECT_LE(this->solver->books().kinetic + this->solver->books().elastic, 1.005 * this->most);
    this->expectClosedBooks();
  }
  EXPECT_GT(frozen, 0u);
  EXPECT_GT(this->solver->books().slept, 0);
}

TYPED_TEST(Frozen, TheRunStopsWhereAQuarterWouldNotDo) {
  edem::BodyDef def = block({2, 1, 2});
  def.velocity = {0, 2, 0};
  this->add(def);
  std::vector<edem::RigidProxy> proxies = ballsAbove({{0.1, 0.301, 0.1}, {0.3, 0.301, 0.3}});
  for (int t = 0; t < 4 && this->solver->failure().empty(); ++t)
    this->solver->tick(kFrame, kNoGravity, proxies);
  EXPECT_NE(this->solver->failure().find("body 0: its contacts need a substep of"), std::string::npos)
      << this->solver->failure();
  EXPECT_EQ(this->solver->report().frozen, 0u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(this->solver->position(this->id, i).allFinite());
}

}  // namespace
}  // namespace rubble::test
