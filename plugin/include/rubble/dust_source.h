// Dust as it is born: what the mechanics hand to the dust grid.
#pragma once

#include <Eigen/Core>

namespace rubble {

/// Dust that a crushed element raised in this frame.
struct DustSource {
  Eigen::Vector3f position;  ///< [m], world
  Eigen::Vector3f velocity;  ///< of the element [m/s]
  float mass;                ///< P m of eq. (6), (7) [kg]
  float size;                ///< R_dust, radius of the largest grain [m]
};

}  // namespace rubble
