// Which source the program was built from.
#pragma once

#include <string>

namespace rubble::demo {

/// Short hash of the commit, with a + where files differed from it; "unknown" outside of a working copy.
std::string commitName();

}  // namespace rubble::demo
