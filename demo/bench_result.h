// What `rubble bench paper` found, and how it is written down.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demo/markdown_table.h"

namespace rubble::demo {

/// Means over the frames of one run.
struct BenchTimes {
  double total = 0;       ///< a whole frame [ms]
  double simulation = 0;  ///< elements, debris and Bullet [ms]
  double dust = 0;        ///< the grid [ms]
  double pictures = 0;    ///< drawn and read back, not saved [ms]
  double substeps = 0;    ///< of the elements, in a frame
  double cores = 0;       ///< processor time of all threads over wall time
  int frames = 0;

  double fps() const { return 1000 / total; }
};

/// One line of the table.
struct BenchRow {
  std::string part;  ///< "a" to "d" of the paper's table, or "figure 6" to "figure 8"
  std::string scene;
  int elements = 0;
  int width = 0, height = 0;  ///< of the pictures [pixels]; 0: none
  int dust = 0;               ///< cells of the grid along each axis
  std::optional<double> paperFps;
  BenchTimes times;

  bool pictures() const { return width > 0; }
};

/// What the times were taken on.
struct BenchMachine {
  std::string name;      ///< machineName()
  int processors = 0;    ///< that the system has
  int dustThreads = 0;   ///< of the dust grid, where it is computed on the processor
  std::string renderer;  ///< as OpenGL names it; empty without pictures
  double load = -1;      ///< of the system's last minute, before the first run; negative: unknown
};

/// Names of the CSV's columns.
extern const std::vector<std::string> kBenchColumns;

/// The table with its heading: kBenchColumns, one row a BenchRow.
TextRows benchCsv(const std::vector<BenchRow>& rows, const BenchMachine& machine);

/// The table and what is to know to read it.
std::string benchMarkdown(const std::vector<BenchRow>& rows, const BenchMachine& machine);

/// Frames a second, the paper's and ours.
std::string benchSvg(const std::vector<BenchRow>& rows, const BenchMachine& machine);

}  // namespace rubble::demo
