// `rubble run`: a scene from its first frame to its last, with pictures, statistics and events.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>

#include "demo/asset_cache.h"
#include "demo/recorder.h"
#include "demo/scene.h"
#include "rubble/error.h"

namespace rubble::demo {

struct RunOptions {
  std::filesystem::path out = {};     ///< folder of pictures and statistics; empty: out/SCENE
  std::filesystem::path stats = {};   ///< empty: stats.jsonl in `out`
  std::filesystem::path events = {};  ///< empty: not written
  bool render = true;                 ///< false: no GL context is made and no GL library loaded
  int width = 1280, height = 720;
  int threads = 1;
  CacheOptions cache = {};  ///< of cooked objects
  LogFunction log = {};     ///< of cooking and of the world; empty: consoleLog()
};

/// Runs the scene and tells on `report` what happened. Throws InputError before anything is written,
/// RunStopped later, and MachineError when something is missing (before anything is written) or cannot be
/// written; the files of results then end with the last whole frame, and there is no half picture or movie.
Summary runScene(const Scene& scene, const RunOptions& options, std::ostream& report);

}  // namespace rubble::demo
