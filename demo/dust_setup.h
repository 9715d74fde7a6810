// The dust grid of a scene, and the solids that stand in its air.
#pragma once

#include <memory>
#include <vector>

#include "demo/world.h"
#include "rubble/dust.h"

namespace rubble::demo {

/// What draws: decides where `auto` dust is computed.
enum class Renderer3D { None, Software, Hardware };

/// True when the name of the current GL context's renderer is one of Mesa's software rasterisers.
bool isSoftwareRenderer(const std::string& glRenderer);

/// The grid that the scene asks for, or null when it asks for none. The GL back end needs its context
/// current. Throws InputError when it asks for GL where there is none.
std::unique_ptr<DustGrid> makeDust(const Scene& scene, Renderer3D renderer, int threads);

/// The impactors as they are now; `out` is overwritten.
void findObstacles(const World& world, std::vector<DustObstacle>& out);

}  // namespace rubble::demo
