// Fragments that lie still sleep one by one.
#include "physics/bodies.h"

namespace rubble::test {
namespace {

constexpr double kEdge = 0.1;  // of an element [m]

// Loose cubes of one element each, `at` the places of the grid that are kept, on the plane y = 0.
edem::BodyDef looseCubes(int along, int up = 1) {
  GridAssetDef grid;
  grid.cubes = {along, up, 1};
  grid.edge = kEdge;
  grid.anchored = false;
  Asset asset = gridAsset(grid);
  asset.springs.clear();
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(std::move(asset));
  def.anchored = false;
  def.material.friction = 0.6;
  return def;
}

edem::RigidProxy ground() {
  edem::RigidProxy proxy;
  edem::Collider plane;
  plane.kind = edem::Collider::Kind::Plane;
  plane.size = Eigen::Vector3d::UnitY();
  proxy.parts = {plane};
  proxy.key = 7;
  return proxy;
}

template <class Real>
class Sleep : public ::testing::Test {
 protected:
  Sleep() { make(0, 0.2); }
  void make(double settleSpeed, double sleepTime) {
    edem::SolverDef def;
    def.breaking = def.crushing = false;
    def.sleepSpeed = 0.01;
    def.sleepTime = sleepTime;
    def.settleSpeed = settleSpeed;
    solver = edem::Solver::make(std::is_same_v<Real, float> ? Precision::Float : Precision::Double, def);
  }
  void tick(int count) {
    for (int t = 0; t < count; ++t) solver->tick(kFrame, kGravity, proxies);
  }
  bool sleeps(std::size_t element) const { return solver->view(0).sleeping[element] != 0; }
  void push(std::size_t element, const Eigen::Vector3d& velocity) {
    put += 0.5 * solver->view(0).mass[element] * velocity.squaredNorm();
    solver->push(0, element, solver->view(0).mass[element] * velocity, Eigen::Vector3d::Zero());
  }
  // Of all that was put in [1].
  double energyError() const {
    const edem::Books& b = solver->books();
    const double now = b.kinetic + b.elastic - b.dissipated.done() + b.fracture + b.massDamped + b.slept;
    const double had = b.initialEnergy + b.gravity.work.done() + b.bullet.work.done();
    return std::abs(now - had) / put;
  }

  std::unique_ptr<edem::Solver> solver;
  std::vector<edem::RigidProxy> proxies = {ground()};
  double put = 0;  // energy [J]
};
TYPED_TEST_SUITE(Sleep, Scalars);

TYPED_TEST(Sleep, WhatLiesStillSleepsBesideWhatMoves) {
  this->solver->addBody(looseCubes(4), kNoGravity);
  this->tick(60);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(this->sleeps(i)) << i;
  const Eigen::Vector3d at = this->solver->position(0, 0);
  this->push(3, {2, 0, 0});
  EXPECT_FALSE(this->sleeps(3));
  this->tick(5);
  // Cubes touch at rest, so the island of all four woke; those that nobody pushed sleep again.
  EXPECT_GT(this->solver->velocity(0, 3).x(), 0.1);
  this->tick(60);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(this->sleeps(i)) << i;
  EXPECT_LT((this->solver->position(0, 0) - at).norm(), 1e-3 * kEdge);
  EXPECT_LT(this->energyError(), 1e-3);
}

// A tick in which all sleeps is one step. Gravity acts for the time that it flies, and not for half of that
// step, 0.08 m/s, before: to half a substep, and what its feet had stored.
TYPED_TEST(Sleep, WhatIsThrownWhenAllSleptFliesAsFast) {
  this->solver->addBody(looseCubes(1), kNoGravity);
  this->tick(60);
  ASSERT_TRUE(this->sleeps(0));
  ASSERT_EQ(this->solver->report().substeps, 1);
  this->push(0, {0, 3, 0});
  this->tick(1);
  EXPECT_NEAR(this->solver->velocity(0, 0).y(), 3 + kGravity.y() * kFrame, 0.02);
}

TYPED_TEST(Sleep, ItWakesByWhatRunsIntoIt) {
  this->solver->addBody(looseCubes(6), kNoGravity);
  // Apart from one another by a cube, but for the last two.
  this->tick(1);
  this->push(0, {-3, 0, 0});
  this->tick(90);
  ASSERT_TRUE(this->sleeps(0) && this->sleeps(1));
  const double before = this->solver->position(0, 1).x();
  const double gap = before - this->solver->position(0, 0).x();
  ASSERT_GT(gap, 2 * kEdge);
  this->push(0, {4, 0, 0});
  EXPECT_TRUE(this->sleeps(1)) << "nothing touches it yet";
  this->tick(40);
  EXPECT_GT(this->solver->position(0, 1).x(), before + 0.1 * kEdge);
  EXPECT_LT(this->energyError(), 1e-3);
  // Both momenta, friction on the ground included.
  const edem::Books& b = this->solver->books();
  const Eigen::Vector3d linear =
      b.linear + b.sleptLinear - b.initialLinear - b.gravity.linear - b.bullet.linear - b.anchors.linear;
  EXPECT_LT(linear.norm(), 1e-4 * (b.gravity.size + b.bullet.size));
}

TYPED_TEST(Sleep, WhatLaysOnItFallsAndSoDoesItWhenItsGroundLeaves) {
  this->solver->addBody(looseCubes(1, 2), kNoGravity);
  this->tick(60);
  ASSERT_TRUE(this->sleeps(0) && this->sleeps(1));
  const double lower = this->solver->position(0, 0).y(), upper = this->solver->position(0, 1).y();
  this->proxies.clear();
  this->tick(30);  // 0.5 s of fall: 1.2 m
  EXPECT_LT(this->solver->position(0, 0).y(), lower - 1);
  EXPECT_LT(this->solver->position(0, 1).y(), upper - 1);
}

TYPED_TEST(Sleep, GroundThatMovesWakesIt) {
  this->solver->addBody(looseCubes(2), kNoGravity);
  this->tick(60);
  ASSERT_TRUE(this->sleeps(0));
  const double before = this->solver->position(0, 0).y();
  this->proxies[0].kinematic = true;
  this->proxies[0].velocity = {0, 0.5, 0};
  this->tick(12);
  EXPECT_FALSE(this->sleeps(0));
  EXPECT_NEAR(this->solver->position(0, 0).y(), before + 0.5 * 12 * kFrame, 0.02 * kEdge);
}

TYPED_TEST(Sleep, ABallThatComesWakesItBeforeItTouches) {
  this->solver->addBody(looseCubes(2), kNoGravity);
  this->tick(60);
  ASSERT_TRUE(this->sleeps(1));
  const Eigen::Vector3d at = this->solver->position(0, 1);
  this->proxies.push_back(ball(0.05, 2, at + Eigen::Vector3d(0.6, 0, 0), {-6, 0, 0}));
  this->proxies.back().key = 8;
  this->tick(3);
  EXPECT_TRUE(this->sleeps(1));
  this->tick(6);
  EXPECT_LT(this->solver->position(0, 1).x(), at.x() - 0.1 * kEdge);
}

TYPED_TEST(Sleep, WhatLiesOnABodyThatSleepsAsAWholeSleepsToo) {
  this->solver->addBody(looseCubes(1), kNoGravity);
  edem::BodyDef upper = looseCubes(1);
  upper.transform = Eigen::Translation3d(0, 1.001 * kEdge, 0) * Eigen::Isometry3d::Identity();
  const std::uint32_t id = this->solver->addBody(upper, kNoGravity);
  this->tick(10);
  this->solver->setAsleep(0, true);
  this->tick(60);
  for (int t = 0; t < 30; ++t) {
    EXPECT_EQ(this->solver->view(id).sleepingCount, 1u) << t;
    this->tick(1);
  }
  // And wakes with it.
  this->solver->setAsleep(0, false);
  this->tick(1);
  EXPECT_EQ(this->solver->view(id).sleepingCount, 0u);
}

// The lists of pairs name bodies by place, and places shift before the next listing.
TYPED_TEST(Sleep, BodiesMayBeRemovedOneAfterAnotherUnderWhatSleeps) {
  edem::BodyDef aside = looseCubes(1);
  aside.transform = Eigen::Translation3d(5, 0, 0) * Eigen::Isometry3d::Identity();
  const std::uint32_t far = this->solver->addBody(aside, kNoGravity);
  const std::uint32_t lower = this->solver->addBody(looseCubes(1), kNoGravity);
  edem::BodyDef above = looseCubes(1);
  above.transform = Eigen::Translation3d(0, 1.001 * kEdge, 0) * Eigen::Isometry3d::Identity();
  const std::uint32_t upper = this->solver->addBody(above, kNoGravity);
  this->tick(60);
  ASSERT_EQ(this->solver->view(upper).sleepingCount, 1u);
  const double before = this->solver->position(upper, 0).y();
  this->solver->removeBody(far);
  this->solver->removeBody(lower);
  EXPECT_EQ(this->solver->view(upper).sleepingCount, 0u);
  this->tick(6);
  EXPECT_LT(this->solver->position(upper, 0).y(), before - 0.2 * kEdge);
}

TYPED_TEST(Sleep, OtherGravityWakesAll) {
  this->solver->addBody(looseCubes(2), kNoGravity);
  this->tick(60);
  ASSERT_TRUE(this->sleeps(0));
  this->solver->tick(kFrame, Eigen::Vector3d(0, 9.81, 0), this->proxies);
  EXPECT_FALSE(this->sleeps(0));
  EXPECT_GT(this->solver->velocity(0, 0).y(), 0.1);
}

TYPED_TEST(Sleep, WhatBeginsToSlideSlowlyIsNotHeld) {
  this->make(0.25, 2);
  this->solver->addBody(looseCubes(1), kNoGravity);
  const double friction = 0.6 * this->proxies[0].friction;  // mu of the pair
  const double slope = std::atan(friction + 0.05);
  const Eigen::Vector3d gravity = 9.81 * Eigen::Vector3d(std::sin(slope), -std::cos(slope), 0);
  constexpr double kTime = 2.5;  // [s]
  for (int t = 0; t < int(kTime / kFrame); ++t) this->solver->tick(kFrame, gravity, this->proxies);
  // Coulomb: g (sin - mu cos).
  EXPECT_NEAR(this->solver->velocity(0, 0).x(), 9.81 * 0.05 * std::cos(slope) * kTime, 0.05);
}

TYPED_TEST(Sleep, WhatRocksComesToRest) {
  this->make(0.25, 2);
  // Undamped: it would rock for ever.
  edem::BodyDef def = block({1, 4, 1}, false, kEdge);
  def.material.springDamping = def.material.contactDamping = 0;
  this->solver->addBody(def, kNoGravity);
  this->tick(30);
  this->push(3, {0.03, 0, 0});
  int ticks = 0;
  for (; ticks < 600 && this->solver->view(0).sleepingCount == 0; ++ticks) this->tick(1);
  EXPECT_EQ(this->solver->view(0).sleepingCount, 4u);
  EXPECT_GT(ticks, int(2 / kFrame));
}

TYPED_TEST(Sleep, APieceThatRocksOnItsFootSleepsSoon) {
  this->make(0.25, 0.5);
  edem::BodyDef def = block({2, 8, 1}, false, kEdge);
  def.material.friction = 0.9;
  def.material.restitution = 0;
  def.transform = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()) * Eigen::Isometry3d::Identity();
  this->solver->addBody(def, kNoGravity);
  int ticks = 0;
  for (; ticks < 600 && this->solver->view(0).sleepingCount == 0; ++ticks) this->tick(1);
  EXPECT_EQ(this->solver->view(0).sleepingCount, 16u);
  EXPECT_LT(ticks, int(3 / kFrame));
}

TYPED_TEST(Sleep, WhatTopplesSlowlyFallsAsIfNothingSlept) {
  // Its centre beyond its edge by a tenth of the half breadth: slower than 0.25 m/s for half a second.
  edem::BodyDef def = block({1, 8, 1}, false, kEdge);
  def.material.youngsModulus = 1e9;
  const double lean = 1.1 * std::atan(1.0 / 8);
  const Eigen::Vector3d foot(kEdge, 0, 0);
  def.transform = Eigen::Translation3d(foot) * Eigen::AngleAxisd(-lean, Eigen::Vector3d::UnitZ()) *
                  Eigen::Translation3d(-foot);
  def.material.friction = 0.9;
  def.material.restitution = 0;
  const auto top = [&](double settleSpeed, double seconds) {
    this->make(settleSpeed, 0.5);
    this->solver->addBody(def, kNoGravity);
    this->proxies = {ground()};
    this->tick(int(seconds / kFrame));
    return this->solver->position(0, 7).y();
  };
  const double began = top(0, 0.02), fallen = top(0, 1.3);
  ASSERT_LT(fallen, 0.7 * began);
  EXPECT_NEAR(top(0.25, 1.3), fallen, 0.01 * began);
}

TYPED_TEST(Sleep, ARunIsTheSameUpToWhereTheFirstFallsAsleep) {
  // What sleeps took no force before, so that sleep changes nothing until then.
  edem::SolverDef def;
  def.breaking = def.crushing = false;
  const auto other =
      edem::Solver::make(std::is_same_v<TypeParam, float> ? Precision::Float : Precision::Double, def);
  std::vector<edem::RigidProxy> copies = {ground()};
  other->addBody(looseCubes(3), kNoGravity);
  this->solver->addBody(looseCubes(3), kNoGravity);
  for (int t = 0; t < 100 && !this->sleeps(0); ++t) {
    EXPECT_EQ(other->hash(), this->solver->hash()) << t;
    other->tick(kFrame, kGravity, copies);
    this->tick(1);
  }
  EXPECT_TRUE(this->sleeps(0));
}

}  // namespace
}  // namespace rubble::test
