// Which closed surfaces of a soup are to be united with which.
#pragma once

#include <cstdint>
#include <vector>

#include "cook/crossings.h"
#include "cook/shells.h"

namespace rubble::cooking {

/// Shells that hang together by crossings or as cavities.
struct Heap {
  std::vector<std::uint32_t> shells;
  std::vector<bool> isTurned;  ///< a solid that was inwards
  std::vector<bool> isCavity;  ///< of another shell of the heap
  std::size_t solids = 0;
};

/// Those of two solids and more. Shells touch, cross or miss each other by a rounding; those that pass
/// through themselves are in none.
std::vector<Heap> findHeaps(const Soup& soup, const Shells& shells, const std::vector<Crossing>& crossings);

/// The triangles of a heap, solids turned outwards, cavities inwards.
struct HeapSoup {
  Soup soup;
  std::vector<std::uint32_t> shells;  ///< of triangles, from 0 within the heap
};

HeapSoup soupOf(const Heap& heap, const Soup& soup, const Shells& shells);

}  // namespace rubble::cooking
