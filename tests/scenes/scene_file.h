// Scene files that a test writes into a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace rubble::test {

/// A folder that goes away with the test.
class TestFolder {
 public:
  TestFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "rubble_test_XXXXXX").string();
    m_path = mkdtemp(pattern.data());
  }
  ~TestFolder() { std::filesystem::remove_all(m_path); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return m_path; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(m_path / name) << text;
    return (m_path / name).string();
  }

 private:
  std::filesystem::path m_path;
};

/// A small wall that a ball goes through: 128 elements, quick to cook and to simulate.
inline const char* const kSmallWall = R"({
  "frames": 5,
  "objects": [{"size": [0.5, 0.5, 0.08], "position": [0, 0.25, 0], "elements": 128, "anchor": [0, -1, 0],
               "regime": "elements"}],
  "impactors": [{"shape": "sphere", "radius": 0.1, "mass": 20, "position": [0, 0.25, -0.2], "velocity": [0, 0, 10]}],
  "statics": [{"shape": "plane"}],
  "dust": {"resolution": 16, "min": [-1, 0, -1], "max": [1, 1.5, 1]},
  "debris": {}
})";

}  // namespace rubble::test
