// The same case in stock Bullet: where Rubble has a body that can break, a rigid box of its size, mass,
// friction and restitution; the same ground, impactor, ticks and happening. Judged alike: numbers are finite,
// and no more energy is held than was put in, by the same tolerance.
#pragma once

#include <string>

#include "demo/stability/case.h"

namespace rubble::stability {

struct StockOutcome {
  std::string violation;  ///< the first; empty: stable
  int ticks = 0;
  double energyPut = 0;  ///< [J], at the end
  double energyHeld = 0;
};

/// Over at most so many ticks, and no longer than a run of Rubble may be.
StockOutcome runStock(const Case& c, int ticks);

}  // namespace rubble::stability
