// Debris of one body: the pieces of one cell are instances of one command, all commands of the body one
// indirect draw. Pieces of a few pixels are drawn as the octahedron of their cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "render/cell_body.h"
#include "rubble/render.h"

namespace rubble::render {

/// What decides whether a piece is large enough to be seen.
struct PieceView {
  Eigen::Vector3f eye;    ///< [m]
  float pixelsPerRadian;  ///< in the middle of the picture
};

class DebrisBatch {
 public:
  explicit DebrisBatch(const CellBody& body);

  void clear() { m_pieces.clear(); }
  void add(const DebrisInstance& piece) { m_pieces.push_back(piece); }
  bool empty() const { return m_pieces.empty(); }

  /// Leaves out pieces too small to be seen, sorts the others by cell (keeping their order) and uploads.
  void prepare(const CellBody& body, const PieceView& view);
  /// One draw of all prepared pieces with the program in use.
  void draw(const CellBody& body) const;

  std::size_t drawn() const { return m_instances.size(); }
  std::size_t tooSmall() const { return m_tooSmall; }
  std::size_t triangles() const { return m_triangles; }

 private:
  struct Instance {  // attributes 2 to 4
    Eigen::Vector3f position;
    float scale;
    Eigen::Vector4f rotation;
    std::uint32_t element;
  };
  struct Command {  // layout of glMultiDrawElementsIndirect
    std::uint32_t count, instances, firstIndex;
    std::int32_t baseVertex;
    std::uint32_t baseInstance;
  };

  enum class Detail : std::uint8_t { None, Full, Coarse };
  static Detail detail(const DebrisInstance& piece, float cellRadius, const PieceView& view);
  void addCommands(const CellBody& body, Detail detail);

  std::vector<DebrisInstance> m_pieces;
  std::vector<Detail> m_details;      // by piece
  std::vector<std::uint32_t> m_next;  // by mesh (full cells, then coarse ones): place of its next instance
  std::vector<Instance> m_instances;
  std::vector<Command> m_commands;
  std::size_t m_tooSmall = 0;
  std::size_t m_triangles = 0;
  gl::VertexArrayName m_vertexArray;
  gl::Buffer m_instanceBuffer, m_commandBuffer;
};

}  // namespace rubble::render
