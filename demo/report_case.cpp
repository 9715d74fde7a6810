#include "demo/report_case.h"

#include <algorithm>

#include "demo/cases/cases.h"

namespace rubble::demo {

const std::vector<ReportCase>& reportCases() {
  static const std::vector<ReportCase> cases = {
      cantileverCase(),      supportedBeamCase(),  bounceCase(),     freeSpinCase(), slideCase(),
      reposeCase(),          rollCase(),           hungCase(),       waveCase(),     strengthCase(),
      springBreakCase(),     crushCase(),          debrisFallCase(), sieveCase(),    dustRotationCase(),
      dustTaylorGreenCase(), dustDivergenceCase(), dustPlumeCase(),  wallBlowCase(), columnBlowCase(),
      twoFragileBlowCase()};
  return cases;
}

std::string reportCaseNames() {
  std::string names;
  for (const ReportCase& c : reportCases()) names += (names.empty() ? "" : ", ") + c.name;
  return names;
}

std::string referenceCaseNames() {
  std::string names;
  for (const ReportCase& c : reportCases())
    if (c.reference) names += (names.empty() ? "" : ", ") + c.name;
  return names;
}

const ReportCase* findReportCase(const std::string& name) {
  const auto found = std::ranges::find(reportCases(), name, &ReportCase::name);
  return found == reportCases().end() ? nullptr : &*found;
}

}  // namespace rubble::demo
