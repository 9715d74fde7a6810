// What corners of rigid bodies remember.
#include <gtest/gtest.h>

#include "edem/corner_memory.h"

namespace rubble::test {

TEST(CornerMemories, FindOneOfManyByItsName) {
  edem::CornerMemories memories;
  const auto nameOf = [](std::uint32_t n) { return edem::CornerName{n % 3, 1 + n % 7, n / 21}; };
  constexpr std::uint32_t kMany = 500;
  for (std::uint32_t n = 0; n < kMany; ++n)  // none came from far: sunk by what is more than way
    EXPECT_NEAR(memories.press(nameOf(n), 1, n, 1 + n, 0.5, 0).sunk, 0.5 + n, 1e-12);
  EXPECT_EQ(memories.all().size(), kMany);
  memories.beginStep();
  EXPECT_TRUE(memories.all().empty());
  for (std::uint32_t n = 0; n < kMany; n += 2) {
    // In its element, and slid into the next by as much as it nears.
    EXPECT_NEAR(memories.press(nameOf(n), 1, n, 2 + n, 0.1, 0).sunk, 0.5 + n, 1e-12);
    EXPECT_NEAR(memories.press(nameOf(n), 1, n + 1, 2 + n, 0.1, 0.25).sunk, 0.25 + n, 1e-12);
  }
  EXPECT_EQ(memories.all().size(), kMany / 2);
  memories.beginStep();
  // Out of all for an instant: first seen anew.
  EXPECT_NEAR(memories.press(nameOf(1), 1, 1, 3, 0.5, 0).sunk, 2.5, 1e-12);
}

// It pressed 1 mm deep. Back under the same name it is seen anew: 22 J came of a plate's edges.
TEST(CornerMemories, ForgetABodyThatHasLeft) {
  edem::CornerMemories memories;
  memories.press({0, 1, 1}, 7, 0, 1e-3, 1, 0);
  memories.press({0, 1, 2}, 8, 0, 1e-3, 1, 0);
  memories.forget(7);
  memories.beginStep();
  EXPECT_NEAR(memories.press({0, 1, 1}, 7, 0, 1e-3, 1e-5, 0).pressed, 1e-5, 1e-12);
  EXPECT_NEAR(memories.press({0, 1, 2}, 8, 0, 1e-3, 1e-5, 0).pressed, 1e-3, 1e-12);
}

}  // namespace rubble::test
