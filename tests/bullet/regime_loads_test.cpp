// Loads that rest on bodies that are Bullet's until they are struck.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "bullet/regime_bodies.h"

namespace rubble::test {
namespace {

#ifdef RUBBLE_SANITIZED  // the same code at every rate
constexpr std::array kBeamRates = {60};
#else
constexpr std::array kBeamRates = {60, 240};
#endif

// A weight that a force lowers onto what is below it.
class LoweredWeight {
 public:
  LoweredWeight(BulletWorld& w, btScalar rate, btScalar mass, btCollisionShape& shape, const btVector3& at)
      : m_world(w), m_rate(rate), m_mass(mass), m_body(w.add(mass, shape, at)) {
    m_body->setActivationState(DISABLE_DEACTIVATION);
  }
  // Lets a force on the body below grow steadily from `from` to `to` [N] until something breaks; returns the
  // force then, or none.
  std::optional<double> press(double from, double to, double seconds) {
    const int ticks = int(seconds * double(m_rate));
    for (int tick = 0; tick < ticks; ++tick) {
      const double force = from + (to - from) * (tick + 1) / ticks;
      m_body->applyCentralForce({0, m_mass * btScalar(9.81) - btScalar(force), 0});
      m_world.world.stepSimulation(1 / m_rate, 1, 1 / m_rate);
      if (m_world.destruction->counts().springsBroken > 0) return force;
    }
    return std::nullopt;
  }

 private:
  BulletWorld& m_world;
  btScalar m_rate, m_mass;
  btRigidBody* m_body;
};

// A beam of 1 x 0.1 x 0.1 m on two posts 0.05 m wide, 0.9 m apart in the clear, with a plate 0.1 m wide on
// its middle. The moment there, of the force F on the plate and of the beam's own q, is F (l - b / 2) / 4 +
// q (l^2 / 8 - o^2 / 2), o what stands over each end; the stress M / (t^3 / 6).
struct BeamUnderWeight {
  static constexpr double kSpan = 0.88, kOver = 0.06, kThick = 0.1, kPlate = 0.12;

  explicit BeamUnderWeight(btScalar rate) {
    m.youngsModulus *= 4;  // four times as strong as concrete_soft: it carries more than itself
    m.tensileStrength *= 4;
    m.compressiveStrength *= 4;
    w.add(0, post, {btScalar(0.03), btScalar(0.1), btScalar(0.05)});
    w.add(0, post, {btScalar(0.97), btScalar(0.1), btScalar(0.05)});
    DestructibleBodyDef def = blockDef({20, 2, 2}, {0, btScalar(0.2), 0});
    def.material = m;
    beam = w.destruction->addBody(def);
    const double most = 1.5 * forceAt(1) / 9.81;
    weight.emplace(w, rate, btScalar(most), plate, btVector3(btScalar(0.5), btScalar(0.325), btScalar(0.05)));
  }
  // On the plate, for this share of the tensile strength [N].
  double forceAt(double share) const {
    const double modulus = kThick * kThick * kThick / 6,
                 own = m.density * kThick * kThick * 9.81 * (kSpan * kSpan / 8 - kOver * kOver / 2);
    return (share * m.tensileStrength * modulus - own) * 4 / (kSpan - kPlate / 2);
  }

  BulletWorld w;
  Material m = material("concrete_soft");
  btBoxShape post{{btScalar(kOver / 2), btScalar(0.1), btScalar(0.1)}};
  btBoxShape plate{{btScalar(kPlate / 2), btScalar(0.025), btScalar(0.1)}};
  DestructibleBody* beam = nullptr;
  std::optional<LoweredWeight> weight;
};

TEST(Regime, ABeamBreaksUnderAWeightLoweredOnItsMiddle) {
  for (const int rate : kBeamRates) {
    SCOPED_TRACE(rate);
    BeamUnderWeight gentle{btScalar(rate)};
    EXPECT_FALSE(gentle.weight->press(0, gentle.forceAt(0.4), 2));
    EXPECT_FALSE(gentle.weight->press(gentle.forceAt(0.4), gentle.forceAt(0.4), 1));
    EXPECT_TRUE(gentle.beam->isWhole());
    BeamUnderWeight rising{btScalar(rate)};
    const auto broke = rising.weight->press(0, rising.forceAt(1.5), 4);
    ASSERT_TRUE(broke);
    EXPECT_NEAR(*broke, rising.forceAt(1), 0.25 * rising.forceAt(1));
  }
}

// It bends under a load, for which it became elements, and goes back without it. Of that load it knows now:
// of half the strength, and it waits for half as much again, 0.75. What it is taken to bear is right to a
// tenth.
TEST(Regime, WhatALoadDidNotBreakThawsForALargerOneOnly) {
  BeamUnderWeight c(240);
  EXPECT_FALSE(c.weight->press(0, c.forceAt(0.55), 2));
  EXPECT_FALSE(c.beam->isWhole());
  EXPECT_FALSE(c.weight->press(c.forceAt(0.55), c.forceAt(0.3), 1));
  EXPECT_FALSE(c.weight->press(c.forceAt(0.3), c.forceAt(0.3), 3));
  EXPECT_TRUE(c.beam->isWhole());
  EXPECT_FALSE(c.weight->press(c.forceAt(0.3), c.forceAt(0.62), 2));
  EXPECT_TRUE(c.beam->isWhole());
  EXPECT_FALSE(c.weight->press(c.forceAt(0.62), c.forceAt(0.85), 2));
  EXPECT_FALSE(c.beam->isWhole());
  EXPECT_LT(std::abs(c.w.destruction->ledger().linearError), 1e-4);
}

TEST(Regime, AColumnIsCrushedByAWeightLoweredOnIt) {
  Material m = material("concrete_soft");
  m.tensileStrength = 0.1e6;
  m.compressiveStrength = 0.15e6;
  constexpr double kArea = 0.01, kHeight = 0.3;
  const auto forceAt = [&](double share) {  // at its foot
    return (share * m.compressiveStrength - m.density * kHeight * 9.81) * kArea;
  };
  for (const int rate : {240}) {
    SCOPED_TRACE(rate);
    for (const double share : {0.4, 1.5}) {
      BulletWorld w;
      DestructibleBodyDef def = blockDef({2, 6, 2}, {0, 0, 0});
      def.material = m;
      const DestructibleBody* column = w.destruction->addBody(def);
      btBoxShape plate({btScalar(0.1), btScalar(0.05), btScalar(0.1)});
      LoweredWeight weight(w, btScalar(rate), btScalar(forceAt(1.5) / 9.81), plate,
                           {btScalar(0.05), btScalar(kHeight + 0.05), btScalar(0.05)});
      const auto broke = weight.press(0, forceAt(share), 4);
      EXPECT_EQ(column->isWhole(), share < 1);
      EXPECT_EQ(broke.has_value(), share > 1);
      if (broke) {
        EXPECT_NEAR(*broke, forceAt(1), 0.25 * forceAt(1));
      }
    }
  }
}

// Anchored at one end: sigma = 3 rho g l^2 / t there.
TEST(Regime, ACantileverBreaksByItsOwnWeight) {
  const Material m = material("concrete_soft");
  const double length = std::sqrt(m.tensileStrength * 0.1 / (3 * m.density * 9.81));  // 0.53 m
  const int longer = int(std::ceil(1.1 * length / 0.05));
  for (const int cubes : {longer, longer / 2}) {
    SCOPED_TRACE(cubes);
    BulletWorld w;
    w.world.setGravity({btScalar(9.81), 0, 0});
    DestructibleBodyDef def = blockDef({2, cubes, 2}, {0, btScalar(0.5), 0});
    def.asset =
        std::make_shared<const Asset>(gridAsset({.cubes = {2, cubes, 2}, .edge = 0.05, .anchored = true}));
    def.anchored = true;
    const DestructibleBody* beam = w.destruction->addBody(def);
    for (int tick = 0; tick < 3 * 240; ++tick)
      w.world.stepSimulation(btScalar(1) / 240, 1, btScalar(1) / 240);
    EXPECT_EQ(w.destruction->counts().springsBroken > 0, cubes == longer);
    EXPECT_EQ(beam->isWhole(), cubes != longer);
  }
}

}  // namespace
}  // namespace rubble::test
