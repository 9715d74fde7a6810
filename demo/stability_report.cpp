#include "demo/stability_report.h"

#include <optional>
#include <sstream>

#include "base/hash.h"
#include "demo/commit.h"
#include "demo/csv_table.h"
#include "demo/machine.h"
#include "demo/marked_text.h"
#include "demo/output_file.h"
#include "demo/progress.h"
#include "demo/stability/known_faults.h"

namespace rubble::demo {
namespace {

// Raised by hand when a run or its judgement changes and the words of the cases do not.
constexpr std::uint64_t kStabilityRevision = 3;

// The arguments that make this report again.
std::string stabilityArguments(const StabilityReportOptions& options) {
  std::string text = kStabilityReportName;
  if (options.cases == kQuickStabilityCases) return text + " --quick";
  return options.cases == kStabilityCases ? text : text + " --cases " + std::to_string(options.cases);
}

std::string stabilityNotes(std::span<const StabilityResult> results) {
  return "Stable: to the end without a warning. Degraded: to the end, and a warning told what was not done "
         "as "
         "asked. Refused: when it was loaded, with the reason. Stopped: with body and cause. Promise broken: "
         "a "
         "number that is not finite, an element faster than all energy makes it, or held at the end of a "
         "tick " +
         rounded(100 * stability::kEnergyTolerance) +
         " % more energy than was put in. "
         "Stock Bullet has a rigid box of the same size, mass, friction and "
         "restitution in place of the body, the same ticks and the same bar; a body "
         "that the application spoiled itself is held against neither.\n\nCommit " +
         commitName() + ", " + machineName() + ".\n" + brokenPromises(results);
}

}  // namespace

StabilityResult stabilityResult(int number) {
  StabilityResult result{stability::stabilityCase(number), {}, {}};
  result.outcome = stability::run(result.definition);
  // Where Rubble did not go on to the end, stock Bullet does.
  const bool ended = kindOf(result.outcome) <= std::size_t(stability::Outcome::Kind::Degraded);
  result.stock = stability::runStock(result.definition, ended ? result.outcome.ticks : stability::kMostTicks);
  return result;
}

std::string brokenPromises(std::span<const StabilityResult> results) {
  std::string text;
  for (const StabilityResult& r : results) {
    if (r.outcome.violations.empty()) continue;
    const char* known = stability::knownFault(r.definition.number);
    text += "\nCase " + std::to_string(r.definition.number) + " breaks the promise, " +
            (known ? std::string("a known fault: ") + known : r.outcome.violations.front()) + ".\n";
  }
  return text;
}

std::string stabilityReportHash(int cases, std::span<const SolverVersion> versions) {
  base::Fnv1a hash;
  const auto add = [&](const std::string& text) { hash.add(std::as_bytes(std::span(text))); };
  hash.add(kStabilityRevision);
  hash.add(stability::kEnergyTolerance);
  hash.add(stability::kWorkBudget);
  for (int n = 0; n < cases; ++n) add(describe(stability::stabilityCase(n)) + "\n");
  for (const stability::KnownFault& fault : stability::kKnownFaults) add(fault.what);
  for (const SolverVersion& version : versions) hash.add(version.world);
  return hashText(hash.value());
}

void stabilityReport(const StabilityReportOptions& options, std::ostream& out) {
  const std::filesystem::path folder = options.folder.empty() ? "out/report" : options.folder;
  const std::filesystem::path csv = folder / "stability.csv", svg = folder / "stability.svg";
  std::optional<MarkedText> document;
  if (!options.write.empty()) document.emplace(options.write, "rubble report " + stabilityArguments(options));
  checkFolder("--out", folder);
  for (const std::filesystem::path& file : {csv, svg}) checkFile("--out", file, folder);
  makeFolder(folder);

  Progress progress("report");
  std::vector<StabilityResult> results;
  for (int n = 0; n < options.cases; ++n) {
    progress.show(double(n) / options.cases,
                  "case " + std::to_string(n + 1) + " of " + std::to_string(options.cases));
    results.push_back(stabilityResult(n));
  }
  progress.show(1, "all cases");
  HeatMap map = stabilityMap(results);
  std::istringstream paragraphs(stabilityNotes(results));
  for (std::string line; std::getline(paragraphs, line);)
    if (!line.empty()) map.notes.push_back(line);
  writeWhole(csv, csvTable(stabilityCsv(results)));
  writeWhole(svg, svgOf(map));
  const std::string markdown = markdownTable(stabilityTable(results)) + "\n" + stabilityNotes(results);
  out << markdown << '\n' << csv.string() << '\n' << svg.string() << '\n';
  if (!document) return;
  document->replace(markdown, stabilityReportHash(options.cases));
  out << "written: " << options.write.string() << '\n';
}

}  // namespace rubble::demo
