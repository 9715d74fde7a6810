// An OpenGL context without a window, for headless runs and tests.
#pragma once

#include <string>

namespace rubble::demo {

/// An OpenGL 4.3+ core context on the first display of displayChoices() that gives one: hardware before
/// software. It is current on the constructing thread until destroyed, and has no framebuffer of its own:
/// bind one before drawing.
class EglContext {
 public:
  /// Throws rubble::MachineError when the machine has no EGL, no OpenGL library or no OpenGL 4.3.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// What draws, as the driver names it (GL_RENDERER).
  const std::string& renderer() const { return m_renderer; }

 private:
  void* m_display = nullptr;
  void* m_context = nullptr;
  std::string m_renderer;
};

}  // namespace rubble::demo
