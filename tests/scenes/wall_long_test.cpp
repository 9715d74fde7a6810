// What the scene `wall` promises over its whole length, and over a sweep of speeds: minutes.
#include <gtest/gtest.h>
#include <malloc.h>

#include "scenes/wall_run.h"

namespace rubble::test {
namespace {

SceneRun runAtSpeed(int metresPerSecond) {
  return runWall({{"frames", "40"},
                  {"dust", "null"},
                  {"impactors.0.velocity", "[0,0," + std::to_string(metresPerSecond) + "]"}});
}

TEST(WallSweep, CrushingAndDustRiseWithTheSpeedOfTheBall) {
  const SceneRun slowest = runAtSpeed(2);
  EXPECT_EQ(slowest.summary.counts.crushed, 0u);
  std::uint32_t crushed = slowest.summary.counts.crushed;
  double dust = slowest.summary.ledger.massDustEmitted;
  for (const int speed : {5, 10, 20, 40}) {
    const SceneRun run = runAtSpeed(speed);
    ASSERT_EQ(run.frames.size(), 40u);
    EXPECT_GT(run.summary.counts.crushed, crushed) << speed << " m/s";
    EXPECT_GT(run.summary.ledger.massDustEmitted, dust) << speed << " m/s";
    crushed = run.summary.counts.crushed;
    dust = run.summary.ledger.massDustEmitted;
  }
}

TEST(WallSweep, TheBundledBallCrushesAHoleAndGoesOn) {
  const SceneRun run = runAtSpeed(10);
  const double share = double(run.summary.counts.crushed) / 2048;
  EXPECT_GT(share, 0.005);
  EXPECT_LT(share, 0.1);
  // Where the middle of the ball meets the front of the wall: after 0.7 m at 10 m/s it has fallen by 24 mm.
  const Eigen::Vector3d impact(0, 0.5, -0.04);
  const std::vector<Json> events = run.eventsOf("element_crushed");
  ASSERT_EQ(events.size(), run.summary.counts.crushed);
  for (const Json& event : events) {
    const Json& at = event["position_m"];
    EXPECT_LT((Eigen::Vector3d(at[0], at[1], at[2]) - impact).norm(), 0.3) << event.dump();
  }
  ASSERT_TRUE(run.summary.exitSpeed.has_value());
  EXPECT_GT(*run.summary.exitSpeed, 0);
}

// Bars of plugin/README.md, "Ledgers".
TEST(WallWhole, LedgersCloseInEveryFrame) {
  const SceneRun run = runWall({});
  ASSERT_EQ(run.frames.size(), 180u);
  const LedgerErrors worst = worstErrors(run);
  EXPECT_LT(worst.mass, 1e-6);
  EXPECT_LT(worst.momentum, 1e-4);
  EXPECT_LT(worst.energy, 0.02);
  EXPECT_LT(worst.dust, 0.02);
}

// What the energy ledger does not close is the error of the substep.
TEST(WallWhole, HalfTheSubstepClosesTheEnergyBetter) {
  const auto errorAt = [](const char* safety) {
    return worstErrors(runWall({{"frames", "20"}, {"dust", "null"}, {"substep_safety", safety}})).energy;
  };
  EXPECT_LT(errorAt("0.45"), errorAt("0.9"));
}

// Of one body.
std::vector<Eigen::Vector3f> placesIn(const demo::World& world) {
  const DestructibleBody& body = *world.destruction().bodies().front();
  std::vector<ElementPose> poses(body.asset()->elementCount());
  body.poses(poses);
  std::vector<Eigen::Vector3f> places;
  for (const ElementPose& pose : poses) places.push_back(pose.position);
  return places;
}

TEST(WallRubble, LiesForTenMinutesWhereItCameToRest) {
  const demo::Scene scene = demo::loadScene("wall", Overrides{{"dust", "null"}});
  demo::World world(scene, demo::cookObjects(scene, {}, strictLog()), strictLog());
  const auto run = [&](double seconds) {
    for (int frame = 0; frame < int(seconds * scene.fps); ++frame) {
      world.step();
      world.destruction().takeEvents();
    }
  };
  // Half a second for each fragment, and then all of it.
  run(3.2);
  EXPECT_LT(world.destruction().counts().awake, 64u);
  run(6.8);
  const auto before = placesIn(world);
  const Ledger ledger = world.destruction().ledger();
  const std::size_t memory = mallinfo2().uordblks;
  EXPECT_EQ(world.destruction().counts().awake, 0u);
  EXPECT_EQ(world.substeps(), 0);
  EXPECT_NEAR(ledger.kinetic, 0, 1e-9 * ledger.energyScale);
  EXPECT_LT(ledger.energyError, 1e-3);

  run(590);
  const auto after = placesIn(world);
  double drift = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    drift = std::max(drift, double((after[i] - before[i]).norm()));
  EXPECT_LT(drift, 1e-3);
  EXPECT_EQ(world.destruction().counts().awake, 0u);
  EXPECT_NEAR(world.destruction().ledger().kinetic, 0, 1e-9 * ledger.energyScale);
  EXPECT_NEAR(world.destruction().ledger().energyError, ledger.energyError, 1e-6);
  EXPECT_LT(mallinfo2().uordblks, memory + (1u << 16));
}

TEST(WallQuiet, NothingBreaksOrMovesForTenSeconds) {
  QuietWall wall({});
  ASSERT_FALSE(wall.world().scene().sleep);
  ASSERT_EQ(wall.world().scene().frames, 600);
  for (int frame = 0; frame < 600; ++frame) ASSERT_LT(wall.step(), 1e-3) << "frame " << frame;
  EXPECT_EQ(wall.world().destruction().counts().springsBroken, 0u);
}

TEST(WallQuiet, FallsAsleepWhereItMayAndCostsNoSubsteps) {
  QuietWall wall(Overrides{{"sleep", "true"}});
  for (int frame = 0; frame < 600; ++frame) ASSERT_LT(wall.step(), 1e-3) << "frame " << frame;
  EXPECT_EQ(wall.world().destruction().counts().springsBroken, 0u);
  EXPECT_TRUE(wall.body().isAsleep());
  EXPECT_EQ(wall.world().substeps(), 0);
}

}  // namespace
}  // namespace rubble::test
