// A window on the desktop with an OpenGL 4.3 core context.
#pragma once

#include <utility>

struct GLFWwindow;

namespace rubble::demo {

/// One at a time. Its context is current from construction on; it waits for the screen's refresh in
/// swapBuffers().
class GlfwWindow {
 public:
  /// Sizes in screen coordinates. Throws MachineError with GLFW's reason when there is no display or no
  /// OpenGL 4.3.
  GlfwWindow(const char* title, int width, int height);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  bool shouldClose() const;
  void pollEvents();
  void swapBuffers();
  /// Width and height in pixels; both 0 while the window is minimised.
  std::pair<int, int> framebufferSize() const;
  /// For callbacks and user interfaces; owned by this object.
  GLFWwindow* handle() const { return m_window; }

 private:
  // GLFW is shut down after the window is gone, also when the constructor throws.
  struct Library {
    Library();
    ~Library();
  };
  Library m_library;
  GLFWwindow* m_window = nullptr;
};

}  // namespace rubble::demo
