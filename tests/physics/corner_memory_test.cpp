// What corners of rigid bodies remember.
#include <gtest/gtest.h>

#include "edem/corner_memory.h"

namespace rubble::test {

namespace {
edem::CornerPress pressOf(std::uint32_t body, std::uint32_t element, double depth, double way,
                          double nearer) {
  return {body, element, depth, way, nearer, nearer, 1};
}
}  // namespace

TEST(CornerMemories, FindOneOfManyByItsName) {
  edem::CornerMemories memories;
  const auto nameOf = [](std::uint32_t n) { return edem::CornerName{n % 3, 1 + n % 7, n / 21}; };
  constexpr std::uint32_t kMany = 500;
  for (std::uint32_t n = 0; n < kMany; ++n)  // none came from far: sunk by what is more than way
    EXPECT_NEAR(memories.press(nameOf(n), pressOf(1, n, 1 + n, 0.5, 0)).sunk, 0.5 + n, 1e-12);
  EXPECT_EQ(memories.all().size(), kMany);
  memories.beginStep();
  EXPECT_TRUE(memories.all().empty());
  for (std::uint32_t n = 0; n < kMany; n += 2) {
    // In its element, and slid into the next by as much as it nears.
    EXPECT_NEAR(memories.press(nameOf(n), pressOf(1, n, 2 + n, 1, 0)).sunk, 0.5 + n, 1e-12);
    EXPECT_NEAR(memories.press(nameOf(n), pressOf(1, n + 1, 2 + n, 0.1, 0.25)).sunk, 0.25 + n, 1e-12);
  }
  EXPECT_EQ(memories.all().size(), kMany / 2);
  memories.beginStep();
  // Out of all for an instant: first seen anew.
  EXPECT_NEAR(memories.press(nameOf(1), pressOf(1, 1, 3, 0.5, 0)).sunk, 2.5, 1e-12);
}

// It pressed 1 mm deep. Back under the same name it is seen anew: 22 J came of a plate's edges.
TEST(CornerMemories, ForgetABodyThatHasLeft) {
  edem::CornerMemories memories;
  memories.press({0, 1, 1}, pressOf(7, 0, 1e-3, 1, 0));
  memories.press({0, 1, 2}, pressOf(8, 0, 1e-3, 1, 0));
  memories.forget(7);
  memories.beginStep();
  EXPECT_NEAR(memories.press({0, 1, 1}, pressOf(7, 0, 1e-3, 1e-5, 0)).pressed, 1e-5, 1e-12);
  EXPECT_NEAR(memories.press({0, 1, 2}, pressOf(8, 0, 1e-3, 1e-5, 0)).pressed, 1e-3, 1e-12);
}

// Within its cell the nearest face that it presses may be another one at once, as it turns: it goes on as
// deep as it was, with what it has come nearer by; 12 times the energy put in came of a box that kicked
// needles.
TEST(CornerMemories, GoOnAsDeepAtAnotherFaceOfTheirCell) {
  const auto turn = [](double depth) {
    edem::CornerMemories memories;
    memories.press({0, 1, 0}, pressOf(1, 0, 1, 1, 0));
    memories.beginStep();
    return memories.press({0, 1, 0}, pressOf(1, 0, depth, 0.1, 0.05));
  };
  EXPECT_NEAR(turn(1.1).pressed, 1.1, 1e-12);  // the same face
  EXPECT_NEAR(turn(3).pressed, 1.05, 1e-12);
  EXPECT_NEAR(turn(0.5).pressed, 0.5, 1e-12);
  EXPECT_NEAR(turn(0.5).lost, 0.5 * (1.05 + 0.5 * (0.05 - 0.5)), 1e-12);
}

// A spring of 1 N/m, 2 m deep, slides on as its two cells near it by 0.2 and 0.4 m: the half forces have done
// 2 * 0.2 / 2 and F * 0.4 / 2.
TEST(CornerMemories, BookWhatASpringLosesOnItsWayToTheNextCell) {
  const auto slide = [](double depth, double stiffness) {
    edem::CornerMemories memories;
    memories.press({0, 1, 0}, pressOf(1, 0, 2, 2, 0));
    memories.beginStep();
    return memories.press({0, 1, 0}, {1, 5, depth, 1, 0.4, 0.2, stiffness});
  };
  const edem::CornerMemory deep = slide(3, 1);
  EXPECT_NEAR(deep.pressed, 2.3, 1e-12);
  EXPECT_NEAR(deep.lost, 0.2 + 0.46 - 0.5 * (2.3 * 2.3 - 2 * 2), 1e-12);
  const edem::CornerMemory shallow = slide(1, 1);  // it is no deeper than it is in the cell
  EXPECT_NEAR(shallow.pressed, 1, 1e-12);
  EXPECT_NEAR(shallow.lost, 0.2 + 0.2 - 0.5 * (1 - 2 * 2), 1e-12);
  const edem::CornerMemory stiff = slide(3, 4);  // the same energy
  EXPECT_NEAR(4 * stiff.pressed * stiff.pressed, 2.3 * 2.3, 1e-12);
}

// One that is in no cell any more: what it held and did for half of the step is lost, unless it left by
// itself.
TEST(CornerMemories, BookWhatASpringHeldThatPressesNothing) {
  edem::CornerMemories memories;
  memories.press({0, 1, 0}, pressOf(1, 0, 2, 2, 0)).speed = 0.5;
  memories.press({0, 2, 0}, pressOf(1, 0, 2, 2, 0)).speed = -8;
  memories.press({0, 3, 0}, pressOf(1, 0, 2, 2, 0));
  memories.beginStep();
  memories.press({0, 3, 0}, pressOf(1, 0, 2, 2, 0));
  std::vector<double> lost;
  memories.visitGone([&](const edem::CornerMemory& corner) { lost.push_back(corner.lostOutside(0.4)); });
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_NEAR(lost[0], 0.5 * 2 * 2 + 0.5 * 2 * 0.5 * 0.4, 1e-12);
  EXPECT_EQ(lost[1], 0);
}

}  // namespace rubble::test
