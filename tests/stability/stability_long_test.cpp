// All cases. The program also runs one alone and tells of each tick, `--case N`; `rubble report stability`
// makes a table of all.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "demo/stability/known_faults.h"
#include "demo/stability/runner.h"

namespace rubble::test {
namespace {

constexpr int kCases = 500, kBlock = 25;

class StabilityLong : public testing::TestWithParam<int> {};

TEST_P(StabilityLong, StepsAreFiniteAndMakeNoEnergyOrSayWhy) {
  for (int n = GetParam(); n < GetParam() + kBlock; ++n) {
    const stability::Case c = stability::stabilityCase(n);
    const stability::Outcome outcome = stability::run(c);
    if (stability::knownFault(n)) {
      EXPECT_FALSE(outcome.violations.empty()) << "is mended: take it off the list\n" << describe(c);
      continue;
    }
    for (const std::string& violation : outcome.violations) ADD_FAILURE() << violation << "\n" << describe(c);
  }
}

INSTANTIATE_TEST_SUITE_P(CasesFrom, StabilityLong, testing::Range(0, kCases, kBlock));

// Prints the case before it runs, for one that does not come back. Whether it holds.
bool show(int number) {
  const stability::Case c = stability::stabilityCase(number);
  std::printf("%s\n", describe(c).c_str());
  std::fflush(stdout);
  const stability::Outcome outcome =
      stability::run(c, [](const std::string& line) { std::printf("  %s\n", line.c_str()); });
  std::printf("  %s after %d ticks, work %.3g, put %.4g J, held %.4g J%s%s\n", nameOf(outcome.kind),
              outcome.ticks, outcome.work, outcome.energyPut, outcome.energyHeld,
              outcome.said.empty() ? "" : ": ", outcome.said.c_str());
  for (const std::string& violation : outcome.violations) std::printf("  BROKEN: %s\n", violation.c_str());
  return outcome.violations.empty();
}

}  // namespace
}  // namespace rubble::test

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--case") == 0) return rubble::test::show(std::atoi(argv[2])) ? 0 : 1;
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
