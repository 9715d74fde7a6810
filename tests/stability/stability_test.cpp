// A few of the cases, in every run; stability_long_test.cpp has the rest.
#include <gtest/gtest.h>

#include "demo/stability/runner.h"

namespace rubble::test {
namespace {

class Stability : public testing::TestWithParam<int> {};

TEST_P(Stability, StepIsFiniteAndMakesNoEnergyOrSaysWhy) {
  const stability::Case c = stability::stabilityCase(GetParam());
  for (const std::string& violation : stability::run(c).violations)
    ADD_FAILURE() << violation << "\n" << describe(c);
}

INSTANTIATE_TEST_SUITE_P(Case, Stability, testing::Range(0, 25));
// Cases that have found a fault: a NaN of the impactor's, of a whole body's, a light body that turned back
// where nothing has weight, restitution that ran away, a hill with an inertia beyond Bullet's floats, a sum
// of energies of two instants, three elements that press a light body at once in ticks that jump, a thin
// plate that goes through spheres.
INSTANTIATE_TEST_SUITE_P(OnceBroken, Stability, testing::Values(57, 399, 86, 158, 252, 371, 79, 321));

}  // namespace
}  // namespace rubble::test
