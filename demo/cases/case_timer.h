// Counts what the steps of a case take that has no world of Bullet's.
#pragma once

#include "demo/processor_time.h"
#include "demo/report_case.h"

namespace rubble::demo {

class CaseTimer {
 public:
  /// Runs a step of that length [s]; what is outside of it is not counted.
  template <class Step>
  void time(double seconds, Step&& step) {
    const double start = processorTime();
    step();
    m_processorSeconds += processorTime() - start;
    m_simulatedSeconds += seconds;
  }
  /// Of all steps so far, with this error.
  CaseOutcome outcome(double error) const { return {error, m_processorSeconds, m_simulatedSeconds}; }

 private:
  double m_processorSeconds = 0, m_simulatedSeconds = 0;
};

}  // namespace rubble::demo
