// Camera and lighting -> the block of constants that all shaders read.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "rubble/render.h"
#include "shared/draw.h"

namespace rubble::render {

struct FrameDef {
  const Camera* camera;
  const Lighting* lighting;
  FrameTarget target;
  Eigen::AlignedBox3f shadowBounds;  ///< what casts shadows
  int shadowMapSize;
};

/// Camera, light and tone of a frame; the dust's part is left without a grid. Throws rubble::Error for
/// numbers that make no picture.
shared::Frame makeFrame(const FrameDef& def);

inline shared::vec4 withW(const Eigen::Vector3f& v, float w) {
  return {v.x(), v.y(), v.z(), w};
}

/// World -> [0, 1]^3 of a shadow map that holds the box, the light shining along z.
Eigen::Matrix4f shadowMatrix(const Eigen::AlignedBox3f& bounds, const Eigen::Vector3f& toSun);

}  // namespace rubble::render
