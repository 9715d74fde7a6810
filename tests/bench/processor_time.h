// Processor time of the calling thread: what others do on the machine meanwhile is left out.
#pragma once

#include <ctime>

namespace rubble::test {

/// Since some beginning [s].
inline double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// The same of all threads of the program together.
inline double allProcessorTime() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Adds the time of a scope to a sum [s].
class ScopeProcessorTime {
 public:
  explicit ScopeProcessorTime(double& seconds) : m_sum(seconds), m_start(processorTime()) {}
  ~ScopeProcessorTime() { m_sum += processorTime() - m_start; }
  ScopeProcessorTime(const ScopeProcessorTime&) = delete;
  ScopeProcessorTime& operator=(const ScopeProcessorTime&) = delete;

 private:
  double& m_sum;
  double m_start;
};

}  // namespace rubble::test
