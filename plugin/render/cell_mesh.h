// The drawn mesh of one body, without GL: corners packed for the GPU, and which triangles need drawing. A
// triangle between two cells that are drawn joined lies inside the solid and is left out, so an intact object
// draws its surface only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/weights.h"
#include "rubble/asset.h"

namespace rubble::render {

/// Layout of a vertex attribute record: RUBBLE_CORNER_ATTRIBUTE, RUBBLE_NORMAL_ATTRIBUTE.
struct PackedCorner {
  std::uint32_t vertexAndOwner;  ///< cell vertex * 4 + place of the owner among its elements
  std::uint32_t normal;          ///< signed 10-10-10, and 1 in the upper two bits on fracture faces
};

/// Layout of RUBBLE_CELL_VERTICES_BUFFER.
struct PackedVertex {
  std::array<float, 4> position;
  std::array<std::uint32_t, 4> elements;
};

/// Triangles of a coarse cell.
inline constexpr std::uint32_t kCoarseTriangles = 8;

class CellMesh {
 public:
  explicit CellMesh(const Asset& asset);

  std::span<const PackedCorner> corners() const { return m_corners; }
  std::span<const PackedVertex> vertices() const { return m_vertices; }
  /// All triangles, grouped by cell as in the asset (for debris).
  std::span<const std::array<std::uint32_t, 3>> triangles() const { return m_triangles; }

  /// Eight triangles a cell, the octahedron of its outermost corners: what a piece of debris of a few pixels
  /// is drawn with.
  std::span<const std::array<std::uint32_t, 3>> coarseTriangles() const { return m_coarse; }
  /// Factor that gives a cell's octahedron the volume of the cell, about 1.3.
  float coarseScale(std::size_t element) const { return m_coarseScales[element]; }

  /// Triangles to draw: of living cells, on the solid's surface or on a face whose two sides have parted.
  void visible(std::span<const CellMask> masks, std::span<const ElementPose> poses,
               std::vector<std::array<std::uint32_t, 3>>& out) const;

 private:
  std::uint32_t corner(const Asset& asset, std::uint32_t assetCorner, bool inner);
  void addCoarse(const Asset& asset, std::uint32_t element,
                 std::span<const std::array<std::uint32_t, 3>> triangles);
  std::uint16_t placesAcross(const Asset& asset, std::uint32_t triangle, std::uint32_t element) const;
  bool isJoined(std::size_t triangle, std::span<const CellMask> masks) const;

  std::vector<PackedCorner> m_corners;
  std::vector<PackedVertex> m_vertices;
  std::vector<std::array<std::uint32_t, 3>> m_triangles;
  std::vector<std::array<std::uint32_t, 3>> m_coarse;
  std::vector<float> m_coarseScales;
  std::vector<std::uint32_t> m_owners;  // element of each triangle
  /// Nibble a corner: place of the element behind the face at that corner's vertex.
  std::vector<std::uint16_t> m_placesAcross;
  std::array<std::vector<std::uint32_t>, 2> m_cornerOf;  // while building: asset corner -> outer, inner copy
};

}  // namespace rubble::render
