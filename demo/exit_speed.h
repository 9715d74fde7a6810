// How fast the first impactor leaves the place where the objects stood.
#pragma once

#include <LinearMath/btVector3.h>

#include <Eigen/Geometry>
#include <optional>

namespace rubble::demo {

class World;

/// Speed along the impactor's first direction, at the first frame in which its box no longer overlaps the box
/// that the objects filled at the start; negative when it bounced. While it is still inside, its present
/// speed.
class ExitSpeed {
 public:
  explicit ExitSpeed(const World& world);
  void update(const World& world);
  std::optional<double> value() const { return m_speed; }  ///< [m/s]; none before it has arrived

 private:
  Eigen::AlignedBox3f m_objects;
  Eigen::AlignedBox3f m_last;  // the impactor's in the frame before
  btVector3 m_direction = btVector3(0, 0, 0);
  bool m_left = false;
  std::optional<double> m_speed;
};

}  // namespace rubble::demo
