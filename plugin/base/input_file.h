// Files that are read whole: what may be opened at all, and errors that name the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "rubble/error.h"

namespace rubble::base {

[[noreturn]] inline void refuseFile(const std::filesystem::path& file, const std::string& what) {
  throw Error(file.string() + ": " + what);
}

/// Size [bytes] of a file whose bytes can be read at all. Asked before it is opened: opening a pipe waits for
/// a writer. Throws rubble::Error that says what the file is instead of `wanted`, e.g. "an asset file".
std::uint64_t inputSize(const std::filesystem::path& file, const std::string& wanted);

}  // namespace rubble::base
