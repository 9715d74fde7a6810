// Wall time in milliseconds.
#pragma once

#include <chrono>
#include <utility>

namespace rubble::base {

class Stopwatch {
 public:
  /// Time since it was made or last asked for a lap [ms].
  double lap() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(m_start, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point m_start = Clock::now();
};

/// Adds the time of a scope to a sum [ms].
class ScopeTimer {
 public:
  explicit ScopeTimer(double& milliseconds) : m_sum(milliseconds) {}
  ~ScopeTimer() { m_sum += m_watch.lap(); }
  ScopeTimer(const ScopeTimer&) = delete;
  ScopeTimer& operator=(const ScopeTimer&) = delete;

 private:
  double& m_sum;
  Stopwatch m_watch;
};

}  // namespace rubble::base
