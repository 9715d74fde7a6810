#include "demo/report.h"

#include <algorithm>
#include <sstream>

#include "demo/console.h"
#include "demo/csv_table.h"
#include "demo/frame.h"
#include "demo/input_error.h"
#include "demo/machine.h"
#include "demo/markdown_table.h"
#include "demo/marked_text.h"
#include "demo/output_file.h"
#include "demo/progress.h"
#include "demo/settings_hash.h"

namespace rubble::demo {
namespace {

constexpr std::size_t kMostRuns = 1000;

// One column of the table.
struct Column {
  std::string title;                ///< in the Markdown table
  std::string name;                 ///< in the CSV
  std::vector<std::string> values;  ///< one a run
};

// The settings of one run, one value a sweep.
using Setting = std::vector<std::string>;

const std::vector<Sweep>& sweepsOf(const ReportOptions& options) {
  static const std::vector<Sweep> standard = defaultSweeps();
  return options.sweeps.empty() ? standard : options.sweeps;
}

// All combinations, the last sweep fastest.
std::vector<Setting> settingsOf(const std::vector<Sweep>& sweeps) {
  std::vector<Setting> settings = {{}};
  for (const Sweep& sweep : sweeps) {
    std::vector<Setting> longer;
    for (const Setting& setting : settings) {
      for (const std::string& value : sweep.values) {
        longer.push_back(setting);
        longer.back().push_back(value);
      }
    }
    if (longer.size() > kMostRuns)
      throw InputError(
          "--sweep", sweep.key,
          "makes " + std::to_string(longer.size()) + " runs, must be at most " + std::to_string(kMostRuns));
    settings = std::move(longer);
  }
  return settings;
}

// All scenes are read before the first is run: a wrong value is refused at once.
std::vector<Scene> scenesOf(const ReportOptions& options) {
  const std::vector<Sweep>& sweeps = sweepsOf(options);
  std::vector<Scene> scenes;
  for (const Setting& setting : settingsOf(sweeps)) {
    std::vector<Override> overrides = options.overrides;
    for (std::size_t s = 0; s < sweeps.size(); ++s)
      overrides.push_back({sweeps[s].key, setting[s], options.sweeps.empty() ? "report" : "--sweep"});
    scenes.push_back(loadScene(options.scene, overrides));
    scenes.back().dust.reset();  // it does not act back on the mechanics
  }
  return scenes;
}

struct Outcome {
  double substep = 0;  // longest mean of a frame [s]
  Summary summary;
};

Outcome measure(const Scene& scene, const CacheOptions& cache, Progress& progress, double done,
                double share) {
  World world(scene, cookObjects(scene, {}, {}, cache), consoleLog());
  Recorder recorder(world, {}, {});
  FrameParts parts{.world = &world, .recorder = &recorder};
  Outcome outcome;
  for (int frame = 0; frame < scene.frames; ++frame) {
    runFrame(parts, frame);
    outcome.substep = std::max(outcome.substep, world.substepLength());
    progress.show(done + share * (frame + 1) / scene.frames, "runs");
  }
  outcome.summary = recorder.summary();
  return outcome;
}

std::string lastPart(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

std::vector<Column> columnsOf(const std::vector<Sweep>& sweeps, const std::vector<Outcome>& outcomes) {
  std::vector<Column> columns;
  const std::vector<Setting> settings = settingsOf(sweeps);
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    columns.push_back({lastPart(sweeps[s].key), sweeps[s].key, {}});
    for (const Setting& setting : settings) columns.back().values.push_back(setting[s]);
  }
  const auto add = [&](const char* title, const char* name, auto&& value) {
    columns.push_back({title, name, {}});
    for (const Outcome& o : outcomes) columns.back().values.push_back(value(o));
  };
  add("substep, us", "substep_us", [](const Outcome& o) { return rounded(1e6 * o.substep); });
  add("broken springs", "broken_springs",
      [](const Outcome& o) { return std::to_string(o.summary.counts.springsBroken); });
  add("crushed", "crushed", [](const Outcome& o) { return std::to_string(o.summary.counts.crushed); });
  add("dust, g", "dust_g", [](const Outcome& o) { return rounded(1e3 * o.summary.ledger.massDustEmitted); });
  add("exit speed, m/s", "exit_speed_m_s", [](const Outcome& o) {
    return o.summary.exitSpeed ? rounded(*o.summary.exitSpeed) : std::string("-");
  });
  add("energy error", "energy_error", [](const Outcome& o) { return rounded(o.summary.ledger.energyError); });
  add("ms a frame", "ms_per_frame",
      [](const Outcome& o) { return rounded(1000 * o.summary.seconds / o.summary.frames); });
  return columns;
}

TextRows rowsOf(const std::vector<Column>& columns, std::string Column::*heading) {
  TextRows rows(1 + columns.front().values.size());
  for (const Column& c : columns) {
    rows[0].push_back(c.*heading);
    for (std::size_t row = 0; row < c.values.size(); ++row) rows[row + 1].push_back(c.values[row]);
  }
  return rows;
}

// The arguments that make this report again.
std::string argumentsOf(const ReportOptions& options) {
  std::string text = options.scene;
  for (const Override& o : options.overrides)
    text += o.source == "--set" ? " --set " + o.path + "=" + o.value : " " + o.source + " " + o.value;
  for (const Sweep& sweep : options.sweeps) {
    text += " --sweep " + sweep.key + "=";
    for (const std::string& value : sweep.values)
      text += (&value == &sweep.values.front() ? "" : ";") + value;
  }
  return text;
}

}  // namespace

Sweep parseSweep(const std::string& text) {
  const Override first = parseOverride(text, "--sweep");
  Sweep sweep{first.path, {}};
  std::istringstream values(first.value);
  for (std::string value; std::getline(values, value, ';');) {
    if (value.empty()) throw InputError("--sweep", text, "has an empty value, must be key.path=value;value");
    sweep.values.push_back(value);
  }
  if (sweep.values.empty()) throw InputError("--sweep", text, "has no value, must be key.path=value;value");
  return sweep;
}

std::vector<Sweep> defaultSweeps() {
  return {{"precision", {"float", "double"}}, {"substep_safety", {"0.9", "0.45", "0.225"}}};
}

std::string reportHash(const ReportOptions& options, std::span<const SolverVersion> versions) {
  return settingsHash(scenesOf(options), versions);
}

void report(const ReportOptions& options, std::ostream& out) {
  const std::vector<Scene> scenes = scenesOf(options);
  const std::filesystem::path folder = options.folder.empty() ? "out/report" : options.folder;
  const std::filesystem::path csv = folder / (scenes.front().name + ".csv");
  std::optional<MarkedText> document;
  if (!options.write.empty()) document.emplace(options.write, "rubble report " + argumentsOf(options));
  checkFolder("--out", folder);
  checkFile("--out", csv, folder);
  makeFolder(folder);

  Progress progress("report");
  std::vector<Outcome> outcomes;
  const double share = 1.0 / double(scenes.size());
  for (const Scene& scene : scenes)
    outcomes.push_back(measure(scene, options.cache, progress, share * double(outcomes.size()), share));

  const std::vector<Column> columns = columnsOf(sweepsOf(options), outcomes);
  const std::string markdown = markdownTable(rowsOf(columns, &Column::title));
  out << markdown;
  writeWhole(csv, csvTable(rowsOf(columns, &Column::name)));
  out << "table: " << csv.string() << '\n';
  if (!document) return;
  document->replace(markdown + "\nMilliseconds are of one core of " + machineName() + ".\n",
                    reportHash(options));
  out << "written: " << options.write.string() << '\n';
}

}  // namespace rubble::demo
