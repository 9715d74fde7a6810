// A solid's surface cut by planes into pieces, and the points that their hulls need.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Below it normal . x < offset.
struct CutPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0;  ///< [m]
  double over(const Eigen::Vector3d& x) const { return normal.dot(x) - offset; }
};

/// What a point is to a hull.
enum class PointUse : std::uint8_t {
  Corner,
  Outline,  ///< on the face of a cut, between two corners of it
  Smooth,   ///< between others of a curved face, so near that the hull's volume hardly changes without it
  Flat,     ///< within a flat face: no hull needs it
};

/// Triangles of a surface, out of the solid.
struct CutSurface {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<PointUse> uses;           ///< one a point
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The outer surface of an asset's cells.
CutSurface outerSurface(const Asset& asset);

/// Where triangles cross a plane, and which of the points touch which side.
struct Crossings {
  static constexpr std::uint8_t kBelow = 1, kAbove = 2;
  std::vector<std::uint8_t> sides;       ///< one a point
  std::vector<Eigen::Vector3d> between;  ///< on both: corners
  std::vector<double> over;              ///< scratch: of each point [m]
  std::vector<std::uint8_t> ofPoint;     ///< scratch: its own side, none of what is on the plane
};

/// What lies nearer than `nearness` [m] to the plane is on it. A face that lies in the plane is on the side
/// of its solid.
void findCrossings(const CutSurface& surface, const CutPlane& plane, double nearness, Crossings& found);
/// The two halves, without the face between them.
std::array<CutSurface, 2> cutSurface(const CutSurface& surface, const CutPlane& plane, double nearness);

RUBBLE_ABI_END
}  // namespace rubble::bullet
