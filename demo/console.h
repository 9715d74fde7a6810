// What the library tells, for a person at a console: its log and the progress of cooking.
#pragma once

#include "demo/world.h"

namespace rubble::demo {

/// Warnings to stderr; information is left out.
LogFunction consoleLog();

/// cookObjects with a line of progress on stderr.
Assets cookWithProgress(const Scene& scene, const CacheOptions& cache, const LogFunction& log = consoleLog());

}  // namespace rubble::demo
