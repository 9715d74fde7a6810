// What the library warns of in a test. Warnings say that something asked for is not done, so a test that does
// not expect one fails with it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rubble/error.h"

namespace rubble::test {

/// Fails the running test with every warning; information is left out.
inline LogFunction strictLog() {
  return [](LogLevel level, const std::string& line) {
    if (level == LogLevel::Warning) ADD_FAILURE() << "the library warns: " << line;
  };
}

/// For a test that expects warnings: keeps them, and fails the test at its end if some were not asked for.
class ExpectedWarnings {
 public:
  ExpectedWarnings() = default;
  ~ExpectedWarnings() {
    for (const std::string& line : m_lines) ADD_FAILURE() << "the library also warns: " << line;
  }
  ExpectedWarnings(const ExpectedWarnings&) = delete;
  ExpectedWarnings& operator=(const ExpectedWarnings&) = delete;

  /// A log to hand in; this object must outlive its calls.
  LogFunction log() {
    return [this](LogLevel level, const std::string& line) {
      if (level == LogLevel::Warning) m_lines.push_back(line);
    };
  }
  /// How many warnings so far hold `text`; they are asked for now.
  int take(const std::string& text) {
    return int(std::erase_if(m_lines,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; }));
  }

 private:
  std::vector<std::string> m_lines;
};

}  // namespace rubble::test
