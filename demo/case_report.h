// `rubble report CASE...`: error against run time of setups with a known answer, as CSV, SVG and Markdown.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "demo/markdown_table.h"
#include "demo/report_case.h"
#include "rubble/version.h"

namespace rubble::demo {

struct CaseReportOptions {
  std::vector<std::string> cases;  ///< names of reportCases()
  bool all = false;                ///< every case, whatever `cases` holds
  bool quick = false;              ///< the quick runs only
  bool reference = false;          ///< no runs: makes the references of the cases anew
  bool keep = false;               ///< keeps the settings of those cases that have a reference, and no more
  std::filesystem::path folder;    ///< of CSV and SVG; empty: out/report
  std::filesystem::path write;     ///< a Markdown file that holds this report's markers; empty: none
};

/// A run and what it gave.
struct CaseRow {
  const CaseRun* run;
  CaseOutcome outcome;

  /// Of one core [ms per simulated second].
  double milliseconds() const { return 1e3 * outcome.processorSeconds / outcome.simulatedSeconds; }
};

/// All rows with a heading; where they were made in the last columns. Where an error is made of several
/// quantities they are in columns too, and two rows more hold their reference and its scatter.
TextRows caseCsv(const ReportCase& reportCase, std::span<const CaseRow> rows);

/// Error over milliseconds of one core per simulated second.
std::string caseSvg(const ReportCase& reportCase, std::span<const CaseRow> rows);

/// What the numbers depend on: the cases, their settings and the version of the solver; as 16 hexadecimal
/// digits.
std::string caseReportHash(const CaseReportOptions& options,
                           std::span<const SolverVersion> versions = kSolverVersions);

/// Runs the cases and writes CASE.csv and CASE.svg of each; prints a Markdown table of all and writes it, if
/// asked, between the markers of a Markdown file. Throws InputError before the first run when a name or a
/// file is wrong or a reference is of another solver, MachineError. With `reference`: makes the references of
/// those cases that have one, and nothing else. With `keep`: measures their settings, see kept_settings.h,
/// and nothing else.
void caseReport(const CaseReportOptions& options, std::ostream& out);

}  // namespace rubble::demo
