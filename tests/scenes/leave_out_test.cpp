// What a run leaves out costs nothing: no GL library is loaded, no thread is started, no memory taken.
#include <gtest/gtest.h>
#include <malloc.h>

#include <fstream>
#include <sstream>

#include "demo/dust_setup.h"
#include "demo/run.h"
#include "scenes/scene_file.h"
#include "support/strict_log.h"

namespace rubble::test {
namespace {

std::string loadedLibraries() {
  std::ostringstream maps;
  maps << std::ifstream("/proc/self/maps").rdbuf();
  return maps.str();
}

std::string statusLine(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return line;
  return {};
}

demo::Scene smallWall(const TestFolder& folder, const std::vector<demo::Override>& overrides = {}) {
  return demo::loadScene(folder.write("small.json", kSmallWall), overrides);
}

TEST(LeaveOut, ARunWithoutPicturesLoadsNoGlLibrary) {
  const TestFolder folder;
  std::ostringstream report;
  demo::runScene(smallWall(folder), {.out = folder.path() / "out", .render = false, .log = strictLog()},
                 report);
  const std::string maps = loadedLibraries();
  for (const char* library :
       {"libGL.so", "libGLX", "libOpenGL", "libEGL", "libgallium", "libLLVM", "_dri.so"})
    EXPECT_EQ(maps.find(library), std::string::npos) << library;
  EXPECT_NE(maps.find("libBulletDynamics"), std::string::npos) << "the test must see libraries at all";
}

TEST(LeaveOut, ASceneWithoutDustHasNoGridAndNoThread) {
  const TestFolder folder;
  const demo::Scene without = smallWall(folder, {{"dust", "null"}});
  const std::string threads = statusLine("Threads:");
  const auto grid = demo::makeDust(without, demo::Renderer3D::None, 4);
  EXPECT_EQ(grid, nullptr);
  demo::World world(without, demo::cookObjects(without, {}, strictLog()), strictLog());
  world.step();
  EXPECT_EQ(statusLine("Threads:"), threads);
  EXPECT_NE(demo::makeDust(smallWall(folder), demo::Renderer3D::None, 4), nullptr);
}

TEST(LeaveOut, ASceneWithoutDebrisAllocatesNone) {
  const TestFolder folder;
  const auto memoryOf = [&](const demo::Scene& scene, const demo::Assets& assets) {
    const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
    const demo::World world(scene, assets, strictLog());
    EXPECT_TRUE(world.destruction().debris().empty());
    return mallinfo2().uordblks + mallinfo2().hblkhd - before;
  };
  // A budget of a million pieces of over 64 bytes is more than the rest of the small wall's world by far.
  const demo::Scene with = smallWall(folder, {{"debris.budget", "1000000"}});
  const demo::Scene without = smallWall(folder, {{"debris", "null"}});
  const demo::Assets assets = demo::cookObjects(with, {}, strictLog());
  if (memoryOf(with, assets) == 0) GTEST_SKIP() << "this allocator does not count";
  EXPECT_LT(memoryOf(without, assets), 64u * 1000000u / 2);
}

}  // namespace
}  // namespace rubble::test
