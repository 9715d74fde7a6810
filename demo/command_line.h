// The arguments of the program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demo/bench_paper.h"
#include "demo/case_report.h"
#include "demo/cook.h"
#include "demo/material_report.h"
#include "demo/report.h"
#include "demo/run.h"
#include "demo/scene.h"
#include "demo/size_report.h"
#include "demo/stability_report.h"
#include "demo/view.h"

namespace rubble::demo {

struct CommandLine {
  enum class Command {
    Run,
    View,
    Info,
    Report,
    CaseReport,
    MaterialReport,
    SizeReport,
    StabilityReport,
    BenchPaper,
    Cook
  };
  Command command = Command::Run;
  std::string scene;  ///< empty for BenchPaper, Cook and reports of no scene
  std::vector<Override> overrides;
  std::optional<double> error;  ///< Run: no more than that, at the cheapest setting
  RunOptions run;
  ViewOptions view;
  ReportOptions report;
  CaseReportOptions caseReport;
  MaterialReportOptions materialReport;
  SizeReportOptions sizeReport;
  StabilityReportOptions stabilityReport;
  BenchPaperOptions benchPaper;
  CookFileOptions cook;
};

/// The text of --help or --version was asked for: ends the program with exit code 0.
struct HelpWanted {
  std::string text;
};

/// Throws InputError, or HelpWanted.
CommandLine parseCommandLine(int argc, char** argv);

}  // namespace rubble::demo
