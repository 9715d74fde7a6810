// `rubble report SCENE`: the same scene at several settings, as a table. Error against run time first of all,
// but any key can be swept.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "demo/asset_cache.h"
#include "demo/scene.h"
#include "rubble/version.h"

namespace rubble::demo {

/// A key and the values it takes, one run each.
struct Sweep {
  std::string key;
  std::vector<std::string> values;  ///< JSON or bare words, as in --set
};
/// Splits `key.path=value;value;...`. Throws InputError.
Sweep parseSweep(const std::string& text);

struct ReportOptions {
  std::string scene;
  std::vector<Override> overrides;  ///< of all runs
  /// Empty: precision and substep, see defaultSweeps.
  std::vector<Sweep> sweeps;
  std::filesystem::path folder;  ///< of the CSV; empty: out/report
  CacheOptions cache = {};       ///< of cooked objects
  std::filesystem::path write;   ///< a Markdown file that holds this report's markers; empty: none
};

/// Float and double, each at the scene's substep, a half and a quarter of it.
std::vector<Sweep> defaultSweeps();

/// What the numbers of a report depend on: every key of every scene in it, and the version of the solver, of
/// the debris and of the emitted dust. As 16 hexadecimal digits.
std::string reportHash(const ReportOptions& options,
                       std::span<const SolverVersion> versions = kSolverVersions);

/// Runs every combination without pictures and dust, prints a Markdown table, writes it as SCENE.csv and, if
/// asked, between the markers of a Markdown file. Throws InputError before the first run when a setting or a
/// file is wrong, MachineError, RunStopped.
void report(const ReportOptions& options, std::ostream& out);

}  // namespace rubble::demo
