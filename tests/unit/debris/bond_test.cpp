#include "debris/bond.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rubble/error.h"

namespace rubble::test {
using namespace debris;
namespace {

constexpr double kWorkIndex = 13.5;  // kWh/t, concrete-like rock
constexpr double kModulus = 0.7;

TEST(Bond, MillsAKilogramToSeventeenMillimetresForThreeKilojoules) {
  const double constant = bondConstant(kWorkIndex, 1, kModulus, 1);
  EXPECT_NEAR(constant / std::sqrt(0.017), 3.09e3, 5);  // three digits of the reference value
}

TEST(Bond, AgreesWithBondsOwnUnits) {
  // Bond 1952: W = 10 Wi / sqrt(F80 in micrometres) kWh per tonne, 1 kWh/t = 3600 J/kg. The sieve that passes
  // 80 % of a Gaudin-Schuhmann distribution of radii: 0.8 = (R / R_max)^m, opening 2 R.
  const double maximum = 0.004;
  const double micrometres = 2 * maximum * std::pow(0.8, 1 / kModulus) * 1e6;
  const double joulesPerKilogram = 10 * kWorkIndex / std::sqrt(micrometres) * 3600;
  const double mass = 0.0713, efficiency = 3e-3;
  const double constant = bondConstant(kWorkIndex, efficiency, kModulus, mass);
  EXPECT_NEAR(constant / std::sqrt(maximum) / (efficiency * mass * joulesPerKilogram), 1, 1e-12);
}

TEST(Bond, LargestGrainFallsWithTheSquareOfTheEnergy) {
  const double constant = bondConstant(kWorkIndex, 1e-3, kModulus, 0.1);
  EXPECT_NEAR(maxRadius(constant, 2.0) / maxRadius(constant, 1.0), 0.25, 1e-15);
  EXPECT_NEAR(maxRadius(constant, constant), 1, 1e-15);
}

TEST(Bond, NoEnergyLeavesGrainsOfAnySize) {
  for (const double energy : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(maxRadius(1, energy), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(isCrushed(maxRadius(1, energy), 0.017));
  }
}

TEST(Bond, ElementIsCrushedJustAboveItsCrushingEnergy) {
  const double constant = bondConstant(kWorkIndex, 2e-3, kModulus, 0.07), radius = 0.017;
  const double energy = crushingEnergy(constant, radius);
  EXPECT_FALSE(isCrushed(maxRadius(constant, energy * (1 - 1e-9)), radius));
  EXPECT_TRUE(isCrushed(maxRadius(constant, energy * (1 + 1e-9)), radius));
}

TEST(Bond, RefusesConstantsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(bondConstant(bad, 1, 0.7, 1), Error);
    EXPECT_THROW(bondConstant(13.5, bad, 0.7, 1), Error);
    EXPECT_THROW(bondConstant(13.5, 1, bad, 1), Error);
    EXPECT_THROW(bondConstant(13.5, 1, 0.7, bad), Error);
  }
  EXPECT_THROW(bondConstant(13.5, 1, 1.1, 1), Error);
}

}  // namespace
}  // namespace rubble::test
