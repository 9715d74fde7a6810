// Where an element is. Plain data: written by the simulation, uploaded as it is by the renderer.
#pragma once

#include <Eigen/Core>

namespace rubble {

/// Where an element is now; the layout the renderer uploads (32 bytes).
struct ElementPose {
  Eigen::Vector3f position;  ///< [m]
  float alive;               ///< 1, or 0 when crushed
  Eigen::Vector4f rotation;  ///< unit quaternion x y z w
};
static_assert(sizeof(ElementPose) == 32);

}  // namespace rubble
