// What a body's size and weight foretell, in the user's words.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "rubble/asset.h"
#include "rubble/material.h"

namespace rubble::edem {

struct WeightQuestion {
  const Asset& asset;
  const Material& material;
  const Model& model;
  Eigen::Isometry3d place;
  Eigen::Vector3d gravity;  ///< [m/s^2]
  bool anchored;
};

/// Why the body will not last, or is not of the size that was meant: stress by its own weight above its
/// strength, edges of a kilometre or below a millimetre. Empty when there is nothing to say.
std::string sizeAndWeightAdvice(const WeightQuestion& question);

/// "body 3 (concrete, 300 m tall)"
std::string bodyName(std::uint32_t id, const Material& material, const Asset& asset,
                     const Eigen::Isometry3d& place, const Eigen::Vector3d& gravity);

}  // namespace rubble::edem
