// A fragment becomes a body of its own: nothing of its motion, its springs or its contacts may change by it.
#include <type_traits>

#include "edem/criterion.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

constexpr double kCubeEdge = 0.1;  // [m]

// Two bars of 2 x 1 x 1 and 3 x 1 x 1 cubes, a cube apart: two fragments from the start.
edem::BodyDef twoBars(double height) {
  GridAssetDef grid;
  grid.cubes = {6, 1, 1};
  grid.edge = kCubeEdge;
  grid.anchored = false;
  Asset asset = gridAsset(grid);
  std::erase_if(asset.springs, [](const AssetSpring& s) { return s.second == 2 || s.first == 2; });
  edem::BodyDef def;
  def.asset = std::make_shared<const Asset>(std::move(asset));
  def.anchored = false;
  def.transform.translation().y() = height;
  def.material.friction = 0.6;
  return def;
}

// The lowest elements of the bars; element 2 alone is the third fragment.
constexpr std::uint32_t kShort = 0, kAlone = 2, kLong = 3;
constexpr std::size_t kElements = 6;

template <class Real>
struct Bars {
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>(false);
  std::vector<edem::RigidProxy> proxies;
  std::vector<std::uint32_t> bodyOf = std::vector<std::uint32_t>(kElements, 0);

  Bars(double height, const Eigen::Vector3d& spin, bool ground, bool upright = false) {
    edem::BodyDef def = twoBars(height);
    if (upright) def.transform.rotate(Eigen::AngleAxisd(edem::kPi / 2, Eigen::Vector3d::UnitZ()));
    def.spin = spin;
    solver->addBody(def, kNoGravity);
    if (!ground) return;
    proxies = {fixedPlane()};
    proxies[0].key = 7;
  }
  void tick(int count) {
    for (int t = 0; t < count; ++t) solver->tick(kFrame, kGravity, proxies);
  }
  bool split(std::uint32_t root) {
    const auto id = solver->split(0, root);
    if (!id) return false;
    for (std::size_t i = 0; i < kElements; ++i)
      if (solver->view(*id).alive[i]) bodyOf[i] = *id;
    return true;
  }
  Eigen::Vector3d position(std::size_t i) const { return solver->position(bodyOf[i], i); }
  Eigen::Vector3d velocity(std::size_t i) const { return solver->velocity(bodyOf[i], i); }
};

template <class Real>
class Split : public ::testing::Test {
 protected:
  // Both go on alike, within this [m], [m/s].
  static void expectSame(const Bars<Real>& one, const Bars<Real>& split, double within) {
    for (std::size_t i = 0; i < kElements; ++i) {
      EXPECT_LE((one.position(i) - split.position(i)).norm(), within) << i;
      EXPECT_LE((one.velocity(i) - split.velocity(i)).norm(), within) << i;
    }
  }
  static double error(const edem::Books& b) {
    const double now = b.kinetic + b.elastic - b.dissipated.done() + b.fracture + b.massDamped + b.slept;
    return std::abs(now - b.initialEnergy - b.gravity.work.done() - b.bullet.work.done());
  }
};
TYPED_TEST_SUITE(Split, Scalars);

// They fly apart as they turn, and swing.
TYPED_TEST(Split, InFlightNothingChanges) {
  Bars<TypeParam> one(10, {0, 0, 8}, false), two = Bars<TypeParam>(10, {0, 0, 8}, false);
  one.tick(20);
  two.tick(20);
  const edem::Books before = two.solver->books();
  ASSERT_TRUE(two.split(kLong));
  const edem::Books& after = two.solver->books();
  EXPECT_EQ(after.kinetic, before.kinetic);
  EXPECT_EQ(after.elastic, before.elastic);
  EXPECT_EQ((after.linear - before.linear).norm(), 0);
  EXPECT_EQ((after.angular - before.angular).norm(), 0);
  one.tick(20);
  two.tick(20);
  this->expectSame(one, two, 1e-12);
  EXPECT_LT(this->error(two.solver->books()), 1e-5 * two.solver->books().kinetic);
  EXPECT_NEAR(two.solver->books().mass, before.mass, 1e-12 * before.mass);
}

TYPED_TEST(Split, CountsAreShared) {
  Bars<TypeParam> bars(10, {0, 0, 8}, false);
  bars.tick(20);
  ASSERT_TRUE(bars.split(kLong));
  const edem::BodyView old = bars.solver->view(0), part = bars.solver->view(1);
  EXPECT_EQ(old.elements(), 3u);
  EXPECT_EQ(part.elements(), 3u);
  EXPECT_EQ(old.springs(), 1u);
  EXPECT_EQ(part.springs(), 2u);
  EXPECT_EQ(old.fragments, 2u);
  EXPECT_EQ(part.fragments, 1u);
  EXPECT_EQ(part.broken, 0u);
  EXPECT_EQ(part.fragment[kLong], kLong);
  EXPECT_EQ(part.fragment[kShort], kNoElement);
}

// It lies on the ground as before, by what its contacts remember, and slides no further.
TYPED_TEST(Split, OnTheGroundNothingChanges) {
  for (const double height : {0.0, 0.05}) {
    Bars<TypeParam> one(height, {0, 0, 0}, true), two(height, {0, 0, 0}, true);
    for (auto* bars : {&one, &two}) {
      bars->solver->pushAll(0, kLong, {1, 0, 0}, {0, 0, 0});  // off the cube beside it
      bars->tick(20);
    }
    ASSERT_TRUE(two.split(kLong));
    one.tick(40);
    two.tick(40);
    // What rests on it is found anew in a few substeps. A contact anew would drop it by its sag, 1e-6 m.
    this->expectSame(one, two, 1e-8);
  }
}

// The cube alone is hit by both bars, which slide along it; then it, then the long one has its own body.
TYPED_TEST(Split, InTouchNothingChanges) {
  Bars<TypeParam> one(10, {0, 0, 0}, false), two(10, {0, 0, 0}, false);
  for (auto* bars : {&one, &two}) {
    bars->solver->pushAll(0, kLong, {-0.2, 0.1, 0}, {0, 0, 0});
    bars->solver->pushAll(0, kShort, {0.2, 0, 0.05}, {0, 0, 0});
    for (int t = 0; t < 4; ++t) bars->solver->tick(1e-4, kNoGravity, {});
  }
  const edem::Books before = two.solver->books();
  ASSERT_GT(before.elastic, 0);
  ASSERT_TRUE(two.split(kAlone)) << "first of its pair with the long one, second of that with the short one";
  ASSERT_TRUE(two.split(kLong)) << "touches another body";
  EXPECT_NEAR(two.solver->books().elastic, before.elastic, 1e-12 * before.elastic);
  for (auto* bars : {&one, &two})
    for (int t = 0; t < 20; ++t) bars->solver->tick(1e-4, kNoGravity, {});
  EXPECT_GT(one.velocity(kAlone).norm(), 0.02) << "it has been hit";
  // Sums in another order: by the rounding of a velocity.
  this->expectSame(one, two, std::is_same_v<TypeParam, float> ? 1e-6 : 1e-13);
}

// All stand on each other.
TYPED_TEST(Split, InAStackNothingChanges) {
  Bars<TypeParam> one(0, {0, 0, 0}, true, true), two(0, {0, 0, 0}, true, true);
  for (auto* bars : {&one, &two}) bars->tick(60);
  const double above = one.position(kLong).y();
  ASSERT_TRUE(two.split(kLong));
  ASSERT_TRUE(two.split(kAlone));
  for (int t = 0; t < 40; ++t) {
    one.tick(1);
    two.tick(1);
    this->expectSame(one, two, 1e-8);  // as on the ground
  }
  EXPECT_NEAR(one.position(kLong).y(), above, 1e-6);
}

TYPED_TEST(Split, WhatIsAllOrNoFragmentStays) {
  Bars<TypeParam> bars(10, {0, 0, 0}, false);
  bars.tick(1);
  EXPECT_FALSE(bars.split(kLong + 1)) << "not the lowest of a fragment";
  EXPECT_FALSE(bars.split(kNoElement));
  auto solver = makeSolver<TypeParam>();
  solver->addBody(block({2, 1, 1}), kNoGravity);
  EXPECT_FALSE(solver->split(0, 0));
}

// Two that split off, one after the other, and are removed in any order.
TYPED_TEST(Split, AgainAndAgain) {
  Bars<TypeParam> bars(10, {0, 0, 8}, true);
  bars.tick(20);
  ASSERT_TRUE(bars.split(kLong));
  ASSERT_TRUE(bars.split(kAlone));
  EXPECT_FALSE(bars.split(kShort)) << "is all that is left";
  bars.tick(5);
  bars.solver->removeBody(0);
  bars.tick(200);
  bars.solver->removeBody(2);
  bars.tick(5);
  EXPECT_EQ(bars.solver->failure(), "");
  EXPECT_NEAR(bars.solver->books().mass, 3 * bars.solver->view(1).mass[kLong], 1e-9);
}

}  // namespace
}  // namespace rubble::test
