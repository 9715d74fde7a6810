// Which way is out of closed surfaces within others.
#pragma once

#include <cstdint>
#include <vector>

#include "cook/shells.h"

namespace rubble::cooking {

/// Turns shells outwards that lie within none or an even number of others, and the rest inwards: they are
/// cavities. Shells of the same heap, of triangles heaps[t], keep which way they turn to each other;
/// kNoElement is no heap. Shells do not cross.
void turnOutwards(Soup& soup, const std::vector<std::uint32_t>& heaps);

}  // namespace rubble::cooking
