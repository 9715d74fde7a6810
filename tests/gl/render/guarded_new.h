// A heap of the test program in which every block made by operator new ends in a guard.
#pragma once

#include <cstddef>

namespace rubble::test {

/// Blocks given back so far whose guard had been written to.
std::size_t overrunBlocks();

}  // namespace rubble::test
