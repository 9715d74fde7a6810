// Bad input of the person at the keyboard, as opposed to a failure of the program.
#pragma once

#include <stdexcept>
#include <string>

namespace rubble::demo {

/// The text with everything that could end a line taken out.
inline std::string oneLine(std::string text) {
  for (char& c : text)
    if (std::uint8_t(c) < ' ') c = ' ';
  return text;
}

/// One line `FILE: KEY: what is wrong, what is allowed`; ends the program with exit code 2.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& key, const std::string& problem)
      : std::runtime_error(oneLine(file + ": " + (key.empty() ? "" : key + ": ") + problem)) {}
  using std::runtime_error::runtime_error;
};

/// The run was stopped because its numbers can no longer be trusted; ends the program with exit code 3.
class RunStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rubble::demo
