#include "debris/bond.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "rubble/error.h"

namespace rubble::debris {

namespace {

// Bond: w = 10 Wi / sqrt(d80 in micrometres) kWh/t. With 1 kWh/t = 3600 J/kg and 1 m = 1e6 micrometres that
// is 10 x 3600 / 1000 = 36 Wi / sqrt(d80 in metres) J/kg.
constexpr double kBondUnits = 36;
// The passing share that Bond's sieve size is defined by.
constexpr double kPassing = 0.8;

void requirePositive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(std::string("bond: ") + name + " is " + std::to_string(value) + ", must be finite and > 0");
}

}  // namespace

double bondConstant(double workIndex, double crushEfficiency, double sizeModulus, double elementMass) {
  requirePositive(workIndex, "bondWorkIndex");
  requirePositive(crushEfficiency, "crushEfficiency");
  requirePositive(sizeModulus, "sizeModulus");
  requirePositive(elementMass, "element mass");
  if (sizeModulus > 1)
    throw Error("bond: sizeModulus is " + std::to_string(sizeModulus) + ", must be at most 1");
  const double sieve = 2 * std::pow(kPassing, 1 / sizeModulus);  // d80 / R_max
  return kBondUnits * crushEfficiency * workIndex * elementMass / std::sqrt(sieve);
}

double maxRadius(double bondConstant, double fractureEnergy) {
  assert(bondConstant > 0);
  if (!(fractureEnergy > 0)) return std::numeric_limits<double>::infinity();
  const double root = bondConstant / fractureEnergy;
  return root * root;
}

bool isCrushed(double maxRadius, double elementRadius) {
  return maxRadius < elementRadius;
}

double crushingEnergy(double bondConstant, double elementRadius) {
  assert(bondConstant > 0 && elementRadius > 0);
  return bondConstant / std::sqrt(elementRadius);
}

}  // namespace rubble::debris
