// Times a swing by when it goes through its still place downwards.
#pragma once

#include <cmath>

namespace rubble::demo {

class PeriodTimer {
 public:
  /// `still` is what a sinking thing sinks by at rest; so many periods are timed.
  PeriodTimer(double still, int periods) : m_still(still), m_periods(periods) {}

  /// How far it has sunk at a time [s], in rising order. True when all have been timed.
  bool add(double time, double sink) {
    if (m_sink < m_still && sink >= m_still) {
      const double at = time - (sink - m_still) / (sink - m_sink) * (time - m_time);
      if (m_crossings == 0) m_first = at;
      if (m_crossings == m_periods) m_period = (at - m_first) / m_periods;
      ++m_crossings;
    }
    m_time = time;
    m_sink = sink;
    return m_crossings > m_periods;
  }
  /// Mean [s]; not finite: there were too few.
  double period() const { return m_period; }

 private:
  double m_still;
  int m_periods;
  double m_time = 0, m_sink = 0;
  int m_crossings = 0;
  double m_first = 0, m_period = std::nan("");
};

}  // namespace rubble::demo
