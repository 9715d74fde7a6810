#include "frame.h"

#include <chrono>

#include "picture_writer.h"

namespace rubble::demo {
namespace {

/// Milliseconds since it was last read.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(m_last, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

void stepDust(FrameParts& parts, const Events& events) {
  findObstacles(*parts.world, parts.obstacles);
  parts.dust->step(static_cast<float>(1 / parts.world->scene().fps), events.dustSources, parts.obstacles);
}

void drawFrame(FrameParts& parts, int frame) {
  parts.stage->draw(parts.camera, parts.framebuffer->target());
  parts.pictures->save(frame, parts.framebuffer->readPixels());
}

}  // namespace

void runFrame(FrameParts& parts, int frame) {
  StopWatch total, watch;
  FrameTimes times;
  parts.world->step();
  const Events& events = parts.world->destruction().takeEvents();
  times.step = watch.lap();
  if (parts.dust) stepDust(parts, events);
  times.dust = watch.lap();
  if (parts.stage) parts.stage->update(*parts.world);
  times.upload = watch.lap();
  if (parts.framebuffer) drawFrame(parts, frame);
  times.render = watch.lap();
  times.total = total.lap();
  parts.recorder->record(frame, *parts.world, parts.dust, events, times);
}

}  // namespace rubble::demo
