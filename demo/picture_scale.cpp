#include "demo/picture_scale.h"

#include <algorithm>
#include <cmath>

namespace rubble::demo {
namespace {

constexpr float kSmall = 0.3f, kLarge = 30;  // diagonals between look right with joints every metre [m]
constexpr float kHaze = 0.05f;               // the renderer's own [1/m] ...
constexpr float kFarthest = 20;              // ... serves for things up to here [m]
constexpr float kFarHaze = 10;               // optical depth of haze at the far plane; the floor ends at 6
constexpr float kNear = 0.05f;               // [m] where the scale is 1
// The near plane stands at this share of the way to what is nearest; debris fly on this side of it.
constexpr float kNearShare = 0.04f;

float farthest(const Eigen::Vector3f& eye, const Eigen::AlignedBox3f& bounds) {
  return (bounds.max() - eye).cwiseAbs().cwiseMax((bounds.min() - eye).cwiseAbs()).norm();
}

}  // namespace

float grainScale(float diagonal) {
  if (!(diagonal > 0)) return 1;
  if (diagonal > kLarge) return std::pow(10.f, std::ceil(std::log10(diagonal / kLarge)));
  if (diagonal < kSmall) return std::pow(10.f, std::floor(std::log10(diagonal / kSmall)));
  return 1;
}

float hazeOf(const Eigen::Vector3f& eye, const Eigen::AlignedBox3f& bounds, float grain) {
  const float distance = bounds.isEmpty() ? 0 : farthest(eye, bounds);
  return kHaze / std::max(grain, distance / kFarthest);
}

Camera withPlanes(Camera camera, const Eigen::AlignedBox3f& bounds, std::optional<float> ground, float grain,
                  float haze) {
  float nearest = kFarHaze / haze, most = nearest;
  if (!bounds.isEmpty()) {
    nearest = bounds.exteriorDistance(camera.eye);
    most = std::max(most, 2 * farthest(camera.eye, bounds));
  }
  if (ground) nearest = std::min(nearest, std::abs(camera.eye.y() - *ground));
  camera.nearPlane = std::max(kNear * grain, kNearShare * nearest);
  camera.farPlane = std::max(most, 2 * camera.nearPlane);
  return camera;
}

}  // namespace rubble::demo
