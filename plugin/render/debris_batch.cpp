#include "render/debris_batch.h"

#include <algorithm>
#include <cmath>

#include "gl/error.h"
#include "shared/draw.h"

namespace rubble::render {
namespace {

// A piece whose radius is below this many pixels covers less than a fiftieth of one: leaving it out changes
// no picture.
constexpr float kSmallestPixels = 0.08f;
// Below this radius a piece is drawn with 8 triangles for 38: its corners are too near to each other to be
// told apart, and a software rasteriser pays 0.7 microseconds for each triangle.
constexpr float kCoarsePixels = 3.0f;

void describeInstances(std::size_t rotation, std::size_t element) {
  glEnableVertexAttribArray(RUBBLE_PLACE_ATTRIBUTE);
  glVertexAttribFormat(RUBBLE_PLACE_ATTRIBUTE, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexAttribBinding(RUBBLE_PLACE_ATTRIBUTE, 1);
  glEnableVertexAttribArray(RUBBLE_ROTATION_ATTRIBUTE);
  glVertexAttribFormat(RUBBLE_ROTATION_ATTRIBUTE, 4, GL_FLOAT, GL_FALSE, GLuint(rotation));
  glVertexAttribBinding(RUBBLE_ROTATION_ATTRIBUTE, 1);
  glEnableVertexAttribArray(RUBBLE_ELEMENT_ATTRIBUTE);
  glVertexAttribIFormat(RUBBLE_ELEMENT_ATTRIBUTE, 1, GL_UNSIGNED_INT, GLuint(element));
  glVertexAttribBinding(RUBBLE_ELEMENT_ATTRIBUTE, 1);
  glVertexBindingDivisor(1, 1);
}

}  // namespace

DebrisBatch::DebrisBatch(const CellBody& body) : m_vertexArray(gl::makeVertexArray()) {
  m_instanceBuffer.upload(std::span<const std::byte>(), GL_STREAM_DRAW);
  m_commandBuffer.upload(std::span<const std::byte>(), GL_STREAM_DRAW);
  glBindVertexArray(m_vertexArray.id());
  glBindVertexBuffer(0, body.corners().id(), 0, sizeof(PackedCorner));
  describeCorners();
  glBindVertexBuffer(1, m_instanceBuffer.id(), 0, sizeof(Instance));
  describeInstances(offsetof(Instance, rotation), offsetof(Instance, element));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, body.allTriangles().id());
  glBindVertexArray(0);
  gl::checkGl("debris");
}

DebrisBatch::Detail DebrisBatch::detail(const DebrisInstance& piece, float cellRadius,
                                        const PieceView& view) {
  const float distance = std::max((piece.position - view.eye).norm(), 1e-6f);
  const float pixels = std::abs(piece.scale) * cellRadius * view.pixelsPerRadian / distance;
  if (pixels < kSmallestPixels) return Detail::None;
  return pixels < kCoarsePixels ? Detail::Coarse : Detail::Full;
}

// Instances of one mesh lie one behind the other. On entry m_next[mesh + 1] is the number of instances of a
// mesh; afterwards it is where those of the next mesh begin.
void DebrisBatch::addCommands(const CellBody& body, Detail detail) {
  const bool coarse = detail == Detail::Coarse;
  const std::size_t firstMesh = coarse ? body.elementCount() : 0;
  for (std::uint32_t e = 0; e < body.elementCount(); ++e) {
    const Cell& cell = body.cells()[e];
    const std::uint32_t begin = m_next[firstMesh + e], pieces = m_next[firstMesh + e + 1];
    const std::uint32_t triangles = coarse ? kCoarseTriangles : cell.outerTriangles + cell.innerTriangles;
    const std::uint32_t first =
        coarse ? body.firstCoarseTriangle() + kCoarseTriangles * e : cell.firstTriangle;
    if (pieces > 0) m_commands.push_back({3 * triangles, pieces, 3 * first, 0, begin});
    m_triangles += std::size_t{triangles} * pieces;
    m_next[firstMesh + e + 1] += begin;
  }
}

void DebrisBatch::prepare(const CellBody& body, const PieceView& view) {
  const std::size_t elements = body.elementCount();
  m_tooSmall = 0;
  m_triangles = 0;
  m_commands.clear();
  m_details.resize(m_pieces.size());
  m_next.assign(2 * elements + 1, 0);
  const auto meshOf = [&](std::size_t piece) {
    return m_pieces[piece].element + (m_details[piece] == Detail::Coarse ? elements : 0);
  };
  for (std::size_t i = 0; i < m_pieces.size(); ++i) {
    m_details[i] = detail(m_pieces[i], body.cellRadius(m_pieces[i].element), view);
    if (m_details[i] == Detail::None) {
      ++m_tooSmall;
    } else {
      ++m_next[meshOf(i) + 1];
    }
  }
  addCommands(body, Detail::Full);
  addCommands(body, Detail::Coarse);
  m_instances.resize(m_pieces.size() - m_tooSmall);
  for (std::size_t i = 0; i < m_pieces.size(); ++i) {
    if (m_details[i] == Detail::None) continue;
    const DebrisInstance& piece = m_pieces[i];
    const float enlarged = m_details[i] == Detail::Coarse ? body.coarseScale(piece.element) : 1.f;
    m_instances[m_next[meshOf(i)]++] = {piece.position, piece.scale * enlarged, piece.orientation.coeffs(),
                                        piece.element};
  }
  m_instanceBuffer.upload(std::span<const Instance>(m_instances), GL_STREAM_DRAW);
  m_commandBuffer.upload(std::span<const Command>(m_commands), GL_STREAM_DRAW);
}

void DebrisBatch::draw(const CellBody& body) const {
  if (m_commands.empty()) return;
  body.bindMesh();
  glBindVertexArray(m_vertexArray.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, m_commandBuffer.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, GLsizei(m_commands.size()), 0);
}

}  // namespace rubble::render
