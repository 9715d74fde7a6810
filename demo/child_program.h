// Other programs, run to their end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rubble::demo {

struct Ended {
  int status = 0;     ///< as waitpid() tells
  std::string error;  ///< the end of what it said on stderr
};

/// Runs a program, found by the PATH, in `folder` to its end; nothing when there is no such program. No
/// shell: names of files need no quoting. Throws MachineError.
std::optional<Ended> runProgram(const std::filesystem::path& folder, std::vector<std::string> arguments);

/// Why it failed, in its own last words; empty when it did not.
std::string problemOf(const Ended& ended);

}  // namespace rubble::demo
