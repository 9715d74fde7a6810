#include "demo/run.h"

#include <memory>
#include <utility>

#include "demo/canvas.h"
#include "demo/console.h"
#include "demo/frame.h"
#include "demo/input_error.h"
#include "demo/movie.h"
#include "demo/output_file.h"
#include "demo/picture_list.h"
#include "demo/picture_writer.h"
#include "demo/progress.h"
#include "demo/summary.h"

namespace rubble::demo {
namespace {

std::string movieName(const Scene& scene) {
  return scene.name + ".mp4";
}

// Refuses what could not be written later, before the long work begins.
void checkOutputs(const Scene& scene, const RunOptions& options) {
  checkFolder("--out", options.out);
  for (const auto& [option, file] :
       {std::pair("--stats", options.stats), std::pair("--events", options.events)}) {
    if (file.empty()) continue;
    checkFile(option, file, options.out);
    if (sameFile(file, scene.file))
      throw InputError(option, file.string(), "is the scene, must be another file");
  }
  if (!options.events.empty() && sameFile(options.stats, options.events))
    throw InputError("--events", options.events.string(), "is the file of --stats, must be another file");
}

RunOptions withDefaults(const Scene& scene, RunOptions options) {
  if (options.out.empty()) options.out = std::filesystem::path("out") / scene.name;
  if (options.stats.empty()) options.stats = options.out / "stats.jsonl";
  if (!options.log) options.log = consoleLog();
  return options;
}

void runFrames(FrameParts& parts, const Scene& scene) {
  Progress progress(scene.name);
  for (int frame = 0; frame < scene.frames; ++frame) {
    runFrame(parts, frame);
    progress.show((frame + 1.0) / scene.frames,
                  "frame " + std::to_string(frame + 1) + " of " + std::to_string(scene.frames));
  }
}

void finishPictures(PictureWriter& pictures, PictureList& list, const Scene& scene, const RunOptions& options,
                    std::ostream& report) {
  pictures.finish();
  report << "pictures: " << (options.out / pictureName(0)).string() << " to " << pictureName(scene.frames - 1)
         << '\n';
  if (writeMovie(options.out, movieName(scene), scene.frames, scene.fps, list)) {
    report << "movie: " << (options.out / movieName(scene)).string() << '\n';
  } else {
    report << "no movie: ffmpeg is not installed\n";
  }
}

}  // namespace

Summary runScene(const Scene& scene, const RunOptions& given, std::ostream& report) {
  const RunOptions options = withDefaults(scene, given);
  checkOutputs(scene, options);
  std::optional<PictureList> list;
  if (options.render) list.emplace(options.out, movieName(scene)).requireFree(scene.frames);
  const std::unique_ptr<Canvas> canvas = options.render ? makeCanvas(options.width, options.height) : nullptr;
  const std::unique_ptr<DustGrid> dust =
      makeDust(scene, canvas ? currentRenderer() : Renderer3D::None, options.threads);
  World world(scene, cookWithProgress(scene, options.cache, options.log), options.log);
  const std::unique_ptr<Stage> stage = canvas ? makeStage(world) : nullptr;

  makeFolder(options.out);
  Recorder recorder(world, options.stats, options.events);
  FrameParts parts{
      .world = &world, .recorder = &recorder, .dust = dust.get(), .camera = sceneCamera(scene.camera)};
  std::optional<PictureWriter> pictures;
  if (canvas) {
    list->startAnew();
    pictures.emplace(options.out, &*list);
    stage->showDust(dust.get(), scene.dust ? scene.dust->opacity : 0);
    parts.stage = stage.get();
    parts.framebuffer = &canvas->framebuffer;
    parts.pictures = &*pictures;
  }
  runFrames(parts, scene);

  Summary summary = recorder.summary();
  if (canvas) summary.drawnBy = canvas->context.renderer();
  printSummary(report, summary);
  report << "statistics: " << options.stats.string() << '\n';
  if (canvas) finishPictures(*pictures, *list, scene, options, report);
  return summary;
}

}  // namespace rubble::demo
