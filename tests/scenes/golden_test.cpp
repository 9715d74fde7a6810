// The scene `wall` to the last bit: the same hashes in every build, optimised or not, sanitized or not. A
// change that is meant to change the physics changes them; this prints the lines to put into the tables, here
// and in rubble/version.h, each with the name of its table:
//
//     build/release/tests/scenes/golden_test | grep now
#include <gtest/gtest.h>

#include <cstdint>
#include <ios>
#include <span>

#include "base/hash.h"
#include "demo/world.h"
#include "rubble/version.h"
#include "support/strict_log.h"

namespace rubble::test {
namespace {

using Overrides = std::vector<demo::Override>;

// A quarter of the elements and the ball 5 mm before the wall, so that a build without optimisation takes
// seconds.
const Overrides kSmallWall = {{"objects.0.elements", "512"},
                              {"objects.0.radius", "0.026"},
                              {"impactors.0.position", "[0, 0.5, -0.195]"},
                              {"frames", "2"}};
constexpr SolverVersion kSmall[] = {
    {"float", 0x311c737e8c57ccd9, 0xcec8116aa6f2dcc8, 0xb02ccf4dc154fa4c},
    {"double", 0xee0ca9a196c24826, 0xf045cefad120d243, 0xbc51fe7029234418},
};

// As bundled; by frame 6 the blow is over and debris fly.
const Overrides kWholeWall = {{"frames", "6"}};

void addDust(base::Fnv1a& hash, const Events& events) {
  for (const DustSource& source : events.dustSources) {
    for (const Eigen::Vector3f& vector : {source.position, source.velocity}) hash.addAll(vector);
    for (const float number : {source.mass, source.size}) hash.add(number);
  }
}

SolverVersion versionOf(const demo::Scene& scene, const demo::Assets& assets, const char* precision) {
  demo::World world(scene, assets, strictLog());
  Destruction& destruction = world.destruction();
  base::Fnv1a dust;
  for (int frame = 0; frame < scene.frames; ++frame) {
    world.step();
    addDust(dust, destruction.takeEvents());
  }
  EXPECT_GT(destruction.counts().springsBroken, 0u);
  EXPECT_FALSE(destruction.debris().empty());
  EXPECT_GT(destruction.ledger().massDustEmitted, 0);
  dust.add(destruction.ledger().massDustEmitted);
  return {precision, world.hash(), destruction.debrisHash(), dust.value()};
}

void expectHashes(const Overrides& overrides, std::span<const SolverVersion> table, const char* name) {
  const demo::Assets assets = demo::cookObjects(demo::loadScene("wall", overrides), {}, strictLog());
  for (const SolverVersion& golden : table) {
    Overrides all = overrides;
    all.push_back({"precision", golden.precision});
    const SolverVersion found = versionOf(demo::loadScene("wall", all), assets, golden.precision);
    EXPECT_TRUE(found.world == golden.world && found.debris == golden.debris && found.dust == golden.dust)
        << std::hex << "now    {\"" << found.precision << "\", 0x" << found.world << ", 0x" << found.debris
        << ", 0x" << found.dust << "},  // " << name;
  }
}

TEST(Golden, SmallWallAfterTheBlow) {
  expectHashes(kSmallWall, kSmall, "kSmall");
}

TEST(Golden, WallAfterTheBlow) {
  expectHashes(kWholeWall, kSolverVersions, "kSolverVersions, rubble/version.h");
}

}  // namespace
}  // namespace rubble::test
