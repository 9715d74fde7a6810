// The scene `wall` with pictures.
#include <gtest/gtest.h>

#include "scenes/wall_run.h"

namespace rubble::test {
namespace {

TEST(WallPictures, DoNotTouchTheSimulation) {
  const std::vector<std::string> headless = hashesOf(runWall({kThroughTheWall}));
  ASSERT_EQ(headless.size(), 12u);
  EXPECT_EQ(headless, hashesOf(runWall({kThroughTheWall}, 1, true)));
}

}  // namespace
}  // namespace rubble::test
