// A bundled scene at several settings, against a kept run of the same scene.
#pragma once

#include "demo/report_case.h"

namespace rubble::demo {

struct SceneCaseDef {
  std::string name, what;    ///< as of ReportCase
  std::string scene;         ///< one of the bundled
  int frames = 0;            ///< of it, from its start
  int minutes = 0;           ///< that making the reference takes
  double frameSeconds = 0;   ///< about how long a frame takes at the default setting
  int objects = 1;           ///< that the scene has
  bool wholeBodies = false;  ///< they may also be rigid until something strikes them
  bool fewInAll = false;     ///< `--all` runs the default, half its substep and whole bodies at the default
};

/// Runs in both precisions, with fewer of Bullet's ticks, and with whole bodies where there may be some.
/// Reads no file.
ReportCase sceneCase(const SceneCaseDef& def);

}  // namespace rubble::demo
