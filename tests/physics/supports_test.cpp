// Rigid bodies that the host's contacts hold within a tick. Expected values: momentum, and Coulomb's law.
#include "edem/supports.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rubble::edem {
namespace {

constexpr double kTick = 1.0 / 60, kStep = kTick / 200;

RigidProxy bodyOf(double mass, const Eigen::Vector3d& velocity) {
  RigidProxy proxy;
  proxy.inverseMass = 1 / mass;
  proxy.inverseInertia.setConstant(6 / mass);  // of a cube with edges of 1 m
  proxy.velocity = velocity;
  return proxy;
}

Support under(double gap, double friction = 0, std::uint32_t other = Support::kImmovable) {
  Support s;
  s.other = other;
  s.at = {0, -0.5, 0};
  s.atOther = {0, 0.5, 0};
  s.gap = gap;
  s.friction = friction;
  return s;
}

TEST(Supports, StopABodyWhereItsGapEnds) {
  std::vector<RigidProxy> proxies = {bodyOf(2, {0, -8, 0})};
  proxies[0].supports.push_back(under(0.05));
  double fallen = 0;
  for (int i = 0; i < 200; ++i) {
    holdProxies(proxies, kStep);
    fallen -= kStep * proxies[0].velocity.y();
  }
  EXPECT_NEAR(fallen, 0.05, 1e-12);
  EXPECT_NEAR(proxies[0].velocity.y(), 0, 1e-12);
  EXPECT_NEAR(proxies[0].supportImpulse.y(), 16, 1e-12);
}

TEST(Supports, LetWhatLeavesGo) {
  std::vector<RigidProxy> proxies = {bodyOf(2, {1, 3, 0})};
  proxies[0].supports.push_back(under(-0.01, 0.5));
  holdProxies(proxies, kStep);
  EXPECT_EQ(proxies[0].velocity, Eigen::Vector3d(1, 3, 0));
  EXPECT_TRUE(proxies[0].supportImpulse.isZero(0));
}

// Five cubes on each other and on the ground, of which the uppermost is pushed down by 1000 N for a tick.
TEST(Supports, OfAStackPassThePushOnToTheGround) {
  std::vector<RigidProxy> proxies;
  for (std::uint32_t i = 0; i < 5; ++i) {
    proxies.push_back(bodyOf(1, Eigen::Vector3d::Zero()));
    for (const double x : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) {
        Support s = under(0, 0.5, i == 0 ? Support::kImmovable : i - 1);
        s.at.x() = s.atOther.x() = x;
        s.at.z() = s.atOther.z() = z;
        proxies[i].supports.push_back(s);
      }
    }
  }
  double sunk = 0;
  for (int i = 0; i < 200; ++i) {
    proxies[4].velocity.y() -= kStep * 1000;
    holdProxies(proxies, kStep);
    sunk -= kStep * proxies[4].velocity.y();
  }
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), given = momentum;
  for (const RigidProxy& p : proxies) {
    momentum += p.velocity / p.inverseMass;
    given += p.supportImpulse;
  }
  // What the ground gave is all that is missing.
  EXPECT_NEAR(momentum.y(), given.y() - 1000 * kTick, 1e-9);
  EXPECT_GT(given.y(), 0.95 * 1000 * kTick);
  // Free, one cube of 1 kg would have come 139 mm.
  EXPECT_LT(sunk, 0.005);
}

TEST(Supports, RubAsCoulombSays) {
  for (const double friction : {0.0, 0.2, 5.0}) {
    std::vector<RigidProxy> proxies = {bodyOf(1, {4, -3, 0})};
    proxies[0].inverseInertia.setZero();  // it does not tip
    proxies[0].supports.push_back(under(0, friction));
    holdProxies(proxies, kStep);
    EXPECT_NEAR(proxies[0].velocity.x(), std::max(0.0, 4 - 3 * friction), 1e-12) << friction;
    EXPECT_NEAR(proxies[0].velocity.y(), 0, 1e-12);
  }
}

// A rod hit at its end by a support turns about its own centre of percussion: v + w r = 0 there.
TEST(Supports, TurnWhatTheyHoldAtItsEnd) {
  std::vector<RigidProxy> proxies = {bodyOf(1, {0, -2, 0})};
  Support s = under(0);
  s.at = {0.5, 0, 0};
  proxies[0].supports.push_back(s);
  holdProxies(proxies, kStep);
  // J (1/m + r^2 / I) = v, with 1/I = 6: J = 2 / 2.5.
  EXPECT_NEAR(proxies[0].supportImpulse.y(), 0.8, 1e-12);
  EXPECT_NEAR(proxies[0].velocity.y(), -1.2, 1e-12);
  EXPECT_NEAR(proxies[0].spin.z(), 6 * 0.5 * 0.8, 1e-12);
}

}  // namespace
}  // namespace rubble::edem
