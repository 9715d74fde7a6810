// The scene `wall` with pictures.
#include <gtest/gtest.h>

#include "scenes/wall_run.h"

namespace rubble::test {
namespace {

TEST(WallPictures, DoNotTouchTheSimulation) {
  const std::vector<std::string> headless = hashesOf(runWall({kCompared}));
  ASSERT_EQ(headless.size(), kComparedFrames);
  EXPECT_EQ(headless, hashesOf(runWall({kCompared}, 1, true)));
}

}  // namespace
}  // namespace rubble::test
