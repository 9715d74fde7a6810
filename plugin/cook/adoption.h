// Pieces of cells on the far side of a gap find another cell.
#pragma once

#include "cook/restricted_voronoi.h"

namespace rubble::cooking {

/// Gives every piece of a cell that does not hold the cell's site to the cell it shares most face with,
/// through other such pieces if need be; the faces between them vanish. So each cell is of one piece, and
/// neighbours still share their vertices. Pieces of a part of the solid that holds no site at all stay with
/// their owners; those parts are listed in the diagram's `emptyParts`. Returns whether cells have changed.
bool adoptPieces(RestrictedVoronoi& diagram);

}  // namespace rubble::cooking
