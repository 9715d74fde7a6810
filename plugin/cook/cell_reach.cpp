#include "cook/cell_reach.h"

#include <algorithm>
#include <cmath>

namespace rubble::cooking {

double farthestCorner(const RestrictedVoronoi& diagram) {
  double squared = 0;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell)
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      for (const std::uint32_t v : {a, b, c})
        squared = std::max(squared, (diagram.vertices[v] - diagram.sites[cell]).squaredNorm());
    });
  return std::sqrt(squared);
}

}  // namespace rubble::cooking
