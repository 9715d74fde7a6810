// The scenes of the paper's figures 7 and 8 and the statue, small enough for every test run: fewer
// elements, the same blow.
#include <gtest/gtest.h>

#include <map>

#include "demo/world.h"
#include "support/strict_log.h"

namespace rubble::test {
namespace {

using Overrides = std::vector<demo::Override>;

class SmallScene {
 public:
  SmallScene(const char* name, const Overrides& overrides)
      : m_world(demo::loadScene(name, overrides),
                demo::cookObjects(demo::loadScene(name, overrides), {}, strictLog()), strictLog()) {}

  void run(int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      m_world.step();
      for (const SpringBroken& event : m_world.destruction().takeEvents().springsBroken)
        ++m_broken[event.body];
    }
  }
  // Springs of one object that broke, as its events tell.
  std::uint32_t broken(std::size_t object) { return m_broken[body(object).id()]; }
  const DestructibleBody& body(std::size_t object) { return *m_world.destruction().bodies()[object]; }
  demo::World& world() { return m_world; }

  // Mean height of the intact elements that started between two heights above the ground [m].
  double meanHeight(std::size_t object, double low, double high) {
    const Asset& asset = *body(object).asset();
    const double ground = asset.bounds().min().y();
    std::vector<ElementPose> poses(asset.elementCount());
    body(object).poses(poses);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double start = asset.positions[i].y() - ground;
      if (start < low || start > high || poses[i].alive == 0) continue;
      sum += double(poses[i].position.y());
      ++count;
    }
    EXPECT_GT(count, 0);
    return sum / count;
  }

 private:
  demo::World m_world;
  std::map<std::uint32_t, std::uint32_t> m_broken;
};

// Bars of plugin/README.md, "Ledgers", in float.
void expectConsistent(SmallScene& scene, std::size_t objects) {
  const Destruction& destruction = scene.world().destruction();
  const DestructionCounts counts = destruction.counts();
  std::size_t elements = 0, springs = 0, broken = 0;
  for (std::size_t i = 0; i < objects; ++i) {
    const Asset& asset = *scene.body(i).asset();
    elements += asset.elementCount();
    springs += asset.springs.size() + (scene.world().scene().objects[i].anchor ? asset.anchors.size() : 0);
    broken += scene.broken(i);
  }
  EXPECT_EQ(counts.elements, elements);
  EXPECT_EQ(counts.intact() + counts.crushed, elements);
  EXPECT_EQ(counts.springs, springs);
  EXPECT_EQ(counts.springsBroken, broken);
  EXPECT_GT(counts.fragments, objects);
  EXPECT_LT(destruction.ledger().massError, 1e-6);
  EXPECT_LT(destruction.ledger().momentumError(), 1e-4);
  EXPECT_LT(destruction.ledger().energyError, 0.02);
}

// By frame 10 the blow is over. Two thirds of the ball's springs are a crumbled ball; the wall around the
// hole stands.
TEST(TwoFragile, WallGetsAHoleAndTheBallCrumbles) {
  SmallScene scene("two_fragile", {{"objects.0.elements", "512"},
                                   {"objects.0.radius", "0.026"},
                                   {"objects.1.elements", "64"},
                                   {"objects.1.position", "[0, 0.524, -0.2]"}});
  scene.run(10);
  expectConsistent(scene, 2);
  const auto share = [&](std::size_t object) {
    return double(scene.broken(object)) / double(scene.body(object).asset()->springs.size());
  };
  EXPECT_GT(share(0), 0.05);
  EXPECT_LT(share(0), 0.5);
  EXPECT_GT(share(1), 0.67);
}

// Without support the capital is half a metre lower after a third of a second of fall; the base is tied to
// the ground.
TEST(Column, BreaksAndItsTopFalls) {
  SmallScene scene("column", {{"objects.0.elements", "320"}, {"impactors.0.position", "[0, 0.7, -0.3]"}});
  const double base = scene.meanHeight(0, 0, 0.15), capital = scene.meanHeight(0, 1.45, 1.6);
  scene.run(24);
  expectConsistent(scene, 1);
  EXPECT_GT(scene.broken(0), 0u);
  EXPECT_NEAR(scene.meanHeight(0, 0, 0.15), base, 0.05);
  EXPECT_LT(scene.meanHeight(0, 1.45, 1.6), capital - 0.3);
  EXPECT_GT(scene.meanHeight(0, 1.45, 1.6), capital - 9.81 / 2 * 0.16);  // of free fall for 24 frames
}

// Shot through the chest: the arm that is up, and the head, come down; the plinth is tied to the ground.
TEST(Statue, BreaksAndItsArmFalls) {
  SmallScene scene("statue", {{"objects.0.elements", "512"}, {"impactors.0.position", "[0.02, 0.95, -0.3]"}});
  const double plinth = scene.meanHeight(0, 0, 0.19), arm = scene.meanHeight(0, 1.35, 1.6);
  scene.run(24);
  expectConsistent(scene, 1);
  EXPECT_NEAR(scene.meanHeight(0, 0, 0.19), plinth, 0.05);
  EXPECT_LT(scene.meanHeight(0, 1.35, 1.6), arm - 0.2);
  EXPECT_GT(scene.meanHeight(0, 1.35, 1.6), arm - 9.81 / 2 * 0.16);  // of free fall for 24 frames
}

}  // namespace
}  // namespace rubble::test
