#include "demo/frame.h"

#include <utility>

#include "base/stopwatch.h"
#include "demo/input_error.h"
#include "demo/picture_writer.h"
#include "rubble/machine_error.h"

namespace rubble::demo {
namespace {

void stepDust(FrameParts& parts, const Events& events) {
  findObstacles(*parts.world, parts.obstacles);
  parts.dust->step(float(1 / parts.world->scene().fps), events.dustSources, parts.obstacles);
}

void drawFrame(FrameParts& parts, int frame) {
  parts.stage->draw(parts.camera, parts.framebuffer->target());
  Image image = parts.framebuffer->readPixels();  // waits until it is drawn
  if (parts.pictures) parts.pictures->save(frame, std::move(image));
}

// The scene was accepted: what the library refuses now is a state that went wrong.
template <class Work>
void advance(int frame, const Work& work) {
  try {
    work();
  } catch (const MachineError&) {
    throw;
  } catch (const Error& error) {
    throw RunStopped("frame " + std::to_string(frame) + ": " + error.what());
  }
}

}  // namespace

void runFrame(FrameParts& parts, int frame) {
  base::Stopwatch total, watch;
  FrameTimes times;
  parts.world->step();
  const Events& events = parts.world->destruction().takeEvents();
  times.step = watch.lap();
  if (parts.dust) advance(frame, [&] { stepDust(parts, events); });
  times.dust = watch.lap();
  if (parts.stage) advance(frame, [&] { parts.stage->update(*parts.world); });
  times.upload = watch.lap();
  if (parts.framebuffer) drawFrame(parts, frame);
  times.render = watch.lap();
  times.total = total.lap();
  parts.recorder->record(frame, *parts.world, parts.dust, events, times);
}

}  // namespace rubble::demo
