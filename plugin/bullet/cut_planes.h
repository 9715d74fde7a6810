// Planes by which a piece of a solid may be cut.
#pragma once

#include <span>
#include <vector>

#include "bullet/convex_piece.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct FacePlane {
  CutPlane plane;
  double area = 0;  ///< of the solid's faces in it [m^2]
};

/// Of the solid's own flat faces, the largest first.
std::vector<FacePlane> facePlanesOf(const CutSolid& solid);

/// Those of `faces` that cross the piece, and planes across its axes and the asset's.
std::vector<FacePlane> planesFor(const CutSolid& solid, std::span<const FacePlane> faces,
                                 const ConvexPiece& piece);

RUBBLE_ABI_END
}  // namespace rubble::bullet
