#include "demo/bench_result.h"

#include <algorithm>

#include "demo/bar_chart.h"
#include "demo/paper_table.h"

namespace rubble::demo {
namespace {

std::string sizeOf(const BenchRow& row) {
  return row.pictures() ? std::to_string(row.width) + "x" + std::to_string(row.height) : "none";
}

std::string partOf(const BenchRow& row) {
  return row.part.size() == 1 ? "(" + row.part + ")" : row.part;
}

std::string rendererOf(const BenchMachine& machine) {
  return machine.renderer.empty() ? "none" : machine.renderer;
}

std::string framesOf(const std::vector<BenchRow>& rows) {
  const auto frames = [](const BenchRow& row) { return row.times.frames; };
  const int least = std::ranges::min(rows, {}, frames).times.frames;
  const int most = std::ranges::max(rows, {}, frames).times.frames;
  return least == most ? "the first " + std::to_string(most)
                       : "the first " + std::to_string(least) + " to " + std::to_string(most);
}

std::string machineLine(const BenchMachine& machine) {
  std::string line = machine.name + ", " + std::to_string(machine.processors) +
                     " processors; elements on one thread, dust grid on " +
                     std::to_string(machine.dustThreads) + "; pictures by " + rendererOf(machine);
  if (machine.load >= 0) line += "; load average before the first run " + rounded(machine.load);
  return line;
}

// Whether the largest picture is the paper's.
bool hasSizeOfPaper(const std::vector<BenchRow>& rows) {
  const BenchRow& largest = std::ranges::max(rows, {}, &BenchRow::width);
  return !largest.pictures() || (largest.width == PaperCell{}.width && largest.height == PaperCell{}.height);
}

std::vector<std::string> notesOf(const std::vector<BenchRow>& rows, const BenchMachine& machine) {
  std::vector<std::string> notes = {
      "Ours: " + machineLine(machine) + ".",
      "Paper: " + std::string(kPaperMachine) + ".",
      "Ours is the mean over " + framesOf(rows) +
          " frames of 1/60 s of each scene, pictures drawn and read " +
          "back, not saved. The paper tells neither its frames nor how long one is in the scene.",
  };
  notes.push_back(
      "(d) leaves out the pictures alone: the dust grid goes on, and the column dust tells what it takes. "
      "The "
      "paper tells not whether its fluid does.");
  if (!hasSizeOfPaper(rows))
    notes.push_back(
        "The largest picture is not of the paper's 1280x720; those of (a) have the paper's shares of it.");
  return notes;
}

}  // namespace

const std::vector<std::string> kBenchColumns = {"part",
                                                "scene",
                                                "elements",
                                                "width",
                                                "height",
                                                "dust_resolution",
                                                "paper_fps",
                                                "fps",
                                                "ms_per_frame",
                                                "ms_simulation",
                                                "ms_dust",
                                                "ms_pictures",
                                                "substeps_per_frame",
                                                "cores_used",
                                                "frames",
                                                "dust_threads",
                                                "processors",
                                                "load_average",
                                                "renderer",
                                                "machine"};

TextRows benchCsv(const std::vector<BenchRow>& rows, const BenchMachine& machine) {
  TextRows table = {kBenchColumns};
  for (const BenchRow& row : rows) {
    const BenchTimes& t = row.times;
    table.push_back({row.part,
                     row.scene,
                     std::to_string(row.elements),
                     std::to_string(row.width),
                     std::to_string(row.height),
                     std::to_string(row.dust),
                     row.paperFps ? rounded(*row.paperFps) : "",
                     rounded(t.fps()),
                     rounded(t.total),
                     rounded(t.simulation),
                     rounded(t.dust),
                     rounded(t.pictures),
                     rounded(t.substeps),
                     rounded(t.cores),
                     std::to_string(t.frames),
                     std::to_string(machine.dustThreads),
                     std::to_string(machine.processors),
                     machine.load < 0 ? "" : rounded(machine.load),
                     rendererOf(machine),
                     machine.name});
  }
  return table;
}

std::string benchMarkdown(const std::vector<BenchRow>& rows, const BenchMachine& machine) {
  TextRows table = {{"part", "scene", "elements", "pictures", "dust grid", "paper, fps", "ours, fps",
                     "ms a frame", "of it simulation", "dust", "pictures", "substeps a frame", "cores used"}};
  for (const BenchRow& row : rows) {
    const BenchTimes& t = row.times;
    table.push_back({partOf(row), row.scene, std::to_string(row.elements), sizeOf(row),
                     std::to_string(row.dust) + "^3", row.paperFps ? rounded(*row.paperFps) : "-",
                     rounded(t.fps()), rounded(t.total), rounded(t.simulation), rounded(t.dust),
                     row.pictures() ? rounded(t.pictures) : "-", rounded(t.substeps), rounded(t.cores)});
  }
  std::string text = markdownTable(table);
  for (const std::string& note : notesOf(rows, machine)) text += "\n" + note + "\n";
  return text;
}

std::string benchSvg(const std::vector<BenchRow>& rows, const BenchMachine& machine) {
  BarChart chart{.title = "Table 1 of the paper and the same settings here",
                 .axis = "frames a second",
                 .first = "paper",
                 .second = "ours",
                 .rows = {},
                 .notes = notesOf(rows, machine)};
  for (const BenchRow& row : rows) {
    chart.rows.push_back({partOf(row) + ", " + std::to_string(row.elements) + " elements, " + sizeOf(row) +
                              ", dust " + std::to_string(row.dust) + "^3",
                          row.paperFps, row.times.fps()});
  }
  return svgOf(chart);
}

}  // namespace rubble::demo
