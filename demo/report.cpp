#include "demo/report.h"

#include <fstream>
#include <iomanip>
#include <vector>

#include "demo/console.h"
#include "demo/frame.h"
#include "demo/input_error.h"
#include "demo/progress.h"

namespace rubble::demo {
namespace {

struct Row {
  Precision precision;
  double substep;  // [s]
  Summary summary;
};

Row measure(const Scene& scene, const Assets& assets, Progress& progress, double done, double share) {
  World world(scene, assets, consoleLog());
  Recorder recorder(world, {}, {});
  FrameParts parts{.world = &world, .recorder = &recorder};
  double substep = 0;
  for (int frame = 0; frame < scene.frames; ++frame) {
    runFrame(parts, frame);
    substep = std::max(substep, world.substepLength());
    progress.show(done + share * (frame + 1) / scene.frames, "runs");
  }
  return {scene.precision, substep, recorder.summary()};
}

// `separator` between cells; a Markdown row also begins and ends with one.
void writeRow(std::ostream& out, const Row& row, const char* separator) {
  out << (row.precision == Precision::Float ? "float" : "double") << separator << row.substep * 1e6
      << separator << row.summary.counts.springsBroken << separator << row.summary.counts.crushed << separator
      << row.summary.exitSpeed.value_or(0) << separator << row.summary.ledger.energyError << separator
      << 1000 * row.summary.seconds / row.summary.frames;
}

std::ofstream openTable(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  std::ofstream table(file);
  if (!table) throw InputError("--out", file.string(), "cannot be written, must be in a folder that can");
  return table;
}

std::vector<Row> measureAll(const Scene& wholeScene, const Assets& assets) {
  const std::vector<double> shares = {1, 0.5, 0.25};  // of the scene's substep
  constexpr double kRuns = 6;
  Progress progress("report");
  std::vector<Row> rows;
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    for (const double share : shares) {
      Scene scene = wholeScene;
      scene.precision = precision;
      scene.substepSafety *= share;
      rows.push_back(measure(scene, assets, progress, double(rows.size()) / kRuns, 1 / kRuns));
    }
  }
  return rows;
}

}  // namespace

void reportSubsteps(const Scene& wholeScene, std::filesystem::path folder, std::ostream& out) {
  if (folder.empty()) folder = std::filesystem::path("out") / "report";
  const std::filesystem::path file = folder / (wholeScene.name + ".csv");
  Scene scene = wholeScene;
  scene.dust.reset();  // it does not act back on the mechanics
  const Assets assets = cookWithProgress(scene);
  std::ofstream table = openTable(file);
  const std::vector<Row> rows = measureAll(scene, assets);

  table << "precision,substep_us,broken_springs,crushed,exit_speed_m_s,energy_error,ms_per_frame\n";
  out << "| precision | substep, us | broken springs | crushed | exit speed, m/s | energy error | ms a frame "
         "|\n"
      << "|---|---|---|---|---|---|---|\n"
      << std::setprecision(3);
  for (const Row& row : rows) {
    writeRow(table, row, ",");
    table << '\n';
    out << "| ";
    writeRow(out, row, " | ");
    out << " |\n";
  }
  out << "table: " << file.string() << '\n';
  if (!table.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace rubble::demo
