// What a timing was made on.
#pragma once

#include <string>

namespace rubble::demo {

/// Processor, compiler and kind of build in one line: "an Intel Xeon ..., g++ 12.2.0, release".
std::string machineName();

}  // namespace rubble::demo
