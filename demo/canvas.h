// What a run without a window draws into.
#pragma once

#include <memory>

#include "demo/stage.h"
#include "demo/window/egl_context.h"
#include "rubble/render.h"

namespace rubble::demo {

/// An OpenGL context and the picture in it. Nothing drawn with it may outlive it.
struct Canvas {
  /// Throws MachineError.
  Canvas(int width, int height) : framebuffer(width, height) {}
  EglContext context;  // outlives what is made in it
  Framebuffer framebuffer;
};

/// Made before the long work: a machine that cannot draw says so at once. Throws MachineError, which names
/// --no-render.
std::unique_ptr<Canvas> makeCanvas(int width, int height);

/// Throws MachineError: whatever stops it is the machine's, the context is too poor or its shaders are not
/// installed.
std::unique_ptr<Stage> makeStage(const World& world);

}  // namespace rubble::demo
