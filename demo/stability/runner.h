// Runs one case through the public interface and judges it by the library's promise: for any finite input a
// step returns a finite and bounded state with no more energy than was put in, or the case is refused when it
// is loaded, or the run stops and says why.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "demo/stability/case.h"

namespace rubble::stability {

inline constexpr int kMostTicks = 120;
inline constexpr double kLongest = 1;  ///< of a run [s]
/// Before this tick the case's happening happens.
inline constexpr int kHappeningTick = 3;

struct Outcome {
  enum class Kind {
    Stable,
    Degraded,  ///< to the end, and a warning said what was not done as asked
    Refused,   ///< by rubble::Error when it was loaded
    Stopped    ///< Destruction::failure() said why
  };
  Kind kind = Kind::Stable;
  std::string said;  ///< the first warning, the refusal or the failure
  std::vector<std::string> violations;
  int ticks = 0;
  double work = 0;       ///< substeps times elements
  double energyPut = 0;  ///< [J], at the end
  double energyHeld = 0;
};

const char* nameOf(Outcome::Kind kind);

/// Held energy may be above what was put in by this share of the most that was put in: the bar of the
/// library's own alarm, for what long ticks and Bullet's own fixing of positions bring.
inline constexpr double kEnergyTolerance = 0.05;

/// `trace`, if any, gets a line about each tick.
Outcome run(const Case& c, const std::function<void(const std::string&)>& trace = {});

}  // namespace rubble::stability
