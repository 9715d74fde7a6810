// A piece of a solid that is cut into convex parts.
#pragma once

#include <cstdint>
#include <vector>

#include "bullet/convex_cut.h"
#include "bullet/convex_hull.h"
#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// What is cut, and its size.
struct CutSolid {
  explicit CutSolid(const Asset& of);
  const Asset& asset;
  double diagonal;  ///< [m]
  double nearness;  ///< what is nearer to a plane is on it [m]
  double volume;    ///< [m^3]
};

struct ConvexPiece {
  CutSurface surface;
  std::vector<CutPlane> borders;  ///< it is below all of them
  std::vector<std::uint32_t> elements;
  double volume = 0;  ///< of these [m^3]
  ConvexHull hull;
  bool done = false;  ///< no cut helps
  double excess() const { return hull.volume - volume; }
};

ConvexPiece wholePiece(const CutSolid& solid);

/// Volume and hull, of the points that matter for its volume.
void setHull(const CutSolid& solid, ConvexPiece& piece);
/// All that the hull may have as corners.
std::vector<Eigen::Vector3d> outlineOf(const CutSolid& solid, const ConvexPiece& piece);

/// Corners of the piece where `plane` and two of its borders meet within the solid: no triangle of the
/// surface has them.
void addInnerCorners(const CutSolid& solid, const std::vector<CutPlane>& borders, const CutPlane& plane,
                     std::vector<Eigen::Vector3d>& corners);

RUBBLE_ABI_END
}  // namespace rubble::bullet
