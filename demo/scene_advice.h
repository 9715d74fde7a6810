// What a scene may hold but hardly means.
#pragma once

#include "demo/scene.h"
#include "rubble/error.h"

namespace rubble::demo {

/// Warns of objects outside of the dust's box, whose dust would leave at once, and of a box whose floor,
/// which is ground to the dust, is not on the ground.
void adviseOnDust(const Scene& scene, const LogFunction& log);

}  // namespace rubble::demo
