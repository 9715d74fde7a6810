// A body that is lent to the host: the others go on as if it were not there, and it comes back to its place.
#include "physics/bodies.h"
#include "rubble/error.h"

namespace rubble::test {
namespace {

constexpr double kUp = 0.4;  // height of a block [m]

// Two blocks on each other and on the ground, and between them in the solver's list a third far away, lent.
template <class Real>
struct Tower {
  std::unique_ptr<edem::Solver> solver = makeSolver<Real>();
  std::vector<edem::RigidProxy> ground = {fixedPlane()};
  std::uint32_t low = 0, lent = 0, high = 0;

  explicit Tower(bool lends) {
    ground[0].key = 7;
    low = add(0, 0);
    if (lends) lent = add(50, 3);
    high = add(0, kUp);
    EXPECT_TRUE(!lends || solver->park(lent));
  }
  std::uint32_t add(double x, double y) {
    edem::BodyDef def = block({2, 2, 2});
    def.transform.translation() = Eigen::Vector3d(x, y, 0);
    def.material.friction = 0.6;
    return solver->addBody(def, kNoGravity);
  }
  void tick(int count) {
    for (int t = 0; t < count; ++t) solver->tick(kFrame, kGravity, ground);
  }
  double massOf(std::initializer_list<std::uint32_t> ids) const {
    double sum = 0;
    for (const std::uint32_t id : ids)
      for (const double mass : solver->view(id).mass) sum += mass;
    return sum;
  }
};

template <class Real>
class Parking : public ::testing::Test {
 protected:
  static void expectSame(const Tower<Real>& a, const Tower<Real>& b) {
    for (const auto& [one, other] : {std::pair(a.low, b.low), std::pair(a.high, b.high)})
      for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(a.solver->position(one, i), b.solver->position(other, i)) << i;
        EXPECT_EQ(a.solver->velocity(one, i), b.solver->velocity(other, i)) << i;
      }
  }
};
TYPED_TEST_SUITE(Parking, Scalars);

TYPED_TEST(Parking, LeavesTheOthersAsTheyAre) {
  Tower<TypeParam> alone(false), beside(true);
  for (int t = 0; t < 20; ++t) {
    alone.tick(1);
    beside.tick(1);
    this->expectSame(alone, beside);
  }
  EXPECT_NEAR(beside.solver->books().mass, beside.massOf({beside.low, beside.lent, beside.high}), 1e-9);
}

// The places of those behind it in the list are others then; what touches them is known by their ids.
TYPED_TEST(Parking, WhatOthersTouchIsStillKnown) {
  Tower<TypeParam> w(false);
  const std::uint32_t beside = w.add(50, 0);
  w.tick(10);
  const double overlap = w.solver->unrest(beside)->overlap;
  EXPECT_GT(overlap, 0) << "it lies on the ground";
  ASSERT_TRUE(w.solver->park(w.low));
  EXPECT_EQ(w.solver->unrest(beside)->overlap, overlap);
  EXPECT_EQ(w.solver->unrest(w.high)->overlap, 0) << "it lay on the other";
}

// It comes back between them while they touch, falls, and the others know nothing of it.
TYPED_TEST(Parking, ComesBackToItsPlaceInTheList) {
  Tower<TypeParam> alone(false), beside(true);
  alone.tick(10);
  beside.tick(10);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation() = Eigen::Vector3d(50, 5, 0);
  beside.solver->place(beside.lent, place);
  const double height = beside.solver->position(beside.lent, 0).y();
  beside.solver->unpark(beside.lent, {0, 1, 0}, {0, 0, 0});
  alone.tick(6);
  beside.tick(6);
  this->expectSame(alone, beside);
  // Leapfrog is exact in free fall but for where in its first substep the velocity is, and for its rounding.
  const double time = 6 * kFrame, flown = time - 0.5 * 9.81 * time * time;
  const double within = 0.5 * 9.81 * time * beside.solver->report().substep + 1e-6;
  EXPECT_NEAR(beside.solver->position(beside.lent, 0).y() - height, flown, 1.1 * within);
  EXPECT_NEAR(beside.solver->books().mass, beside.massOf({beside.low, beside.lent, beside.high}), 1e-9);
}

TYPED_TEST(Parking, IsRemovedWhileItIsLent) {
  Tower<TypeParam> w(true);
  w.tick(3);
  w.solver->removeBody(w.lent);
  w.tick(3);
  EXPECT_EQ(w.solver->failure(), "");
  EXPECT_NEAR(w.solver->books().mass, w.massOf({w.low, w.high}), 1e-9);
  EXPECT_THROW(w.solver->view(w.lent), Error);
  w.solver->removeBody(w.low);
  w.tick(3);
  EXPECT_NEAR(w.solver->books().mass, w.massOf({w.high}), 1e-9);
}

}  // namespace
}  // namespace rubble::test
