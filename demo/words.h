// The library's messages in the words of a scene.
#pragma once

#include <string>

#include "rubble/error.h"

namespace rubble::demo {

/// Bodies become objects, which the library counts in the scene's order, and its fields the scene's keys:
/// youngsModulus is youngs_modulus.
std::string inWordsOfTheScene(std::string text);
/// A log that says them so; empty when `log` is.
LogFunction inWordsOfTheScene(const LogFunction& log);

}  // namespace rubble::demo
