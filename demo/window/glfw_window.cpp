#include "demo/window/glfw_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

std::string lastProblem() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason ? reason : "unknown reason";
}

}  // namespace

GlfwWindow::Library::Library() {
  if (!glfwInit()) throw MachineError("window: there is no display to open one on: " + lastProblem());
}

GlfwWindow::Library::~Library() {
  glfwTerminate();
}

GlfwWindow::GlfwWindow(const char* title, int width, int height) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  // The renderer resolves its own samples and encodes its own gamma.
  glfwWindowHint(GLFW_SAMPLES, 0);
  glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  m_window = glfwCreateWindow(width, height, title, nullptr, nullptr);
  if (!m_window) throw MachineError("window: cannot be opened with OpenGL 4.3: " + lastProblem());
  glfwMakeContextCurrent(m_window);
  glfwSwapInterval(1);
}

GlfwWindow::~GlfwWindow() {
  glfwDestroyWindow(m_window);
}

bool GlfwWindow::shouldClose() const {
  return glfwWindowShouldClose(m_window) != GLFW_FALSE;
}
void GlfwWindow::pollEvents() {
  glfwPollEvents();
}
void GlfwWindow::swapBuffers() {
  glfwSwapBuffers(m_window);
}

std::pair<int, int> GlfwWindow::framebufferSize() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(m_window, &width, &height);
  return {width, height};
}

}  // namespace rubble::demo
