// The scene `wall` to the last bit: the same hashes in every build, optimised or not, sanitized or not. A
// change that is meant to change the physics changes them; this prints the lines to put into the tables, and
// the first of the whole wall's into rubble/version.h:
//
//     build/release/tests/scenes/golden_test | grep now
#include <gtest/gtest.h>

#include <cstdint>
#include <ios>
#include <span>

#include "demo/world.h"
#include "rubble/version.h"
#include "support/strict_log.h"

namespace rubble::test {
namespace {

using Overrides = std::vector<demo::Override>;

// After the last frame; `world`: elements, springs and Bullet's bodies.
struct Golden {
  const char* precision;
  std::uint64_t world, debris;
};

// A quarter of the elements and the ball 5 mm before the wall, so that a build without optimisation takes
// seconds.
const Overrides kSmall = {{"objects.0.elements", "512"},
                          {"objects.0.radius", "0.026"},
                          {"impactors.0.position", "[0, 0.5, -0.195]"},
                          {"frames", "2"}};
constexpr Golden kSmallHashes[] = {
    {"float", 0xe4b0ee8633e2396e, 0x1bebea65c2a051b},
    {"double", 0xc4802e409890c065, 0xc5e1e29875f1a5e7},
};

// As bundled; by frame 6 the blow is over and debris fly.
const Overrides kWhole = {{"frames", "6"}};
constexpr Golden kWholeHashes[] = {
    {"float", kSolverVersionFloat, 0x5394fd8945514067},
    {"double", kSolverVersionDouble, 0xb55edb997980fe81},
};

void expectHashes(const Overrides& overrides, std::span<const Golden> table) {
  for (const Golden& golden : table) {
    Overrides all = overrides;
    all.push_back({"precision", golden.precision});
    const demo::Scene scene = demo::loadScene("wall", all);
    demo::World world(scene, demo::cookObjects(scene, {}, strictLog()), strictLog());
    for (int frame = 0; frame < scene.frames; ++frame) world.step();
    EXPECT_GT(world.destruction().counts().springsBroken, 0u);
    EXPECT_FALSE(world.destruction().debris().empty());
    const std::uint64_t hash = world.hash(), debris = world.destruction().debrisHash();
    EXPECT_TRUE(hash == golden.world && debris == golden.debris)
        << std::hex << "now    {\"" << golden.precision << "\", 0x" << hash << ", 0x" << debris << "},";
  }
}

TEST(Golden, SmallWallAfterTheBlow) {
  expectHashes(kSmall, kSmallHashes);
}

TEST(Golden, WallAfterTheBlow) {
  expectHashes(kWhole, kWholeHashes);
}

}  // namespace
}  // namespace rubble::test
