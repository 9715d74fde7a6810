// Cells cut into several pieces by a slot or a thin wall: which piece holds the site.
#pragma once

#include <vector>

#include "cook/restricted_voronoi.h"

namespace rubble::cooking {

/// To which piece of its cell each part of a cell's mesh belongs: 0 is the one that holds the site, others
/// count from 1 through all cells. Those carry no springs and no anchors, which would tie elements together
/// through a gap.
struct SitePieces {
  std::vector<std::uint32_t> polygons;        ///< one a surface polygon
  std::vector<std::uint32_t> trianglesFirst;  ///< one a cap triangle, as part of the cap's first cell
  std::vector<std::uint32_t> trianglesSecond;
  std::vector<std::uint32_t> foreign;  ///< the cell of piece k + 1
};

SitePieces findSitePieces(const RestrictedVoronoi& diagram);

}  // namespace rubble::cooking
