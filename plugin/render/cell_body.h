// The GPU side of one body: corners, vertices, poses, masks, and the triangles that need drawing.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "render/cell_mesh.h"
#include "render/weights.h"
#include "rubble/render.h"

namespace rubble::render {

class CellBody {
 public:
  CellBody(const Asset& asset, CellJoining joining, const CellColours& colours);

  /// Throws rubble::Error when a span is too short or a living pose is not finite.
  void update(std::span<const ElementPose> poses, std::span<const std::uint8_t> springsIntact);
  /// One draw of all visible triangles with the program in use.
  void draw() const;

  std::size_t elementCount() const { return m_cells.size(); }
  std::size_t visibleTriangles() const { return m_visible.size(); }
  const CellColours& colours() const { return m_colours; }
  /// Box of the body where it was first placed: at its first update, or at rest before that.
  const Eigen::AlignedBox3f& firstBounds() const { return m_bounds; }

  // For debris, which draws single cells of this mesh.
  std::span<const Cell> cells() const { return m_cells; }
  float cellRadius(std::size_t element) const { return m_cellRadii[element]; }  ///< (3 V / 4 pi)^(1/3) [m]
  const gl::Buffer& corners() const { return m_corners; }
  /// All triangles, grouped by cell; behind them the coarse ones, kCoarseTriangles a cell.
  const gl::Buffer& allTriangles() const { return m_allTriangles; }
  std::uint32_t firstCoarseTriangle() const { return std::uint32_t(m_mesh.triangles().size()); }
  float coarseScale(std::size_t element) const { return m_mesh.coarseScale(element); }
  void bindMesh() const;  ///< rest centres and cell vertices

 private:
  void uploadMasks();
  void place(std::span<const ElementPose> poses);

  CellMesh m_mesh;
  CellWeights m_weights;
  CellColours m_colours;
  std::vector<Cell> m_cells;
  std::vector<float> m_cellRadii;
  std::size_t m_springs;
  Eigen::AlignedBox3f m_bounds;
  bool m_isPlaced = false;
  std::vector<std::uint8_t> m_alive;
  std::vector<std::array<std::uint32_t, 3>> m_visible;

  gl::VertexArrayName m_vertexArray;
  gl::Buffer m_corners, m_vertices, m_centres, m_poses, m_masks, m_triangles, m_allTriangles;
};

/// Declares the attributes of PackedCorner in the vertex array in use, from vertex buffer binding 0.
void describeCorners();

}  // namespace rubble::render
