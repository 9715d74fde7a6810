// A heap of closed parts as one surface of doubles.
#pragma once

#include <cstddef>

#include "cook/heaps.h"
#include "cook/unite_parts.h"

namespace rubble::cooking {

struct HeapUnion {
  United united;
  std::size_t pierced = 0;  ///< pairs of triangles that pass through each other
  std::size_t work = 0;     ///< triangles and crossings it was made of
};

/// The first that does not pass through itself, of corners as they are and moved to grids, or else the best.
HeapUnion unionOf(const HeapSoup& heap);

}  // namespace rubble::cooking
