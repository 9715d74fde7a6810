// The corners and triangles of an asset, cell by cell: each is looked at once, for with 100000 elements they
// are most of 300 MB.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "base/asset_check.h"

namespace rubble::base {

/// What the triangles of one cell say of it.
struct CellShape {
  Eigen::AlignedBox3d box;  ///< grown by the rounding [m]
  double volume = 0;        ///< enclosed [m^3]
  double outerArea = 0, innerArea = 0;
  double volumeSlack = 0, areaSlack = 0;  ///< what the rounding of the vertices may have changed
};

/// Throws unless the normal has length 1.
void checkUnit(const Eigen::Vector3f& normal, const char* array, std::size_t at);

class CellWalk {
 public:
  /// Of an asset whose vertices and cells' ranges are right; `rounding` is that of AssetScale. The first
  /// cell's corners are looked for from `corner` on.
  CellWalk(const Asset& asset, double rounding, std::uint32_t corner = 0)
      : m_asset(asset), m_rounding(rounding), m_isUsed(asset.vertices.size(), 0), m_end(corner) {}

  /// Checks corners and triangles of a cell and measures it. To be called for cells in their order, one after
  /// the other.
  CellShape enter(std::uint32_t cell);
  /// Where the corners end that were looked at.
  std::uint32_t cornersEnd() const { return m_end; }
  /// Takes over what `next` has found, which began where this one has ended.
  void continueFrom(const CellWalk& next);
  /// Behind the last cell: checks corners of no cell, and that no vertex is without a corner.
  void finish();

 private:
  void checkCorner(std::uint32_t corner);
  void gatherCorners(std::uint32_t cell);
  Eigen::Vector3d placeOfOther(std::uint32_t corner, std::uint32_t cell, std::uint32_t triangle);

  const Asset& m_asset;
  double m_rounding;
  std::vector<std::uint8_t> m_isUsed;     // vertices, by a corner
  std::uint32_t m_first = 0, m_end = 0;   // the cell's corners, which stand together where the cook made them
  std::vector<Eigen::Vector3d> m_places;  // of these corners, from the element [m]; grows
};

}  // namespace rubble::base
