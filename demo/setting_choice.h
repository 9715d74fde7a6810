// `rubble run SCENE --error`: the cheapest setting that keeps an error, by the figures that are kept of the
// scene.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "demo/kept_settings.h"
#include "demo/scene.h"
#include "rubble/error.h"

namespace rubble::demo {

/// Of "2%" or "0.02". Throws InputError.
double parseErrorShare(const std::string& text);

/// That of least cost whose error is at most `error`; null: none is.
const KeptSetting* cheapestWithin(const KeptSettings& kept, double error);

/// The scene, as loadScene makes it of these, at the cheapest setting; says on `out` which and why, and warns
/// where the figures may no longer hold. Throws InputError when there are no figures of the scene, when no
/// setting kept the error, and when a change is of what is chosen.
Scene sceneWithin(double error, const std::string& nameOrPath, std::vector<Override> overrides,
                  const LogFunction& log, std::ostream& out);

}  // namespace rubble::demo
