// How a picture is fitted to the size of its scene: planes of the camera, grain and haze. A crumb and a
// skyscraper are seen as well as a wall of a metre, whose picture has the renderer's own defaults.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "rubble/render.h"

namespace rubble::demo {

/// Of a scene whose bounds have this diagonal [m]: 1 from 0.3 to 30 m, and steps of ten beyond.
float grainScale(float diagonal);

/// Where the floor fades [1/m], seen from `eye`: far behind everything that is in the bounds.
float hazeOf(const Eigen::Vector3f& eye, const Eigen::AlignedBox3f& bounds, float grain);

/// The camera with planes that hold the bounds, and the floor at the height `ground` to where it has faded.
Camera withPlanes(Camera camera, const Eigen::AlignedBox3f& bounds, std::optional<float> ground, float grain,
                  float haze);

}  // namespace rubble::demo
