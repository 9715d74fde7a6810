// The objects of a scene, cooked: equal ones once, and those of earlier runs not again.
#pragma once

#include <memory>
#include <vector>

#include "demo/asset_cache.h"
#include "demo/scene.h"
#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::demo {

/// The cooked objects of a scene, in its order. Worlds built from them share them, and so do equal objects.
using Assets = std::vector<std::shared_ptr<const Asset>>;

/// `progress` is told "cooking, STAGE", or "taken from FILE" of the cache. Throws InputError when an object
/// cannot be cooked.
Assets cookObjects(const Scene& scene, const ProgressFunction& progress = {}, const LogFunction& log = {},
                   const CacheOptions& cache = {});

}  // namespace rubble::demo
