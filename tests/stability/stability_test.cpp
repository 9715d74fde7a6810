// A few of the cases, in every run; stability_long_test.cpp has the rest.
#include <gtest/gtest.h>

#include "stability/runner.h"

namespace rubble::test {
namespace {

class Stability : public testing::TestWithParam<int> {};

TEST_P(Stability, StepIsFiniteAndMakesNoEnergyOrSaysWhy) {
  const Case c = stabilityCase(GetParam());
  for (const std::string& violation : run(c).violations) ADD_FAILURE() << violation << "\n" << describe(c);
}

INSTANTIATE_TEST_SUITE_P(Case, Stability, testing::Range(0, 25));

}  // namespace
}  // namespace rubble::test
