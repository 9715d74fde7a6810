// Corners of a soup that should be one.
#pragma once

#include <cstddef>

#include "cook/soup.h"

namespace rubble::cooking {

struct Welded {
  std::size_t before = 0;  ///< corners that were joined with others
  std::size_t after = 0;   ///< what they became
};

/// Joins vertices of open edges: all at exactly the same place, and where edges are open after that, those
/// nearer than `distance` [m]. The first of them keeps its place. Triangles may end up with a corner twice.
Welded weld(Soup& soup, double distance);

/// Cuts triangles at the vertices of open edges that lie, to `distance` [m], within an open side of theirs.
/// Returns the number of triangles cut; 0, and nothing is changed, where that closes no edge.
std::size_t splitAtCorners(Soup& soup, double distance);

}  // namespace rubble::cooking
