// Runs a program and gathers what it says.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace rubble::test {

struct ChildResult {
  int exitCode = -1;  ///< -1: it did not end by itself
  std::string out, error;
};

/// `command` is read by the shell; its streams are kept in `folder`.
inline ChildResult runChild(const std::string& command, const std::filesystem::path& folder) {
  const auto read = [](const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  const std::filesystem::path out = folder / "stdout.txt", error = folder / "stderr.txt";
  const int status = std::system((command + " >" + out.string() + " 2>" + error.string()).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(error)};
}

}  // namespace rubble::test
