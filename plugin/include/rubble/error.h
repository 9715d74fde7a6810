// The one exception type of the library, and its log. The library never prints and never exits.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace rubble {

/// Thrown for bad definitions, meshes and files, before anything is built. `what()` is one line that says
/// where, what is wrong and what is allowed.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class LogLevel { Info, Warning };

/// Receives one line without a line end. Called on the thread that made the call into the library.
using LogFunction = std::function<void(LogLevel, const std::string&)>;

/// Called on long work with the share done in [0, 1] and the name of the present stage.
using ProgressFunction = std::function<void(double, const char*)>;

}  // namespace rubble
