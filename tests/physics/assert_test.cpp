// The doors of the stages refuse what only a mistake in our own code can hand them. Built everywhere, run
// where assertions are on: in asan-ubsan, tsan and debug.
#include <gtest/gtest.h>

#include "edem/contact.h"
#include "edem/damping.h"
#include "edem/stable_step.h"
#include "physics/bodies.h"

namespace rubble::test {
namespace {

class AssertDeathTest : public testing::Test {
 protected:
  AssertDeathTest() : m_body(edem::makeBody<double>(block({2, 1, 1}), 0)) {
    edem::beginSubstep(m_body.state, m_body.work);
    // Other tests of this process may have started threads.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }

  void SetUp() override {
#ifdef NDEBUG
    GTEST_SKIP() << "built without assertions";
#endif
  }

  edem::Body<double> m_body;
  edem::Books m_books;
  edem::TickReport m_report;
  edem::PairLists<double> m_lists;
};

TEST_F(AssertDeathTest, SpringsRefuseANegativeStep) {
  EXPECT_DEATH(edem::accumulateSprings(m_body, m_body.work, -1e-4, true, m_books), "kick >= 0");
}

TEST_F(AssertDeathTest, SpringsRefuseAnElementThatIsNotThere) {
  m_body.state.springs[0].second = 2;
  EXPECT_DEATH(edem::accumulateSprings(m_body, m_body.work, 1e-4, true, m_books), "elementCount");
}

TEST_F(AssertDeathTest, BreakingRefusesASpringThatIsNotThere) {
  m_body.work.overloaded = {7};
  m_body.work.overloadMode = {BreakMode::Tension};
  EXPECT_DEATH(edem::applyBreaks(m_body, 0, 1e-4, m_lists, m_books, m_report), "springs.size");
}

TEST_F(AssertDeathTest, BreakingRefusesASpringThatIsBrokenAlready) {
  m_body.state.intact[0] = 0;
  m_body.work.overloaded = {0};
  m_body.work.overloadMode = {BreakMode::Tension};
  EXPECT_DEATH(edem::applyBreaks(m_body, 0, 1e-4, m_lists, m_books, m_report), "intact");
}

TEST_F(AssertDeathTest, MotionRefusesAStepThatIsNotFinite) {
  const std::span<const edem::Vec3<double>> listed(m_body.work.position);
  const double never = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DEATH(edem::integrate(m_body, 1e-4, never, kNoGravity, listed, kNoGravity, m_books), "isfinite");
}

TEST_F(AssertDeathTest, MotionRefusesPlacesOfAnotherBody) {
  const std::span<const edem::Vec3<double>> listed(m_body.work.position.data(), 1);
  EXPECT_DEATH(edem::integrate(m_body, 1e-4, 1e-4, kNoGravity, listed, kNoGravity, m_books), "listed.size");
}

TEST_F(AssertDeathTest, AContactRefusesANormalThatIsNotUnit) {
  const edem::ContactMotion<double> motion{1e-3, 1, 0, {0, 2, 0}, {0, -1, 0}, {0, 0, 0}};
  edem::ContactMemory<double> memory;
  EXPECT_DEATH(edem::contactLoad({1e6, 10}, motion, 0.0, memory), "squaredNorm");
}

TEST_F(AssertDeathTest, AContactRefusesAGap) {
  const edem::ContactMotion<double> motion{-1e-3, 1, 0, {0, 1, 0}, {0, -1, 0}, {0, 0, 0}};
  edem::ContactMemory<double> memory;
  EXPECT_DEATH(edem::contactLoad({1e6, 10}, motion, 0.0, memory), "overlap >= 0");
}

TEST_F(AssertDeathTest, TheBoundRefusesNegativeRates) {
  edem::RateBound bound;
  EXPECT_DEATH(bound.add(edem::ElementRates{-1, 0}, edem::ElementRates{}), "stiffness >= 0");
}

TEST_F(AssertDeathTest, DampingRefusesANegativeRate) {
  EXPECT_DEATH(edem::dampDeformation(m_body, -1, 1e-3, m_books), "rate >= 0");
}

}  // namespace
}  // namespace rubble::test
