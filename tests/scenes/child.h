// Runs a program and gathers what it says.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

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

/// Of the programs that the tests run instead of the person's own; goes away with this program.
inline const std::filesystem::path& childCache() {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      std::string pattern = (std::filesystem::temp_directory_path() / "rubble_cache_XXXXXX").string();
      path = mkdtemp(pattern.data());
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

/// `command` is read by the shell; its streams are kept in `folder`. Cooked assets go to childCache().
inline ChildResult runChild(const std::string& command, const std::filesystem::path& folder) {
  const auto read = [](const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  const std::filesystem::path out = folder / "stdout.txt", error = folder / "stderr.txt";
  const int status = std::system(("export XDG_CACHE_HOME=" + childCache().string() + "; " + command + " >" +
                                  out.string() + " 2>" + error.string())
                                     .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(error)};
}

}  // namespace rubble::test
