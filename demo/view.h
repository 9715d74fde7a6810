// `rubble view`: a scene in a window, with a camera to orbit and balls to shoot.
#pragma once

#include "demo/asset_cache.h"
#include "demo/scene.h"

namespace rubble::demo {

struct ViewOptions {
  int width = 1280, height = 720;
  int threads = 1;
  CacheOptions cache = {};  ///< of cooked objects
  bool closeAtEnd = false;  ///< close after the scene's frames rather than go on
};

/// Returns when the window is closed. Throws InputError, RunStopped, and MachineError where
/// there is no display.
void viewScene(const Scene& scene, const ViewOptions& options);

}  // namespace rubble::demo
