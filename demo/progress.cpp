#include "demo/progress.h"

#include <unistd.h>

#include <cmath>
#include <iostream>

namespace rubble::demo {
namespace {

constexpr std::chrono::milliseconds kRenewal{100};  // faster than this nobody reads

std::string minutes(double seconds) {
  const long whole = std::lround(seconds);
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

}  // namespace

Progress::Progress(std::string label) : m_label(std::move(label)), m_terminal(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (m_lineOpen) std::cerr << '\n';
}

void Progress::show(double share, const std::string& what) {
  if (m_terminal) {
    showOnTerminal(share, what);
  } else {
    showInLog(share, what);
  }
}

void Progress::showOnTerminal(double share, const std::string& what) {
  const Clock::time_point now = Clock::now();
  if (share < 1 && now - m_shown < kRenewal) return;
  m_shown = now;
  const double elapsed = std::chrono::duration<double>(now - m_start).count();
  const std::string left = share > 0 ? ", " + minutes(elapsed * (1 - share) / share) + " left" : "";
  constexpr const char* kBackAndClear = "\r\033[K";
  std::cerr << kBackAndClear << m_label << ": " << what << ", " << std::lround(100 * share) << " %" << left
            << std::flush;
  m_lineOpen = true;
}

void Progress::showInLog(double share, const std::string& what) {
  const int tenths = int(10 * share);
  if (tenths <= m_tenths) return;
  m_tenths = tenths;
  std::cerr << m_label << ": " << what << ", " << 10 * tenths << " %\n";
}

}  // namespace rubble::demo
