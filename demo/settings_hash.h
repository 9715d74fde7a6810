// What measured numbers depend on, in short.
#pragma once

#include <span>
#include <string>

#include "demo/scene.h"
#include "rubble/version.h"

namespace rubble::demo {

/// Of every key of every scene but camera and light, and of the version of the solver, of the debris and of
/// the emitted dust; as 16 hexadecimal digits.
std::string settingsHash(std::span<const Scene> scenes, std::span<const SolverVersion> versions);

}  // namespace rubble::demo
