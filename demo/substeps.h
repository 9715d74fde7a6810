// How many substeps an object will need, known before it is cooked.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "demo/scene.h"

namespace rubble::demo {

/// Keys of the scene beside the object's own that decide how many it needs and may have.
std::vector<std::string> whatSubstepsDependOn();

/// Throws InputError when the object of that number surely needs more substeps than max_substeps_per_frame,
/// and says about which value, which Young's modulus and how many elements would do. `volume` is the solid's
/// [m^3], in `elements` elements. What is near the limit passes: the library counts exactly when the elements
/// are known.
void requireSubsteps(const Scene& scene, std::size_t object, double volume, std::size_t elements);

}  // namespace rubble::demo
