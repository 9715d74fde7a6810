// How far the solid is from its elements.
#pragma once

#include "cook/restricted_voronoi.h"

namespace rubble::cooking {

/// The largest distance of a cell's corner from the site of the cell [m].
double farthestCorner(const RestrictedVoronoi& diagram);

}  // namespace rubble::cooking
