// A test with a warning that it does not name fails.
#include "support/strict_log.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

namespace rubble::test {
namespace {

TEST(StrictLog, FailsOnAWarningAlone) {
  EXPECT_NONFATAL_FAILURE(strictLog()(LogLevel::Warning, "no room"), "no room");
  strictLog()(LogLevel::Info, "packed");
}

TEST(ExpectedWarnings, FailOnWhatWasNotTaken) {
  EXPECT_NONFATAL_FAILURE(
      {
        ExpectedWarnings warnings;
        warnings.log()(LogLevel::Warning, "no room");
        warnings.log()(LogLevel::Warning, "a cone touches nothing");
        EXPECT_EQ(warnings.take("touches nothing"), 1);
      },
      "no room");
}

TEST(ExpectedWarnings, CountThoseTaken) {
  ExpectedWarnings warnings;
  const LogFunction log = warnings.log();
  log(LogLevel::Warning, "first");
  log(LogLevel::Info, "first of all");
  EXPECT_EQ(warnings.take("second"), 0);
  EXPECT_EQ(warnings.take("first"), 1);
  EXPECT_EQ(warnings.take("first"), 0);
}

}  // namespace
}  // namespace rubble::test
