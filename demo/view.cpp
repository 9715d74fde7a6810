#include "demo/view.h"

#include <chrono>

#include "demo/console.h"
#include "demo/frame.h"
#include "demo/orbit_camera.h"
#include "demo/panel.h"
#include "demo/window/glfw_window.h"

namespace rubble::demo {
namespace {

// Everything that `reset` makes anew.
struct Session {
  Session(const Scene& scene, const Assets& assets, int threads)
      : world(scene, assets, consoleLog()),
        dust(makeDust(scene, currentRenderer(), threads)),
        stage(world, scene),
        recorder(world, {}, {}),
        parts{.world = &world, .recorder = &recorder, .dust = dust.get(), .stage = &stage} {}

  World world;
  std::unique_ptr<DustGrid> dust;
  Stage stage;
  Recorder recorder;
  FrameParts parts;
  int frame = 0;
};

// The ball that is shot: the scene's own if it has one.
SceneBody ball(const Scene& scene) {
  for (const SceneBody& body : scene.impactors)
    if (body.shape == SceneBody::Shape::Sphere) return body;
  SceneBody sphere;
  sphere.radius = 0.1;
  sphere.mass = 10;
  return sphere;
}

void shoot(Session& session, const Scene& scene, const OrbitCamera& camera, const Eigen::Vector3f& along,
           double speed) {
  SceneBody body = ball(scene);
  constexpr double kAhead = 0.5;  // [m] from the eye, so that it does not fill the view
  body.position = camera.camera().eye.cast<double>() + kAhead * along.cast<double>();
  body.velocity = along.cast<double>() * speed;
  body.spin.setZero();
  session.world.addImpactor(body);
}

void applyInput(const PanelInput& input, Session& session, const Scene& scene, OrbitCamera& camera,
                float aspect) {
  camera.turn(input.dragX, input.dragY);
  camera.approach(input.wheel);
  if (input.shootAhead) shoot(session, scene, camera, camera.ray(0.5f, 0.5f, aspect), input.ballSpeed);
  if (input.shootAtCursor)
    shoot(session, scene, camera, camera.ray(input.cursorX, input.cursorY, aspect), input.ballSpeed);
  if (input.gravityMoved) session.world.bullet().setGravity(btVector3(0, btScalar(-input.gravity), 0));
  session.stage.showDust(session.dust.get(), input.opacity);
}

// True once for every frame of simulated time that has passed on the clock; a slow machine skips none, it
// runs slower.
class Pace {
 public:
  explicit Pace(double fps) : m_frame(std::chrono::duration<double>(1 / fps)) {}
  bool due() {
    const auto now = std::chrono::steady_clock::now();
    if (now - m_last < m_frame) return false;
    m_last = now;
    return true;
  }

 private:
  std::chrono::duration<double> m_frame;
  std::chrono::steady_clock::time_point m_last;
};

std::unique_ptr<GlfwWindow> openWindow(const Scene& scene, const ViewOptions& options) {
  return std::make_unique<GlfwWindow>(("rubble: " + scene.name).c_str(), options.width, options.height);
}

}  // namespace

void viewScene(const Scene& scene, const ViewOptions& options) {
  const std::unique_ptr<GlfwWindow> window = openWindow(scene, options);  // or fails at once
  const Assets assets = cookWithProgress(scene, options.cache);
  Panel panel(window->handle(), scene);
  OrbitCamera camera(sceneCamera(scene.camera));
  Pace pace(scene.fps);
  std::optional<Session> session(std::in_place, scene, assets, options.threads);
  while (!window->shouldClose()) {
    window->pollEvents();
    const auto [width, height] = window->framebufferSize();
    if (width == 0 || height == 0) continue;  // minimised
    const PanelInput input = panel.show(session->recorder.summary(), session->frame);
    if (input.reset) session.emplace(scene, assets, options.threads);
    applyInput(input, *session, scene, camera, float(width) / float(height));
    if (input.step || (!input.paused && pace.due())) runFrame(session->parts, session->frame++);
    session->stage.draw(camera.camera(), {0, width, height});
    panel.draw();
    window->swapBuffers();
    if (options.closeAtEnd && session->frame >= scene.frames) return;
  }
}

}  // namespace rubble::demo
