// One frame: the world, then what happened in it, then the dust, then the picture. Parts that are absent cost
// nothing.
#pragma once

#include "demo/dust_setup.h"
#include "demo/recorder.h"
#include "demo/stage.h"
#include "demo/world.h"
#include "rubble/render.h"

namespace rubble::demo {

class PictureWriter;

/// What takes part in a frame; null where the run leaves it out.
struct FrameParts {
  World* world = nullptr;
  Recorder* recorder = nullptr;
  DustGrid* dust = nullptr;
  Stage* stage = nullptr;
  Framebuffer* framebuffer = nullptr;  // pictures are drawn into it; a window draws by itself
  PictureWriter* pictures = nullptr;   // null: they are drawn and not saved
  Camera camera = {};
  std::vector<DustObstacle> obstacles = {};  // kept from frame to frame for its memory
};

/// Simulates, draws, saves and records frame number `frame`. Throws RunStopped, and MachineError
/// when it cannot be drawn or written.
void runFrame(FrameParts& parts, int frame);

}  // namespace rubble::demo
