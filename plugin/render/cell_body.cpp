#include "render/cell_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "gl/error.h"
#include "shared/draw.h"

namespace rubble::render {
namespace {

std::vector<ElementPose> restPoses(const Asset& asset) {
  std::vector<ElementPose> poses;
  poses.reserve(asset.elementCount());
  for (const Eigen::Vector3d& position : asset.positions) {
    poses.push_back({position.cast<float>(), 1, Eigen::Vector4f(0, 0, 0, 1)});
  }
  return poses;
}

}  // namespace

void describeCorners() {
  glEnableVertexAttribArray(RUBBLE_CORNER_ATTRIBUTE);
  glVertexAttribIFormat(RUBBLE_CORNER_ATTRIBUTE, 1, GL_UNSIGNED_INT, offsetof(PackedCorner, vertexAndOwner));
  glVertexAttribBinding(RUBBLE_CORNER_ATTRIBUTE, 0);
  glEnableVertexAttribArray(RUBBLE_NORMAL_ATTRIBUTE);
  glVertexAttribFormat(RUBBLE_NORMAL_ATTRIBUTE, 4, GL_INT_2_10_10_10_REV, GL_TRUE,
                       offsetof(PackedCorner, normal));
  glVertexAttribBinding(RUBBLE_NORMAL_ATTRIBUTE, 0);
}

CellBody::CellBody(const Asset& asset, CellJoining joining, const CellColours& colours)
    : m_mesh(asset),
      m_weights(asset, joining),
      m_colours(colours),
      m_cells(asset.cells),
      m_springs(asset.springs.size()),
      m_bounds(asset.bounds().cast<float>()),
      m_alive(asset.elementCount(), 1),
      m_vertexArray(gl::makeVertexArray()) {
  std::vector<Eigen::Vector4f> centres;
  centres.reserve(asset.elementCount());
  m_cellRadii.reserve(asset.elementCount());
  for (std::size_t e = 0; e < asset.elementCount(); ++e) {
    centres.emplace_back(asset.positions[e].x(), asset.positions[e].y(), asset.positions[e].z(), 0);
    m_cellRadii.push_back(float(std::cbrt(3 * asset.volumes[e] / (4 * std::numbers::pi))));
  }
  m_corners.upload(m_mesh.corners(), GL_STATIC_DRAW);
  m_vertices.upload(m_mesh.vertices(), GL_STATIC_DRAW);
  m_centres.upload(std::span<const Eigen::Vector4f>(centres), GL_STATIC_DRAW);
  std::vector<std::array<std::uint32_t, 3>> all(m_mesh.triangles().begin(), m_mesh.triangles().end());
  all.insert(all.end(), m_mesh.coarseTriangles().begin(), m_mesh.coarseTriangles().end());
  m_allTriangles.upload(std::span<const std::array<std::uint32_t, 3>>(all), GL_STATIC_DRAW);
  m_visible.reserve(m_mesh.triangles().size());

  const std::vector<ElementPose> poses = restPoses(asset);
  m_mesh.visible(m_weights.masks(), poses, m_visible);
  m_triangles.upload(std::span<const std::array<std::uint32_t, 3>>(m_visible), GL_DYNAMIC_DRAW);
  m_poses.upload(std::span<const ElementPose>(poses), GL_STREAM_DRAW);
  uploadMasks();

  glBindVertexArray(m_vertexArray.id());
  glBindVertexBuffer(0, m_corners.id(), 0, sizeof(PackedCorner));
  describeCorners();
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m_triangles.id());
  glBindVertexArray(0);
  gl::checkGl("a body");
}

void CellBody::uploadMasks() {
  // Read by the shader as words of two masks: an even count.
  std::vector<CellMask> masks(m_weights.masks().begin(), m_weights.masks().end());
  masks.resize(masks.size() + masks.size() % 2, 0);
  m_masks.upload(std::span<const CellMask>(masks), GL_DYNAMIC_DRAW);
}

void CellBody::update(std::span<const ElementPose> poses, std::span<const std::uint8_t> springsIntact) {
  if (poses.size() != m_cells.size()) {
    throw Error("Renderer::updateBody: " + std::to_string(poses.size()) + " poses for " +
                std::to_string(m_cells.size()) + " elements");
  }
  if (springsIntact.size() < m_springs) {
    throw Error("Renderer::updateBody: " + std::to_string(springsIntact.size()) + " spring states for " +
                std::to_string(m_springs) + " springs");
  }
  for (std::size_t e = 0; e < poses.size(); ++e) {
    if (poses[e].alive > 0 && !(poses[e].position.allFinite() && poses[e].rotation.allFinite())) {
      throw Error("Renderer::updateBody: the pose of element " + std::to_string(e) + " is not finite");
    }
  }
  bool aliveChanged = false;
  for (std::size_t e = 0; e < poses.size(); ++e) {
    const std::uint8_t alive = poses[e].alive > 0 ? 1 : 0;
    aliveChanged |= alive != m_alive[e];
    m_alive[e] = alive;
  }
  if (!m_isPlaced) place(poses);
  m_poses.upload(poses, GL_STREAM_DRAW);
  const bool masksChanged = m_weights.update(springsIntact, poses);
  if (masksChanged) {
    // Only what lies between the first and the last changed vertex.
    const std::size_t first = m_weights.changed().front(), last = m_weights.changed().back();
    m_masks.write(std::as_bytes(m_weights.masks().subspan(first, last + 1 - first)),
                  first * sizeof(CellMask));
  }
  if (masksChanged || aliveChanged) {
    m_mesh.visible(m_weights.masks(), poses, m_visible);
    m_triangles.upload(std::span<const std::array<std::uint32_t, 3>>(m_visible), GL_DYNAMIC_DRAW);
  }
}

void CellBody::place(std::span<const ElementPose> poses) {
  m_bounds.setEmpty();
  for (std::size_t e = 0; e < poses.size(); ++e) {
    if (poses[e].alive <= 0) continue;
    const Eigen::Vector3f reach = Eigen::Vector3f::Constant(m_cellRadii[e]);
    m_bounds.extend(Eigen::AlignedBox3f(poses[e].position - reach, poses[e].position + reach));
  }
  m_isPlaced = true;
}

void CellBody::bindMesh() const {
  m_centres.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_REST_CENTRES_BUFFER);
  m_vertices.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_CELL_VERTICES_BUFFER);
}

void CellBody::draw() const {
  if (m_visible.empty()) return;
  bindMesh();
  m_poses.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_POSES_BUFFER);
  m_masks.bindBase(GL_SHADER_STORAGE_BUFFER, RUBBLE_MASKS_BUFFER);
  glBindVertexArray(m_vertexArray.id());
  glDrawElements(GL_TRIANGLES, GLsizei(3 * m_visible.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace rubble::render
