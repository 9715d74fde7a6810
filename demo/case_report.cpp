#include "demo/case_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/hash.h"
#include "demo/commit.h"
#include "demo/csv_table.h"
#include "demo/error_plot.h"
#include "demo/input_error.h"
#include "demo/kept_settings.h"
#include "demo/machine.h"
#include "demo/marked_text.h"
#include "demo/output_file.h"
#include "demo/progress.h"

namespace rubble::demo {
namespace {

constexpr double kLeastDrawn = 1e-9;  // an error of 0 has no place on a logarithmic axis

// Raised by hand when the physics of a case changes and its words do not.
constexpr std::uint64_t kRevision = 1;

std::vector<const ReportCase*> casesOf(const CaseReportOptions& options) {
  std::vector<const ReportCase*> cases;
  for (const ReportCase& c : reportCases())
    if (options.all || std::ranges::count(options.cases, c.name) > 0) cases.push_back(&c);
  for (const std::string& name : options.cases) {
    if (!findReportCase(name))
      throw InputError("report", name, "is no case, must be one of: " + reportCaseNames());
  }
  return cases;
}

std::vector<const CaseRun*> runsOf(const ReportCase& c, const CaseReportOptions& options) {
  std::vector<const CaseRun*> runs;
  for (const CaseRun& run : c.runs)
    if ((run.quick || !options.quick) && !(run.namedOnly && options.all)) runs.push_back(&run);
  return runs;
}

// The arguments that make this report again.
std::string argumentsOf(const CaseReportOptions& options) {
  std::string text = options.all ? " --all" : "";
  if (!options.all)
    for (const ReportCase* c : casesOf(options)) text += " " + c->name;
  return text + (options.quick ? " --quick" : "");
}

std::string errorText(const CaseRow& row) {
  return std::isfinite(row.outcome.error) ? rounded(row.outcome.error) : "failed";
}

// What an error is made of, in rows: the reference itself and its scatter.
void addReference(TextRows& table, const ReportCase& c, const CaseOutcome& outcome) {
  for (const bool isScatter : {false, true}) {
    std::vector<std::string> row = {c.name, isScatter ? "scatter of the reference, relative" : "reference",
                                    "", "", isScatter ? rounded(outcome.scatter) : ""};
    row.resize(table.front().size() - outcome.quantities.size());
    for (const CaseQuantity& quantity : outcome.quantities)
      row.push_back(rounded(isScatter ? quantity.scatter : quantity.expected));
    table.push_back(row);
  }
}

// The row that stands for a method: its default setting, or the least error.
const CaseRow& representative(std::span<const CaseRow> rows) {
  const auto standard = std::ranges::find_if(rows, [](const CaseRow& row) { return row.run->standard; });
  if (standard != rows.end()) return *standard;
  return *std::ranges::min_element(rows, {}, [](const CaseRow& row) {
    return std::isfinite(row.outcome.error) ? row.outcome.error : HUGE_VAL;
  });
}

// Rows of one method each.
std::vector<std::span<const CaseRow>> methodsOf(std::span<const CaseRow> rows) {
  std::vector<std::span<const CaseRow>> methods;
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && rows[end].run->method == rows[begin].run->method) ++end;
    methods.push_back(rows.subspan(begin, end - begin));
  }
  return methods;
}

void addSummary(TextRows& table, const ReportCase& c, std::span<const CaseRow> rows) {
  for (const std::span<const CaseRow> method : methodsOf(rows)) {
    const CaseRow& row = representative(method);
    table.push_back({c.name, row.run->method, row.run->setting + (row.run->standard ? " (default)" : ""),
                     errorText(row), rounded(row.milliseconds())});
  }
}

std::string notesOf(const std::vector<const ReportCase*>& cases) {
  std::string text;
  for (const ReportCase* c : cases)
    text += "\n`" + c->name + "`: " + c->what + ". Against " + c->closedForm + ". Error: " + c->error + "." +
            (c->note.empty() ? "" : " " + c->note + ".") + "\n";
  return text + "\nMilliseconds are of one core of " + machineName() + ". Seed " + std::to_string(kCaseSeed) +
         ", commit " + commitName() + ".\n";
}

// Of the cases that have one.
void makeReferences(const std::vector<const ReportCase*>& cases, std::ostream& out) {
  double all = 0, done = 0;  // [minutes]
  for (const ReportCase* c : cases) all += c->reference ? c->reference->minutes : 0;
  Progress progress("reference");
  for (const ReportCase* c : cases) {
    if (!c->reference) continue;
    const std::filesystem::path file = referenceFile(*c->reference);
    writeReference(*c->reference, file, [&](double share) {
      progress.show((done + share * c->reference->minutes) / all, c->name);
    });
    done += c->reference->minutes;
    out << "reference: " << file.string() << '\n';
  }
}

// Of the cases that have a reference.
void keepSettings(const std::vector<const ReportCase*>& cases, std::ostream& out) {
  Progress progress("settings");
  for (const ReportCase* c : cases) {
    if (!c->reference) continue;
    const std::filesystem::path file = settingsFile(*c->reference);
    const SceneReference reference = readReference(*c->reference, referenceFile(*c->reference));
    writeSettings(*c, reference, file, [&](double share) { progress.show(share, c->name); });
    out << "settings: " << file.string() << '\n';
  }
}

}  // namespace

TextRows caseCsv(const ReportCase& c, std::span<const CaseRow> rows) {
  TextRows table = {{"case", "method", "setting", "default", "error", "ms_per_simulated_second",
                     "simulated_s", "seed", "commit", "machine"}};
  for (const CaseRow& row : rows)
    table.push_back({c.name, row.run->method, row.run->setting, row.run->standard ? "1" : "0", errorText(row),
                     rounded(row.milliseconds()), rounded(row.outcome.simulatedSeconds),
                     std::to_string(kCaseSeed), commitName(), machineName()});
  if (rows.empty() || rows.front().outcome.quantities.empty()) return table;
  for (const CaseQuantity& quantity : rows.front().outcome.quantities) table[0].push_back(quantity.name);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const CaseQuantity& quantity : rows[i].outcome.quantities)
      table[i + 1].push_back(std::isfinite(quantity.value) ? rounded(quantity.value) : "failed");
  addReference(table, c, rows.front().outcome);
  return table;
}

std::string caseSvg(const ReportCase& c, std::span<const CaseRow> rows) {
  ErrorPlot plot{.title = c.what,
                 .timeAxis = "ms of one core per simulated second",
                 .errorAxis = c.error,
                 .lines = {},
                 .level = rows.empty() ? 0 : rows.front().outcome.scatter,
                 .levelName = "scatter of the reference",
                 .notes = {"Against " + c.closedForm + ".", "On " + machineName() + ".",
                           "Seed " + std::to_string(kCaseSeed) + ", commit " + commitName() + "."}};
  if (!c.note.empty()) plot.notes.push_back(c.note + ".");
  bool tooSmall = false;
  for (const std::span<const CaseRow> method : methodsOf(rows)) {
    plot.lines.push_back({method.front().run->method, {}});
    for (const CaseRow& row : method) {
      if (!std::isfinite(row.outcome.error)) {
        plot.notes.push_back("Failed: " + row.run->method + ", " + row.run->setting + ".");
        continue;
      }
      tooSmall = tooSmall || row.outcome.error < kLeastDrawn;
      plot.lines.back().points.push_back(
          {row.milliseconds(), std::max(row.outcome.error, kLeastDrawn), row.run->standard});
    }
  }
  if (tooSmall) plot.notes.push_back("Errors below 1e-9 are drawn at 1e-9.");
  return svgOf(plot);
}

std::string caseReportHash(const CaseReportOptions& options, std::span<const SolverVersion> versions) {
  base::Fnv1a hash;
  const auto add = [&](const std::string& text) { hash.add(std::as_bytes(std::span(text))); };
  hash.add(kRevision);
  hash.add(kCaseSeed);
  for (const ReportCase* c : casesOf(options)) {
    for (const std::string& text : {c->name, c->what, c->closedForm, c->error}) add(text + "\n");
    if (!c->note.empty()) add(c->note + "\n");
    for (const CaseRun* run : runsOf(*c, options))  // a table without a peer is as true as one with it
      if (!run->isForeign) add(run->method + "\n" + run->setting + "\n");
    if (c->reference) add(referenceHash(*c->reference, versions));
  }
  for (const SolverVersion& version : versions) hash.add(version.world);
  return hashText(hash.value());
}

void caseReport(const CaseReportOptions& options, std::ostream& out) {
  const std::vector<const ReportCase*> cases = casesOf(options);
  if (options.reference) return makeReferences(cases, out);
  if (options.keep) return keepSettings(cases, out);
  for (const ReportCase* c : cases)
    if (c->reference) readReference(*c->reference, referenceFile(*c->reference));
  const std::filesystem::path folder = options.folder.empty() ? "out/report" : options.folder;
  std::optional<MarkedText> document;
  if (!options.write.empty()) document.emplace(options.write, "rubble report" + argumentsOf(options));
  checkFolder("--out", folder);
  makeFolder(folder);

  double all = 0, done = 0;  // [s], as the runs say
  for (const ReportCase* c : cases)
    for (const CaseRun* run : runsOf(*c, options)) all += run->seconds;
  Progress progress("report");
  TextRows table = {{"case", "method", "setting", "error", "ms a simulated second"}};
  std::string files;
  for (const ReportCase* c : cases) {
    std::vector<CaseRow> rows;
    for (const CaseRun* run : runsOf(*c, options)) {
      progress.show(done / all, c->name + ", " + run->method);
      rows.push_back({run, run->run()});
      done += run->seconds;
    }
    addSummary(table, *c, rows);
    for (const auto& [ending, text] :
         {std::pair(".csv", csvTable(caseCsv(*c, rows))), std::pair(".svg", caseSvg(*c, rows))}) {
      const std::filesystem::path file = folder / (c->name + ending);
      writeWhole(file, text);
      files += file.string() + '\n';
    }
  }
  progress.show(1, "all runs");
  const std::string markdown = markdownTable(table) + notesOf(cases);
  out << markdown << '\n' << files;
  if (!document) return;
  document->replace(markdown, caseReportHash(options));
  out << "written: " << options.write.string() << '\n';
}

}  // namespace rubble::demo
