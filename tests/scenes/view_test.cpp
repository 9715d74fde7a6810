// The viewer, on a screen of its own.
#include <gtest/gtest.h>

#include "scenes/child.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

bool hasVirtualScreen() {
  return std::system("command -v xvfb-run >/dev/null") == 0;
}

TEST(View, OpensDrawsAndClosesAfterItsFrames) {
  if (!hasVirtualScreen()) GTEST_SKIP() << "xvfb-run is not installed";
  const TestFolder folder;
  const std::string scene = folder.write("small.json", kSmallWall);
  const ChildResult result = runChild(
      "xvfb-run -a -s '-screen 0 640x480x24' " RUBBLE_PROGRAM " view " + scene + " --size 320x240 --frames 4",
      folder.path());
  EXPECT_EQ(result.exitCode, 0) << result.error;
}

TEST(View, WithoutADisplayIsRefusedInOneLine) {
  const TestFolder folder;
  const std::string scene = folder.write("small.json", kSmallWall);
  const ChildResult result =
      runChild("env -u DISPLAY -u WAYLAND_DISPLAY " RUBBLE_PROGRAM " view " + scene, folder.path());
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.error.find("rubble: error: window: "), std::string::npos) << result.error;
}

}  // namespace
}  // namespace rubble::test
