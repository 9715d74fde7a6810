// Progress of long work on stderr: one line that renews itself on a terminal, a few plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace rubble::demo {

class Progress {
 public:
  /// `label` says what is going on, e.g. "wall".
  explicit Progress(std::string label);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the work done, 0 to 1, and what is being done, e.g. "frame 12 of 180".
  void show(double share, const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  void showOnTerminal(double share, const std::string& what);
  void showInLog(double share, const std::string& what);

  std::string m_label;
  bool m_terminal;
  Clock::time_point m_start = Clock::now();
  Clock::time_point m_shown;
  int m_tenths = -1;
  bool m_lineOpen = false;
};

}  // namespace rubble::demo
