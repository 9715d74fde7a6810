// Physical setups with a known answer, which `rubble report CASE` runs at several settings.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "demo/scene_reference.h"

namespace rubble::demo {

/// One of several numbers that an error is made of.
struct CaseQuantity {
  std::string name;     ///< with its unit
  double value = 0;     ///< not finite: the method failed
  double expected = 0;  ///< what the answer says
  double scatter = 0;   ///< of `expected`, relative
};

/// What one run gave.
struct CaseOutcome {
  double error = 0;             ///< as ReportCase::error says; not finite: the method failed
  double processorSeconds = 0;  ///< of the steps alone, not of what was made before them
  double simulatedSeconds = 0;  ///< > 0
  double scatter = 0;           ///< an error no greater is none of the method; 0: the answer is exact
  std::vector<CaseQuantity> quantities = {};  ///< empty, or the same names in each run of a case
};

/// A method at one setting.
struct CaseRun {
  std::string method;     ///< a line of the plot; runs of a method stand together
  std::string setting;    ///< what is swept, with its values
  bool standard = false;  ///< what a body gets that sets nothing
  bool quick = false;     ///< in `--quick` too
  std::function<CaseOutcome()> run;
  double seconds = 1;                  ///< about how long it takes, for the time left
  std::vector<Override> changes = {};  ///< that the setting makes to the case's scene, where it has one
  bool namedOnly = false;              ///< not in `--all`: in reports that name its case
  bool isForeign = false;              ///< of a program that is not installed everywhere
};

struct ReportCase {
  std::string name;        ///< as on the command line
  std::string what;        ///< the setup in one sentence
  std::string closedForm;  ///< what it is compared with
  std::string error;       ///< what the error is, and its unit
  std::vector<CaseRun> runs;
  std::optional<ReferenceDef> reference = {};  ///< of a scene; none: a closed form
  std::string note = {};                       ///< a sentence on the methods; empty: none
};

/// Seed of every packing in them.
inline constexpr std::uint64_t kCaseSeed = 1;

/// All cases, in the order in which they are run.
const std::vector<ReportCase>& reportCases();

/// Their names, "cantilever, bounce".
std::string reportCaseNames();
/// Of those that are compared with a reference.
std::string referenceCaseNames();

/// The case of that name; null: there is none.
const ReportCase* findReportCase(const std::string& name);

}  // namespace rubble::demo
