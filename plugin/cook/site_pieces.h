// Cells cut into several pieces by a slot or a thin wall: which piece holds the site.
#pragma once

#include <vector>

#include "cook/restricted_voronoi.h"

namespace rubble::cooking {

/// Whether parts of the cells' meshes belong to the piece that holds the cell's site. The other pieces stay
/// with their owner as geometry, but carry no springs and no anchors: those would tie elements together
/// through a gap.
struct SitePieces {
  std::vector<bool> polygons;        ///< one a surface polygon
  std::vector<bool> trianglesFirst;  ///< one a cap triangle, as part of the cap's first cell
  std::vector<bool> trianglesSecond;
};

SitePieces findSitePieces(const RestrictedVoronoi& diagram);

}  // namespace rubble::cooking
