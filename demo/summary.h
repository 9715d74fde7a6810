// The table that ends a run.
#pragma once

#include <ostream>

#include "demo/recorder.h"

namespace rubble::demo {

void printSummary(std::ostream& out, const Summary& summary);

}  // namespace rubble::demo
