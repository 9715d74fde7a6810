// What the scene `wall` promises, through the impact. The whole run and the sweep of speeds are in
// wall_long_test.cpp.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "scenes/wall_run.h"

namespace rubble::test {
namespace {

// By frame 6 the blow is over: all elements that it crushes are crushed.
const demo::Override kAfterTheBlow = {"frames", "6"};

// Bars of plugin/README.md, "Ledgers". Bullet's own bodies are not in the ledger, so its momentum is the side
// of the elements and their debris alone.
TEST(Wall, LedgersCloseInFloat) {
  const SceneRun run = runWall({kThroughTheWall});
  ASSERT_EQ(run.frames.size(), 12u);
  EXPECT_GT(run.summary.counts.springsBroken, 0u);
  EXPECT_GT(run.summary.ledger.massDustEmitted, 0);
  const LedgerErrors worst = worstErrors(run);
  EXPECT_LT(worst.mass, 1e-6);
  EXPECT_LT(worst.momentum, 1e-4);
  EXPECT_LT(worst.energy, 0.02);
  EXPECT_LT(worst.dust, 0.02);
}

TEST(Wall, LedgersCloseInDouble) {
  const SceneRun run = runWall({kThroughTheWall, {"precision", "double"}});
  ASSERT_EQ(run.frames.size(), 12u);
  EXPECT_GT(run.summary.counts.springsBroken, 0u);
  EXPECT_GT(run.summary.ledger.massDustEmitted, 0);
  const LedgerErrors worst = worstErrors(run);
  EXPECT_LT(worst.mass, 1e-12);
  EXPECT_LT(worst.momentum, 1e-9);
  EXPECT_LT(worst.energy, 0.02);
  EXPECT_LT(worst.dust, 0.02);
}

// The other side of the border: in every tick the ball's momentum changes by what the elements gave it and by
// gravity. The ball is a body of Bullet's in float. Without debris, which hit it too.
TEST(Wall, BallGetsWhatTheElementsGive) {
  const demo::Scene scene = demo::loadScene(
      "wall", {{"fps", "240"}, {"debris", "null"}, {"dust", "null"}, {"precision", "double"}});
  demo::World world(scene, demo::cookObjects(scene, {}, strictLog()), strictLog());
  const btRigidBody& ball = *world.impactors().front();
  const double mass = scene.impactors.front().mass;
  const auto momentum = [&] {
    const btVector3& v = ball.getLinearVelocity();
    return Eigen::Vector3d(mass * Eigen::Vector3d(double(v.x()), double(v.y()), double(v.z())));
  };
  const double scale = momentum().norm();
  double given = 0;
  for (int tick = 0; tick < 32; ++tick) {  // 8 frames of 60 Hz
    const Eigen::Vector3d before = momentum();
    world.step();
    const Eigen::Vector3d change = momentum() - before - mass * scene.gravity / scene.fps;
    double impulse = 0;
    for (const ContactImpulse& contact : world.destruction().takeEvents().contacts)
      if (contact.other == &ball) impulse += double(contact.impulse);
    EXPECT_NEAR(change.norm(), impulse, 1e-6 * scale) << "tick " << tick;
    given += impulse;
  }
  // It loses tens of percent of its speed on the way through.
  EXPECT_GT(given, 0.1 * scale);
}

TEST(Wall, SameSeedSameHashesOnAnyNumberOfThreads) {
  const std::vector<std::string> one = hashesOf(runWall({kCompared}, 1));
  ASSERT_EQ(one.size(), kComparedFrames);
  EXPECT_EQ(one, hashesOf(runWall({kCompared}, 2)));
}

// Mass [kg] of grains of one size R [m].
using MassBySize = std::map<double, double>;

// A crushed element's own law: the share (R / R_max)^m of its mass is in grains up to R.
struct ElementLaw {
  double mass;       // [kg]
  double maxRadius;  // R_max [m]
};

// Largest distance of the pieces' share of mass up to R from the law's, over all R.
double distance(const MassBySize& pieces, const std::vector<ElementLaw>& laws, double modulus) {
  double total = 0, below = 0, largest = 0;
  for (const ElementLaw& law : laws) total += law.mass;
  for (const auto& [radius, mass] : pieces) {
    double expected = 0;
    for (const ElementLaw& law : laws)
      expected += law.mass * std::min(1.0, std::pow(radius / law.maxRadius, modulus));
    // Between two sizes the pieces' share stands still, so it is furthest from the law just before or at one.
    largest = std::max(largest, std::abs(below - expected) / total);
    below += mass;
    largest = std::max(largest, std::abs(below - expected) / total);
  }
  return largest;
}

// Gaudin and Schuhmann's law (eq. 5, 6) under Bond's R_max = (C_B / W_I)^2 (eq. 4) with C_B of law 7 in
// plugin/README.md.
TEST(Wall, DebrisAndDustFollowTheSizeLawsOfTheirElements) {
  const SceneRun run = runWall({kAfterTheBlow});
  const Material material = demo::loadScene("wall").objects.front().material;
  const double m = material.sizeModulus;

  std::vector<ElementLaw> laws;
  MassBySize pieces;
  for (const Json& event : run.eventsOf("element_crushed")) {
    const double mass = event["mass_kg"], energy = event["fracture_J"];
    const double bond =
        36 * material.crushEfficiency * material.bondWorkIndex * mass / std::sqrt(2 * std::pow(0.8, 1 / m));
    const double maxRadius = bond * bond / (energy * energy);
    // Events are floats: 6e-8 of mass and energy, squared.
    EXPECT_NEAR(event["max_radius_m"].get<double>(), maxRadius, 1e-6 * maxRadius);
    laws.push_back({mass, maxRadius});
    pieces[material.dustRadius] += event["dust_kg"].get<double>();
  }
  for (const Json& event : run.eventsOf("debris_spawned"))
    pieces[event["radius_m"].get<double>()] += event["mass_kg"].get<double>();
  ASSERT_GT(laws.size(), 10u);
  ASSERT_EQ(run.summary.eventsDropped, 0u);

  const double apart = distance(pieces, laws, m);
  EXPECT_LT(apart, 0.02);
  RecordProperty("distance", std::to_string(apart));
}

// To the letter of the paper debris make momentum out of nothing, and the ledger must say so. At the preset's
// crush efficiency the paper's stretch criterion caps the springs' energy and no element is crushed: here a
// quarter of it.
TEST(Wall, ThePapersModelStaysFiniteAndItsLedgerTellsWhatItMakes) {
  const SceneRun run = runWall({kThroughTheWall,
                                {"objects.0.model.preset", "paper"},
                                {"objects.0.material.crush_efficiency", "1e-4"}});
  ASSERT_EQ(run.frames.size(), 12u);  // a number that is not finite ends the run
  EXPECT_GT(run.summary.counts.springsBroken, 0u);
  EXPECT_GT(run.summary.counts.crushed, 0u);
  const LedgerErrors worst = worstErrors(run);
  EXPECT_LT(worst.mass, 1e-6);
  EXPECT_GT(worst.momentum, 1e-4);
}

// Without damping, so only the pre-stress keeps it still.
TEST(WallQuiet, NothingBreaksOrMovesFromTheFirstFrame) {
  QuietWall wall({});
  ASSERT_FALSE(wall.world().scene().sleep);
  ASSERT_EQ(wall.world().scene().objects.front().massDamping, 0);
#ifdef RUBBLE_SANITIZED  // the same code in every frame, each of a second
  constexpr int kFrames = 4;
#else
  constexpr int kFrames = 20;
#endif
  for (int frame = 0; frame < kFrames; ++frame) EXPECT_LT(wall.step(), 1e-3) << "frame " << frame;
  EXPECT_EQ(wall.world().destruction().counts().springsBroken, 0u);
  EXPECT_GT(wall.world().substeps(), 0);
}

}  // namespace
}  // namespace rubble::test
