// Processor time of this process: what others do on the machine meanwhile is left out.
#pragma once

#include <ctime>

namespace rubble::demo {

/// Of all its threads, since some beginning [s].
inline double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace rubble::demo
