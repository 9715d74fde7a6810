// The program from outside, in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "scenes/child.h"
#include "scenes/scene_file.h"

namespace rubble::test {

class Program : public testing::Test {
 protected:
  ChildResult runThatMayWarn(const std::string& arguments) {
    return runChild("cd " + m_folder.path().string() + " && " RUBBLE_PROGRAM " " + arguments,
                    m_folder.path());
  }
  ChildResult run(const std::string& arguments) {
    ChildResult result = runThatMayWarn(arguments);
    EXPECT_EQ(result.error.find("rubble: warning: "), std::string::npos) << arguments << '\n' << result.error;
    return result;
  }
  // An error is one line, after what progress has said; nothing else is printed.
  void expectError(const ChildResult& result, int exitCode, const std::string& words) {
    EXPECT_EQ(result.exitCode, exitCode) << result.error;
    const auto start = result.error.rfind("rubble: error: ");
    ASSERT_NE(start, std::string::npos) << result.error;
    EXPECT_EQ(lines(result.error.substr(start)), 1) << result.error;
    EXPECT_NE(result.error.find(words, start), std::string::npos) << result.error;
    EXPECT_EQ(result.out, "");
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(m_folder.path() / name); }
  static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

  TestFolder m_folder;
};

}  // namespace rubble::test
