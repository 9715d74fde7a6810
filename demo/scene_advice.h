// What a scene may hold but hardly means.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "demo/scene.h"
#include "rubble/error.h"

namespace rubble::demo {

/// Warns of objects outside of the dust's box, whose dust would leave at once, and of a box whose floor,
/// which is ground to the dust, is not on the ground. `bounds` are those of the objects, each in its own
/// frame [m].
void adviseOnDust(const Scene& scene, std::span<const Eigen::AlignedBox3d> bounds, const LogFunction& log);

}  // namespace rubble::demo
