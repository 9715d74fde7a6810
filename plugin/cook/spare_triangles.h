// Triangles of a soup that no closed surface has.
#pragma once

#include <cstddef>

#include "cook/soup.h"

namespace rubble::cooking {

/// Drops triangles with a corner twice, and those without area where that leaves fewer edges open or of more
/// than two triangles. Returns how many.
std::size_t dropFlat(Soup& soup);

/// Drops triangles that have the corners of another one and turn the same way. Returns how many.
std::size_t dropCopies(Soup& soup);

/// Drops triangles that have the corners of another one. Of those that turn the same way one is kept. Of as
/// many either way none is where what is around them is closed without them, as at a wall within the solid;
/// else one. Returns how many.
std::size_t dropDoubled(Soup& soup);

}  // namespace rubble::cooking
