// What a run of a scene leaves in the few numbers by which runs are compared.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "demo/scene.h"

namespace rubble::demo {

struct SceneQuantity {
  std::string name;  ///< with its unit, "exit speed, m/s"
  double value = 0;
  bool inError = true;  ///< false: for readers alone
};

struct SceneOutcome {
  std::vector<SceneQuantity> quantities;  ///< the same names in the same order for every run of a scene
  double processorSeconds = 0;            ///< of the steps alone
  double simulatedSeconds = 0;
};

/// Runs all frames without pictures and dust grid; `shown` gets the share done, 0 to 1, after each. Throws
/// InputError when the scene is refused, RunStopped.
SceneOutcome runToEnd(const Scene& scene, const std::function<void(double)>& shown = {});

/// Root mean square of (found - expected) / expected over all quantities that are in the error, of which
/// there must be some. No expected value may be 0.
double relativeDifference(std::span<const SceneQuantity> found, std::span<const SceneQuantity> expected);

}  // namespace rubble::demo
