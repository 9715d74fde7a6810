// A solid that is not convex as few convex parts.
#pragma once

#include <vector>

#include "bullet/convex_hull.h"
#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Cells, those at the borders cut by planes, in groups whose hulls fit the solid. The hulls do not overlap.
struct ConvexParts {
  std::vector<ConvexHull> hulls;  ///< in the asset's frame
  double excess = 0;              ///< sum of the hulls' volumes beyond the solid's, as a share of that
};

/// The least parts that are found with an excess of at most `enough`, else `most` of them. A body's asset
/// gives the same parts in every run.
ConvexParts convexParts(const Asset& asset, double enough, int most);

RUBBLE_ABI_END
}  // namespace rubble::bullet
