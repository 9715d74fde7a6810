// The viewer's controls, and what the mouse and the keyboard asked for. Dear ImGui, drawn over the scene.
#pragma once

#include "demo/recorder.h"
#include "demo/scene.h"

struct GLFWwindow;

namespace rubble::demo {

/// What the person wants in this frame.
struct PanelInput {
  bool paused = false, step = false, reset = false;
  float ballSpeed = 10;   ///< [m/s]
  float gravity = 9.81f;  ///< [m/s^2], downwards
  bool gravityMoved = false;
  float opacity = 1;               ///< of the dust
  float dragX = 0, dragY = 0;      ///< of the left button [pixels]
  float wheel = 0;                 ///< notches, up is positive
  bool shootAhead = false;         ///< the space bar
  bool shootAtCursor = false;      ///< the right button
  float cursorX = 0, cursorY = 0;  ///< share of the window, from its upper left corner
};

class Panel {
 public:
  /// Needs the window's context to be current.
  Panel(GLFWwindow* window, const Scene& scene);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  /// Lays out the controls; what they say holds until the next call.
  const PanelInput& show(const Summary& summary, int frame);
  /// Draws them into the window's framebuffer.
  void draw();

 private:
  void layOut(const Summary& summary, int frame);
  void readMouseAndKeys();

  PanelInput m_input;
};

}  // namespace rubble::demo
