// `rubble info`: what a scene or an asset holds, needs and does not need.
#pragma once

#include <filesystem>
#include <ostream>

#include "demo/asset_cache.h"
#include "demo/scene.h"

namespace rubble::demo {

/// Cooks the scene and builds its world, but simulates nothing. Throws InputError.
void describeScene(const Scene& scene, const CacheOptions& cache, std::ostream& out);

/// True for the name of a cooked asset rather than of a scene.
bool isAssetFile(const std::string& nameOrPath);
/// Throws InputError.
void describeAsset(const std::filesystem::path& file, std::ostream& out);

}  // namespace rubble::demo
