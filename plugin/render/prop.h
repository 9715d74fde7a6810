// A rigid thing beside the bodies: sphere, box, hull.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "gl/buffer.h"
#include "render/shapes.h"
#include "rubble/render.h"

namespace rubble::render {

class Prop {
 public:
  Prop(const Shape& shape, const PropLook& look);

  void setPose(const Eigen::Vector3f& position, const Eigen::Quaternionf& orientation);
  /// Draws with the program in use, which has RUBBLE_MODEL_UNIFORM.
  void draw() const;
  const PropLook& look() const { return m_look; }

 private:
  PropLook m_look;
  Eigen::Matrix4f m_model = Eigen::Matrix4f::Identity();
  gl::VertexArrayName m_vertexArray;
  gl::Buffer m_vertices, m_triangles;
  GLsizei m_indices;
};

}  // namespace rubble::render
