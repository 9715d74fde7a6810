// A camera that circles about a point.
#pragma once

#include "rubble/render.h"

namespace rubble::demo {

class OrbitCamera {
 public:
  explicit OrbitCamera(const Camera& start);

  void turn(float rightPixels, float downPixels);  ///< as the mouse was dragged
  void approach(float notches);                    ///< of the wheel; positive comes nearer
  const Camera& camera() const { return m_camera; }

  /// Direction through a point of the picture, (0, 0) its upper left and (1, 1) its lower right corner.
  Eigen::Vector3f ray(float x, float y, float aspect) const;

 private:
  void place();

  Camera m_camera;
  float m_yaw, m_pitch, m_distance, m_start;  // [rad, rad, m, m]
};

}  // namespace rubble::demo
