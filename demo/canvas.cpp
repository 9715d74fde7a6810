#include "demo/canvas.h"

#include "rubble/error.h"
#include "rubble/machine_error.h"

namespace rubble::demo {

std::unique_ptr<Canvas> makeCanvas(int width, int height) {
  try {
    return std::make_unique<Canvas>(width, height);
  } catch (const Error& error) {
    throw MachineError("OpenGL: " + std::string(error.what()) + "; --no-render does without");
  }
}

std::unique_ptr<Stage> makeStage(const World& world) {
  try {
    return std::make_unique<Stage>(world, world.scene());
  } catch (const Error& error) {
    throw MachineError(error.what());
  }
}

}  // namespace rubble::demo
