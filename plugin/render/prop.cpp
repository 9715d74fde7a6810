#include "render/prop.h"

#include "gl/error.h"
#include "shared/draw.h"

namespace rubble::render {

Prop::Prop(const Shape& shape, const PropLook& look)
    : m_look(look), m_vertexArray(gl::makeVertexArray()), m_indices(GLsizei(3 * shape.triangles.size())) {
  m_vertices.upload(std::span<const ShapeVertex>(shape.vertices), GL_STATIC_DRAW);
  m_triangles.upload(std::span<const std::array<std::uint32_t, 3>>(shape.triangles), GL_STATIC_DRAW);
  glBindVertexArray(m_vertexArray.id());
  glBindVertexBuffer(0, m_vertices.id(), 0, sizeof(ShapeVertex));
  glEnableVertexAttribArray(RUBBLE_POSITION_ATTRIBUTE);
  glVertexAttribFormat(RUBBLE_POSITION_ATTRIBUTE, 3, GL_FLOAT, GL_FALSE, offsetof(ShapeVertex, position));
  glVertexAttribBinding(RUBBLE_POSITION_ATTRIBUTE, 0);
  glEnableVertexAttribArray(RUBBLE_NORMAL_ATTRIBUTE);
  glVertexAttribFormat(RUBBLE_NORMAL_ATTRIBUTE, 3, GL_FLOAT, GL_FALSE, offsetof(ShapeVertex, normal));
  glVertexAttribBinding(RUBBLE_NORMAL_ATTRIBUTE, 0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m_triangles.id());
  glBindVertexArray(0);
  gl::checkGl("a prop");
}

void Prop::setPose(const Eigen::Vector3f& position, const Eigen::Quaternionf& orientation) {
  if (!position.allFinite() || !(orientation.norm() > 0) || !orientation.coeffs().allFinite()) {
    throw Error("Renderer::setPropPose: position and orientation must be finite, the orientation not zero");
  }
  m_model.setIdentity();
  m_model.topLeftCorner<3, 3>() = orientation.normalized().toRotationMatrix();
  m_model.topRightCorner<3, 1>() = position;
}

void Prop::draw() const {
  glUniformMatrix4fv(RUBBLE_MODEL_UNIFORM, 1, GL_FALSE, m_model.data());
  glBindVertexArray(m_vertexArray.id());
  glDrawElements(GL_TRIANGLES, m_indices, GL_UNSIGNED_INT, nullptr);
}

}  // namespace rubble::render
