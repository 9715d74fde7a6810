// `rubble report wall`: the error that remains, against the time it takes.
#pragma once

#include <filesystem>
#include <ostream>

#include "demo/scene.h"

namespace rubble::demo {

/// Runs the scene without pictures and dust, in float and double, at its substep and at a half and a quarter
/// of it. Prints a Markdown table and writes the same as SCENE.csv in
/// `folder` (empty: out/report). Throws InputError, RunStopped.
void reportSubsteps(const Scene& scene, std::filesystem::path folder, std::ostream& out);

}  // namespace rubble::demo
