// `rubble bench paper`: the settings of the paper's Table 1, and its figures 6 to 8, timed here.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <span>
#include <string>

#include "demo/bench_result.h"
#include "demo/paper_table.h"
#include "rubble/version.h"

namespace rubble::demo {

struct BenchPaperOptions {
  /// Of each run, as the command line gives it. The standard: the first second, from before the blow to
  /// when debris and dust fly.
  std::string frames = "60";
  /// The largest picture [pixels]; (a) has the paper's shares of it.
  int width = PaperCell{}.width, height = PaperCell{}.height;
  std::optional<int> mostElements = {};  ///< runs with more are left out
  bool render = true;                    ///< false: runs with pictures are left out, no GL library is loaded
  int threads = 1;                       ///< of the dust grid
  std::filesystem::path csv = {}, svg = {};  ///< empty: not written
  std::filesystem::path write = {};          ///< a Markdown file that holds this bench's markers; empty: none
};

/// What the simulated part of the numbers depends on, as reportHash.
std::string benchPaperHash(const BenchPaperOptions& options,
                           std::span<const SolverVersion> versions = kSolverVersions);

/// Runs each distinct setting once, prints the table and writes what was asked for. Throws InputError before
/// the first run when an option or a file is wrong, MachineError, RunStopped.
void benchPaper(const BenchPaperOptions& options, std::ostream& out);

}  // namespace rubble::demo
