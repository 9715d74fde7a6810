#include "demo/panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

namespace rubble::demo {

Panel::Panel(GLFWwindow* window, const Scene& scene) {
  m_input.gravity = float(-scene.gravity.y());
  if (scene.dust) m_input.opacity = float(scene.dust->opacity);
  if (!scene.impactors.empty()) m_input.ballSpeed = float(scene.impactors.front().velocity.norm());
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 430 core");
}

Panel::~Panel() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

const PanelInput& Panel::show(const Summary& summary, int frame) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  layOut(summary, frame);
  readMouseAndKeys();
  ImGui::Render();
  return m_input;
}

void Panel::layOut(const Summary& summary, int frame) {
  ImGui::SetNextWindowPos(ImVec2(10, 10), ImGuiCond_FirstUseEver);
  ImGui::Begin("rubble", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::Checkbox("pause (P)", &m_input.paused);
  ImGui::SameLine();
  m_input.step = ImGui::Button("step (N)");
  ImGui::SameLine();
  m_input.reset = ImGui::Button("reset (R)");
  ImGui::SliderFloat("ball speed, m/s", &m_input.ballSpeed, 0, 50, "%.1f");
  m_input.gravityMoved = ImGui::SliderFloat("gravity, m/s^2", &m_input.gravity, 0, 20, "%.2f");
  ImGui::SliderFloat("dust opacity", &m_input.opacity, 0, 4, "%.2f");
  ImGui::Separator();
  const DestructionCounts& counts = summary.counts;
  ImGui::Text("frame %d, %.1f frames/s", frame, double(ImGui::GetIO().Framerate));
  ImGui::Text("%u of %u elements crushed", counts.crushed, counts.elements);
  ImGui::Text("%u of %u springs broken", counts.springsBroken, counts.springs);
  ImGui::Text("%u fragments, %u debris", counts.fragments, counts.debrisAlive);
  ImGui::TextDisabled("drag: orbit, wheel: nearer\nright button or space: shoot");
  ImGui::End();
}

void Panel::readMouseAndKeys() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool mouse = !io.WantCaptureMouse;
  const bool keys = !io.WantCaptureKeyboard;
  const bool dragged = mouse && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  m_input.dragX = dragged ? io.MouseDelta.x : 0;
  m_input.dragY = dragged ? io.MouseDelta.y : 0;
  m_input.wheel = mouse ? io.MouseWheel : 0;
  m_input.shootAtCursor = mouse && ImGui::IsMouseClicked(ImGuiMouseButton_Right);
  m_input.cursorX = io.MousePos.x / io.DisplaySize.x;
  m_input.cursorY = io.MousePos.y / io.DisplaySize.y;
  m_input.shootAhead = keys && ImGui::IsKeyPressed(GLFW_KEY_SPACE, false);
  if (keys && ImGui::IsKeyPressed(GLFW_KEY_P, false)) m_input.paused = !m_input.paused;
  m_input.step |= keys && ImGui::IsKeyPressed(GLFW_KEY_N);
  m_input.reset |= keys && ImGui::IsKeyPressed(GLFW_KEY_R, false);
}

void Panel::draw() {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace rubble::demo
