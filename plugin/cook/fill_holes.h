// Holes of a surface, and what closes them.
#pragma once

#include <cstddef>
#include <vector>

#include "cook/soup.h"
#include "rubble/repair.h"

namespace rubble::cooking {

struct Hole {
  std::size_t edges = 0;
  double area = 0;  ///< of the triangles that fill it, or would; of its flat outline if none do [m^2]
};

struct Holes {
  std::vector<Hole> filled, tooLarge;
};

/// Whether CGAL takes all of a soup's triangles: not where two edges have the same ends.
bool isManifold(const Soup& soup);

/// Fills the holes of a manifold soup that the options allow.
Holes fillHoles(Soup& soup, const RepairOptions& options);

}  // namespace rubble::cooking
