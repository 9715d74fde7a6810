// Debris as the application sees it: what is left of crushed elements, as plain data for drawing and game
// logic.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace rubble {

/// A piece of debris, drawn as its element's cell scaled down.
struct DebrisPiece {
  Eigen::Vector3f position;  ///< [m]
  Eigen::Vector3f velocity;  ///< [m/s]
  Eigen::Quaternionf orientation;
  Eigen::Vector3f spin;  ///< [rad/s]
  float radius;          ///< R: size of its grains [m]
  float mass;            ///< [kg]
  float scale;           ///< of the cell mesh when drawn
  std::uint32_t body;    ///< DestructibleBody::id()
  std::uint32_t element;
  bool resting;
};

}  // namespace rubble
