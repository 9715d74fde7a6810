// `rubble report stability`: what stiff and extreme generated cases come to, and stock Bullet beside them, as
// CSV, SVG and Markdown.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "demo/stability_table.h"
#include "rubble/version.h"

namespace rubble::demo {

/// The word that asks for it on the command line.
inline constexpr const char* kStabilityReportName = "stability";
inline constexpr int kStabilityCases = 500, kQuickStabilityCases = 50, kMostStabilityCases = 100000;

struct StabilityReportOptions {
  int cases = kStabilityCases;   ///< the first so many
  std::filesystem::path folder;  ///< of CSV and SVG; empty: out/report
  std::filesystem::path write;   ///< a Markdown file that holds this report's markers; empty: none
};

/// One case in both.
StabilityResult stabilityResult(int number);

/// Which cases broke the promise, and what is known of them.
std::string brokenPromises(std::span<const StabilityResult> results);

/// What the numbers depend on: the cases and the version of the solver; as 16 hexadecimal digits.
std::string stabilityReportHash(int cases, std::span<const SolverVersion> versions = kSolverVersions);

/// Runs the cases. Throws InputError before the first when a file is wrong, MachineError.
void stabilityReport(const StabilityReportOptions& options, std::ostream& out);

}  // namespace rubble::demo
