// Triangles of a soup that touch or cross.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cook/soup.h"

namespace rubble::cooking {

/// Two triangles of a soup that touch or cross, other than neighbours at what they share; the smaller first.
using Crossing = std::array<std::uint32_t, 2>;

/// All of a manifold soup, in order.
std::vector<Crossing> findCrossings(const Soup& soup);

/// Whether an edge of one goes through the inside of the other. Where triangles merely touch nothing is
/// amiss.
bool isPierced(const Soup& soup, const Crossing& crossing);

}  // namespace rubble::cooking
