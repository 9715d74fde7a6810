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

// Beyond the 500 of the table: what falls from rest by many radii in a tick is followed.
INSTANTIATE_TEST_SUITE_P(Falls, Stability, testing::Values(901, 1087));
// Whole bodies that Bullet pushed out faster than they came: short ticks after long ones, and on top of
// restitution.
INSTANTIATE_TEST_SUITE_P(PushedOut, Stability, testing::Values(776, 1002, 1167));
// A light body that lay on elements and is put into them.
INSTANTIATE_TEST_SUITE_P(PutIn, Stability, testing::Values(578, 1591));
// Soft elements that gravity, or their spin, pressed hundreds of radii into the ground.
INSTANTIATE_TEST_SUITE_P(Deep, Stability, testing::Values(784, 1045, 1655, 1687));
// A light body that Bullet's floats alone moved, one that turned far in a tick, and the paper's contacts, of
// whose energy at the start a part was motion after one tick.
INSTANTIATE_TEST_SUITE_P(OneTick, Stability, testing::Values(867, 1535, 1444));

// Debris that are set out of what they are in, or wait on what falls away; a bounce with friction at a
// corner; a whole body that a kinematic one drives; one that turns five times a tick; the paper's contacts,
// by which elements become faster than light.
INSTANTIATE_TEST_SUITE_P(Placed, Stability, testing::Values(1279, 1917, 2343, 3359, 1452, 3728, 2986, 2725));

// Cases that once stopped: elements too heavy to become debris, a light body that was not softened with the
// others, a softness between what was tried and what is allowed, elements that have to be frozen, rounding
// that was all the energy of a first tick; and four whose elements are pressed so deep into the ground that
// their contacts made energy.
class Degrades : public testing::TestWithParam<int> {};

TEST_P(Degrades, AndGoesOnToTheEnd) {
  const stability::Case c = stability::stabilityCase(GetParam());
  const stability::Outcome outcome = stability::run(c);
  EXPECT_NE(outcome.kind, stability::Outcome::Kind::Stopped) << outcome.said << "\n" << describe(c);
  for (const std::string& violation : outcome.violations) ADD_FAILURE() << violation << "\n" << describe(c);
}

INSTANTIATE_TEST_SUITE_P(OnceStopped, Degrades,
                         testing::Values(237, 435, 61, 239, 218, 43, 569, 891, 1146, 1151));

}  // namespace
}  // namespace rubble::test
