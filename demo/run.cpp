#include "demo/run.h"

#include <utility>

#include "demo/console.h"
#include "demo/frame.h"
#include "demo/input_error.h"
#include "demo/movie.h"
#include "demo/picture_writer.h"
#include "demo/progress.h"
#include "demo/summary.h"
#include "demo/window/egl_context.h"

namespace rubble::demo {
namespace {

// What only a run with pictures has. Members die in reverse order, so the context outlives all that was made
// in it.
struct Drawing {
  Drawing(const World& world, const RunOptions& options)
      : stage(world, world.scene()), framebuffer(options.width, options.height) {}

  Stage stage;
  Framebuffer framebuffer;
  std::optional<PictureWriter> pictures;
};

std::optional<EglContext> makeContext(const Scene& scene, const RunOptions& options) {
  if (!options.render) return std::nullopt;
  try {
    return std::make_optional<EglContext>();
  } catch (const Error& error) {
    throw InputError(scene.file, "OpenGL", std::string(error.what()) + "; --no-render does without");
  }
}

// Refuses what could not be written later, before the long work begins.
void checkOutputs(const RunOptions& options) {
  if (std::filesystem::exists(options.out) && !std::filesystem::is_directory(options.out)) {
    throw InputError("--out", options.out.string(), "is a file, must be a folder");
  }
  for (const auto& [name, file] :
       {std::pair("--stats", options.stats), std::pair("--events", options.events)}) {
    const std::filesystem::path folder = file.parent_path();
    if (!folder.empty() && folder != options.out && !std::filesystem::is_directory(folder)) {
      throw InputError(name, file.string(), "cannot be written, must be in an existing folder");
    }
  }
}

void prepareFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError("--out", folder.string(), error.message() + ", must be a folder that can be written");
  // Pictures of an earlier run would end up in this one's movie.
  for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = file.path().filename().string();
    if (name.starts_with("frame_") && name.ends_with(".png")) std::filesystem::remove(file.path(), error);
  }
}

RunOptions withDefaults(const Scene& scene, RunOptions options) {
  if (options.out.empty()) options.out = std::filesystem::path("out") / scene.name;
  if (options.stats.empty()) options.stats = options.out / "stats.jsonl";
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

void finishPictures(PictureWriter& pictures, const Scene& scene, const RunOptions& options,
                    std::ostream& report) {
  pictures.finish();
  report << "pictures: " << (options.out / pictureName(0)).string() << " to " << pictureName(scene.frames - 1)
         << '\n';
  if (const auto movie = writeMovie(options.out, scene.name, scene.frames, scene.fps)) {
    report << "movie: " << movie->string() << '\n';
  }
}

}  // namespace

Summary runScene(const Scene& scene, const RunOptions& given, std::ostream& report) {
  const RunOptions options = withDefaults(scene, given);
  checkOutputs(options);
  World world(scene, cookWithProgress(scene), consoleLog());
  const std::optional<EglContext> context = makeContext(scene, options);
  const std::unique_ptr<DustGrid> dust =
      makeDust(scene, context ? currentRenderer() : Renderer3D::None, options.threads);
  std::optional<Drawing> drawing;
  if (context) drawing.emplace(world, options);

  prepareFolder(options.out);
  Recorder recorder(world, options.stats, options.events);
  FrameParts parts{
      .world = &world, .recorder = &recorder, .dust = dust.get(), .camera = sceneCamera(scene.camera)};
  if (drawing) {
    drawing->pictures.emplace(options.out);
    drawing->stage.showDust(dust.get(), scene.dust ? scene.dust->opacity : 0);
    parts.stage = &drawing->stage;
    parts.framebuffer = &drawing->framebuffer;
    parts.pictures = &*drawing->pictures;
  }
  runFrames(parts, scene);

  printSummary(report, recorder.summary());
  report << "statistics: " << options.stats.string() << '\n';
  if (drawing) finishPictures(*drawing->pictures, scene, options, report);
  return recorder.summary();
}

}  // namespace rubble::demo
