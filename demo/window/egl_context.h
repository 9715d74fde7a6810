// An OpenGL context without a window, for headless runs and tests.
#pragma once

namespace rubble::demo {

/// An OpenGL 4.3+ core context on Mesa's surfaceless EGL platform, or the default display where there is
/// none. It is current on the constructing thread until destroyed, and has no framebuffer of its own: bind
/// one before drawing.
class EglContext {
 public:
  /// Throws rubble::Error when the machine has no EGL or no OpenGL 4.3.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

 private:
  void* m_display = nullptr;
  void* m_context = nullptr;
};

}  // namespace rubble::demo
