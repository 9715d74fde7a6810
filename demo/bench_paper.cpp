#include "demo/bench_paper.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <thread>
#include <tuple>

#include "base/stopwatch.h"
#include "demo/canvas.h"
#include "demo/console.h"
#include "demo/csv_table.h"
#include "demo/frame.h"
#include "demo/input_error.h"
#include "demo/machine.h"
#include "demo/marked_text.h"
#include "demo/output_file.h"
#include "demo/processor_time.h"
#include "demo/progress.h"
#include "demo/settings_hash.h"

namespace rubble::demo {
namespace {

constexpr const char* kSource = "bench paper";  // of the values that it gives a scene

// A line of the table before it is timed.
struct Plan {
  BenchRow row;
  Scene scene;
};

int elementsOf(const Scene& scene) {
  std::uint32_t sum = 0;
  for (const SceneObject& object : scene.objects) sum += object.elements;
  return int(sum);
}

Plan planOf(const std::string& part, std::string_view sceneName, std::vector<Override> overrides,
            const BenchPaperOptions& options) {
  overrides.push_back({"frames", options.frames, "--frames"});
  Plan plan{.row = {}, .scene = loadScene(std::string(sceneName), overrides)};
  plan.row.part = part;
  plan.row.scene = plan.scene.name;
  plan.row.elements = elementsOf(plan.scene);
  plan.row.dust = plan.scene.dust ? plan.scene.dust->resolution : 0;
  return plan;
}

Plan planOf(const PaperCell& cell, const BenchPaperOptions& options) {
  const PaperCell usual{.part = cell.part, .fps = cell.fps};
  std::vector<Override> overrides = {{"dust.resolution", std::to_string(cell.dust), kSource}};
  if (cell.elements != usual.elements) {
    overrides.push_back({"objects.0.elements", std::to_string(cell.elements), kSource});
    overrides.push_back({"objects.0.radius", "0", kSource});  // theirs must grow as they grow fewer
  }
  Plan plan = planOf(std::string(1, cell.part), kPaperTableScene, overrides, options);
  plan.row.paperFps = cell.fps;
  if (!cell.pictures) return plan;
  plan.row.width = std::max(1, options.width * cell.width / usual.width);
  plan.row.height = std::max(1, options.height * cell.height / usual.height);
  return plan;
}

Plan planOf(const PaperFigure& figure, bool pictures, const BenchPaperOptions& options) {
  Plan plan = planOf(std::string(figure.name), figure.scene, {}, options);
  if (!pictures) return plan;
  if (figure.fps > 0) plan.row.paperFps = figure.fps;
  plan.row.width = options.width;
  plan.row.height = options.height;
  return plan;
}

std::vector<Plan> plansOf(const BenchPaperOptions& options) {
  std::vector<Plan> plans;
  const auto add = [&](Plan plan) {
    const bool tooMany = options.mostElements && plan.row.elements > *options.mostElements;
    if (!tooMany && (options.render || !plan.row.pictures())) plans.push_back(std::move(plan));
  };
  for (const PaperCell& cell : kPaperTable) add(planOf(cell, options));
  for (const PaperFigure& figure : kPaperFigures) {
    add(planOf(figure, true, options));
    add(planOf(figure, false, options));
  }
  if (plans.empty())
    throw InputError("--most-elements", std::to_string(options.mostElements.value_or(0)),
                     "leaves no run, must be at least " + std::to_string(kPaperTable[4].elements));
  return plans;
}

// Rows of equal settings share one run.
using RunKey = std::tuple<std::string, int, int, int, int>;
RunKey runKeyOf(const BenchRow& row) {
  return {row.scene, row.elements, row.width, row.height, row.dust};
}

void addFrame(BenchTimes& sum, const Recorder& recorder, const World& world) {
  const auto& ms = recorder.lastFrame().at("ms");
  const auto of = [&](const char* part) { return ms.at(part).get<double>(); };
  sum.total += of("total");
  for (const char* part : {"bullet", "edem", "neighbours", "fracture", "debris"}) sum.simulation += of(part);
  sum.dust += of("dust");
  sum.pictures += of("upload") + of("render");
  sum.substeps += world.substeps();
  sum.frames += 1;
}

BenchTimes meanOf(BenchTimes sum) {
  for (double* part : {&sum.total, &sum.simulation, &sum.dust, &sum.pictures, &sum.substeps})
    *part /= sum.frames;
  return sum;
}

class Bench {
 public:
  Bench(const BenchPaperOptions& options, std::size_t runs) : m_threads(options.threads), m_runs(runs) {}

  BenchTimes measure(const Plan& plan) {
    const auto [at, isNew] = m_done.try_emplace(runKeyOf(plan.row));
    if (isNew) at->second = run(plan);
    return at->second;
  }

 private:
  BenchTimes run(const Plan& plan) {
    const Scene& scene = plan.scene;
    const BenchRow& row = plan.row;
    const std::unique_ptr<Canvas> canvas = row.pictures() ? makeCanvas(row.width, row.height) : nullptr;
    const std::unique_ptr<DustGrid> dust =
        makeDust(scene, canvas ? currentRenderer() : Renderer3D::None, m_threads);
    World world(scene, assetsOf(plan), consoleLog());
    const std::unique_ptr<Stage> stage = canvas ? makeStage(world) : nullptr;
    if (stage) stage->showDust(dust.get(), scene.dust ? scene.dust->opacity : 0);
    Recorder recorder(world, {}, {});
    FrameParts parts{.world = &world,
                     .recorder = &recorder,
                     .dust = dust.get(),
                     .stage = stage.get(),
                     .framebuffer = canvas ? &canvas->framebuffer : nullptr,
                     .camera = sceneCamera(scene.camera)};
    BenchTimes sum;
    const double began = processorTime();
    base::Stopwatch watch;
    for (int frame = 0; frame < scene.frames; ++frame) {
      runFrame(parts, frame);
      addFrame(sum, recorder, world);
      showProgress((frame + 1.0) / scene.frames);
    }
    sum.cores = 1e3 * (processorTime() - began) / watch.lap();
    ++m_finished;
    return meanOf(sum);
  }

  // Cooked once for all runs of the same solids.
  const Assets& assetsOf(const Plan& plan) {
    const auto [at, isNew] = m_assets.try_emplace({plan.row.scene, plan.row.elements});
    if (isNew) at->second = cookObjects(plan.scene, {}, consoleLog());
    return at->second;
  }

  void showProgress(double share) {
    m_progress.show((double(m_finished) + share) / double(m_runs),
                    "run " + std::to_string(m_finished + 1) + " of " + std::to_string(m_runs));
  }

  int m_threads;
  std::size_t m_runs, m_finished = 0;
  std::map<RunKey, BenchTimes> m_done;
  std::map<std::pair<std::string, int>, Assets> m_assets;
  Progress m_progress{"bench"};
};

// Before the first run: a machine that cannot draw says so at once.
BenchMachine machineOf(const BenchPaperOptions& options, bool draws) {
  BenchMachine machine{.name = machineName(),
                       .processors = int(std::thread::hardware_concurrency()),
                       .dustThreads = options.threads,
                       .renderer = ""};
  if (draws) machine.renderer = makeCanvas(options.width, options.height)->context.renderer();
  double load = 0;
  if (getloadavg(&load, 1) == 1) machine.load = load;
  return machine;
}

void checkOutputs(const BenchPaperOptions& options) {
  const std::pair<const char*, const std::filesystem::path&> files[] = {
      {"--csv", options.csv}, {"--svg", options.svg}, {"--write", options.write}};
  for (const auto& [option, file] : files) {
    if (file.empty()) continue;
    if (option != std::string("--write")) checkFile(option, file, {});
    for (const auto& [other, otherFile] : files) {
      if (other == option) break;
      if (!otherFile.empty() && sameFile(file, otherFile))
        throw InputError(option, file.string(),
                         "is the file of " + std::string(other) + ", must be another file");
    }
  }
}

// The arguments that make this bench again.
std::string argumentsOf(const BenchPaperOptions& options) {
  const BenchPaperOptions standard;
  std::string text;
  if (options.frames != standard.frames) text += " --frames " + options.frames;
  if (options.width != standard.width || options.height != standard.height)
    text += " --size " + std::to_string(options.width) + "x" + std::to_string(options.height);
  if (options.mostElements) text += " --most-elements " + std::to_string(*options.mostElements);
  if (!options.render) text += " --no-render";
  return text;
}

}  // namespace

std::string benchPaperHash(const BenchPaperOptions& options, std::span<const SolverVersion> versions) {
  std::vector<Scene> scenes;
  for (Plan& plan : plansOf(options)) scenes.push_back(std::move(plan.scene));
  return settingsHash(scenes, versions);
}

void benchPaper(const BenchPaperOptions& options, std::ostream& out) {
  const std::vector<Plan> plans = plansOf(options);
  checkOutputs(options);
  std::optional<MarkedText> document;
  if (!options.write.empty()) document.emplace(options.write, "rubble bench paper" + argumentsOf(options));
  const bool draws = std::ranges::any_of(plans, [](const Plan& plan) { return plan.row.pictures(); });
  const BenchMachine machine = machineOf(options, draws);

  std::map<RunKey, int> runs;
  for (const Plan& plan : plans) ++runs[runKeyOf(plan.row)];
  std::vector<BenchRow> rows;
  {
    Bench bench(options, runs.size());
    for (const Plan& plan : plans) {
      rows.push_back(plan.row);
      rows.back().times = bench.measure(plan);
    }
  }

  const std::string markdown = benchMarkdown(rows, machine);
  out << markdown;
  if (!options.csv.empty()) writeWhole(options.csv, csvTable(benchCsv(rows, machine)));
  if (!options.svg.empty()) writeWhole(options.svg, benchSvg(rows, machine));
  if (document) document->replace(markdown, benchPaperHash(options));
  for (const std::filesystem::path& file : {options.csv, options.svg, options.write})
    if (!file.empty()) out << "written: " << file.string() << '\n';
}

}  // namespace rubble::demo
