#include "demo/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <thread>

#include "demo/info.h"
#include "demo/input_error.h"
#include "demo/setting_choice.h"
#include "rubble/material.h"

namespace rubble::demo {
namespace {

constexpr int kLargestPicture = 8192;  // [pixels]
constexpr int kMostThreads = 256;
constexpr double kShortestDirection = 1e-9;

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 the machine failed (disk, memory, OpenGL, ffmpeg); 2 bad input, nothing was "
    "written;\n"
    "3 the run was stopped because its numbers can no longer be trusted. Errors are one line on stderr.";

// What CLI11 fills in before it is checked.
struct Raw {
  std::string size = "1280x720";
  std::vector<std::string> sets, sweeps, reported, anchorBoxes;
  std::optional<std::string> frames, seed, anchor, error;
  std::optional<int> cases;
  std::filesystem::path cache;
  bool noRender = false, noCache = false;
};

int defaultThreads() {
  constexpr unsigned kEnough = 8;  // the dust grid gains little beyond
  return int(std::clamp(std::thread::hardware_concurrency(), 1u, kEnough));
}

void parseSize(const std::string& text, int& width, int& height) {
  const auto isSide = [](int side) { return side >= 16 && side <= kLargestPicture; };
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  const bool hasCross = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  const auto second = hasCross ? std::from_chars(first.ptr + 1, end, height) : first;
  if (!hasCross || second.ec != std::errc() || second.ptr != end || !isSide(width) || !isSide(height)) {
    throw InputError("--size", text, "is not a size, must be WIDTHxHEIGHT with 16 to 8192 pixels each");
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// An empty path means "the default" further on, so it may not be given.
void addPath(CLI::App& app, const std::string& option, std::filesystem::path& path,
             const std::string& meaning) {
  app.add_option(option, path, meaning)->check([option](const std::string& text) {
    if (text.empty()) throw InputError(option, "", "is empty, must be a path");
    return std::string();
  });
}

// "x,y,z"
// Numbers between commas, as many as `numbers`; false if it is anything else.
bool parseNumbers(const std::string& text, std::span<double> numbers) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const auto [next, error] = std::from_chars(at, end, numbers[n]);
    const bool isLast = n + 1 == numbers.size();
    if (error != std::errc() || (isLast ? next != end : next == end || *next != ',')) return false;
    at = next + 1;
  }
  return true;
}

Eigen::Vector3d parseDirection(const std::string& option, const std::string& text) {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  if (!parseNumbers(text, {direction.data(), 3}))
    throw InputError(option, text, "is no direction, must be x,y,z");
  if (!(direction.norm() > kShortestDirection) || !std::isfinite(direction.norm()))
    throw InputError(option, text, "has no direction, must be x,y,z, not 0,0,0");
  return direction;
}

// Of two opposite corners, whichever come first.
Eigen::AlignedBox3d parseBox(const std::string& option, const std::string& text) {
  std::array<double, 6> numbers{};
  if (!parseNumbers(text, numbers) ||
      !std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
    throw InputError(option, text, "is no box, must be x,y,z,x,y,z, two opposite corners in metres");
  Eigen::AlignedBox3d box(Eigen::Vector3d(numbers[0], numbers[1], numbers[2]));
  return box.extend(Eigen::Vector3d(numbers[3], numbers[4], numbers[5]));
}

void addSceneOptions(CLI::App& app, CommandLine& line, Raw& raw, bool withScene = true) {
  const std::string meaning = "a name (" + sceneNames() + "), or path of a JSON file";
  if (withScene) app.add_option("SCENE", line.scene, meaning)->required();
  app.add_option("--set", raw.sets, "key.path=value: change the scene; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--frames", raw.frames, "number of frames");
  app.add_option("--seed", raw.seed, "seed of packing and debris");
  app.add_option("--threads", line.run.threads, "of the dust grid")->check(CLI::Range(1, kMostThreads));
  addPath(app, "--cache", raw.cache,
          "folder where cooked objects are kept for the next run, default $XDG_CACHE_HOME/rubble or "
          "~/.cache/rubble; the oldest beyond 1 GiB go");
  app.add_flag("--no-cache", raw.noCache, "cook all objects anew and keep none")->excludes("--cache");
}

CacheOptions cacheOf(const Raw& raw) {
  if (raw.noCache) return {};
  if (raw.cache.empty()) return {.folder = usualCacheFolder()};
  return {.folder = raw.cache, .isAsked = true};
}

void addCook(CLI::App& app, CookFileOptions& options, Raw& raw) {
  CLI::App* cook = app.add_subcommand("cook", "make a .rubble-asset file of a closed surface");
  cook->add_option("MESH", options.mesh, "OBJ, OFF, PLY or STL")->required();
  addPath(*cook, "-o,--output", options.asset, "the asset, ends in .rubble-asset");
  cook->get_option("--output")->required();
  cook->add_option("--elements", options.elements, "how many elements it is cut into, default 2048")
      ->check(CLI::NonNegativeNumber);
  cook->add_option("--radius", options.radius,
                   "of the elements [m], default chosen; alone, as many are made as fit");
  cook->add_option("--material", options.material,
                   "preset that the asset keeps (" + listed(materialNames()) +
                       "): what objects of it are made of where a scene does not say");
  cook->add_option("--scale", options.scale, "length of one unit of the mesh [m], default 1");
  cook->add_flag(
      "--repair", options.repair,
      "mend the surface first: weld corners, turn triangles, fill holes, unite parts that overlap");
  cook->add_option("--anchor", raw.anchor, "x,y,z: the flat side that faces this way is tied to the world");
  cook->add_option(
          "--anchor-box", raw.anchorBoxes,
          "x,y,z,x,y,z: two corners [m]; outer faces in this box are tied to the world, may be repeated")
      ->allow_extra_args(false);
  cook->add_option("--seed", options.seed, "of the packing, default 1")->check(CLI::NonNegativeNumber);
}

void addBench(CLI::App& app, BenchPaperOptions& options, Raw& raw) {
  CLI::App* bench = app.add_subcommand("bench", "how fast it is beside others: paper");
  bench->require_subcommand(1);
  CLI::App* paper = bench->add_subcommand(
      "paper",
      "Table 1 of the paper, its frames a second beside those of this machine, and its figures 6 to 8");
  paper->add_option("--frames", options.frames, "of each run, default 60");
  paper->add_option(
      "--size", raw.size,
      "WIDTHxHEIGHT of the largest picture, default the paper's 1280x720; (a) has shares of it");
  paper->add_option("--most-elements", options.mostElements, "leave out runs of more elements")
      ->check(CLI::NonNegativeNumber);
  paper->add_flag("--no-render", raw.noRender, "leave out runs with pictures; no OpenGL");
  paper->add_option("--threads", options.threads, "of the dust grid")->check(CLI::Range(1, kMostThreads));
  addPath(*paper, "--csv", options.csv, "the table as comma-separated values");
  addPath(*paper, "--svg", options.svg, "the table as a bar chart");
  addPath(*paper, "--write", options.write,
          "Markdown file: writes the table between the markers of this very bench");
}

void addReport(CLI::App& app, CommandLine& line, Raw& raw) {
  CLI::App* report = app.add_subcommand("report", "error against run time, as Markdown, CSV and SVG");
  report->add_option("WHAT", raw.reported,
                     "cases with a known answer (" + reportCaseNames() + "), or " + kMaterialReportName +
                         " (what each preset reaches of its strength and stiffness), or " + kSizeReportName +
                         " (the wall in fewer and more elements), or " + kStabilityReportName +
                         " (what stiff and extreme generated cases come to), or one scene (" + sceneNames() +
                         ", or path of a JSON file)");
  report->add_flag("--all", line.caseReport.all, "all cases");
  report->add_flag("--quick", line.caseReport.quick,
                   std::string("of cases: fewer settings; of ") + kStabilityReportName + ": the first " +
                       std::to_string(kQuickStabilityCases));
  report->add_flag("--long", line.sizeReport.longest,
                   std::string("of ") + kSizeReportName + ": 32000 elements too, some five minutes more");
  report
      ->add_option("--cases", raw.cases,
                   std::string("of ") + kStabilityReportName + ": the first so many, default " +
                       std::to_string(kStabilityCases))
      ->check(CLI::Range(1, kMostStabilityCases));
  report->add_flag("--reference", line.caseReport.reference,
                   "of cases (" + referenceCaseNames() +
                       "): makes what they are compared with anew, in minutes, and runs nothing else");
  report->add_flag("--keep", line.caseReport.keep,
                   "of cases (" + referenceCaseNames() +
                       "): measures each setting and keeps errors and times beside the reference for rubble "
                       "run --error, in some ten minutes, and runs nothing else");
  addSceneOptions(*report, line, raw, false);
  addPath(*report, "--out", line.report.folder, "folder of the results, default out/report");
  report
      ->add_option("--sweep", raw.sweeps,
                   "of a scene: key.path=value;value...: runs with each; may be repeated. Default: "
                   "precision and substep")
      ->allow_extra_args(false);
  addPath(*report, "--write", line.report.write,
          "Markdown file: writes the table between the markers of this very report");
}

void addCommands(CLI::App& app, CommandLine& line, Raw& raw) {
  addCook(app, line.cook, raw);

  CLI::App* run = app.add_subcommand("run", "simulate a scene, write pictures and statistics");
  addSceneOptions(*run, line, raw);
  addPath(*run, "--out", line.run.out, "folder of the results, default out/SCENE");
  addPath(*run, "--stats", line.run.stats, "one JSON object a frame, default OUT/stats.jsonl");
  addPath(*run, "--events", line.run.events, "one JSON object an event");
  run->add_option("--size", raw.size, "WIDTHxHEIGHT of the pictures, default 1280x720");
  run->add_flag("--no-render", raw.noRender, "no pictures and no OpenGL");
  run->add_option(
      "--error", raw.error,
      "2% or 0.02: takes the cheapest setting (substep, precision, Bullet's ticks, regime) whose kept error "
      "is no more; of scenes that have kept ones (" +
          keptSceneNames() +
          "). It is the worst of three runs, each the root mean square of the relative differences of exit "
          "speed, broken springs, crushed mass and dust from the reference; it counts as no less than the "
          "scatter of the reference's own runs");

  CLI::App* view = app.add_subcommand("view", "simulate a scene in a window");
  addSceneOptions(*view, line, raw);
  view->add_option("--size", raw.size, "WIDTHxHEIGHT of the window, default 1280x720");

  CLI::App* info = app.add_subcommand("info", "what a scene or a .rubble-asset file holds and needs");
  addSceneOptions(*info, line, raw);

  addReport(app, line, raw);
  addBench(app, line.benchPaper, raw);
}

CommandLine::Command command(const CLI::App& app) {
  if (app.got_subcommand("bench")) return CommandLine::Command::BenchPaper;
  if (app.got_subcommand("cook")) return CommandLine::Command::Cook;
  if (app.got_subcommand("view")) return CommandLine::Command::View;
  if (app.got_subcommand("info")) return CommandLine::Command::Info;
  if (app.got_subcommand("report")) return CommandLine::Command::Report;
  return CommandLine::Command::Run;
}

// Whether `word` can only be meant as the name of a scene or a case.
bool isPath(const std::string& word) {
  return word.find('/') != std::string::npos || word.ends_with(".json") || isAssetFile(word);
}

bool isSceneName(const std::string& word) {
  return (", " + sceneNames() + ",").find(", " + word + ",") != std::string::npos;
}

// Of the options that write beside the references the one that is given; null: none.
const char* keepingOption(const CaseReportOptions& options) {
  return options.reference ? "--reference" : options.keep ? "--keep" : nullptr;
}

void refuseSceneOptions(const Raw& raw, const std::string& reported) {
  if (!raw.sets.empty() || !raw.sweeps.empty() || raw.frames || raw.seed)
    throw InputError("report", reported, "is no scene that --set, --sweep, --frames or --seed could change");
}

// References are made of cases that have one, all settings or none.
void checkReference(const CommandLine& line) {
  if (line.caseReport.reference && line.caseReport.keep)
    throw InputError("--keep", "", "needs a reference that is made, must be left out with --reference");
  const char* const kept = keepingOption(line.caseReport);
  if (!kept) return;
  for (const std::string& name : line.caseReport.cases)
    if (!findReportCase(name)->reference)
      throw InputError(kept, name, "has a closed form, must be one of: " + referenceCaseNames());
  const auto refuse = [&](const char* option) {
    throw InputError(option, "", std::string("means a report, must be left out with ") + kept);
  };
  if (line.caseReport.quick) refuse("--quick");
  if (!line.report.folder.empty()) refuse("--out");
  if (!line.report.write.empty()) refuse("--write");
}

void sortStability(CommandLine& line, const Raw& raw) {
  if (const char* kept = keepingOption(line.caseReport))
    throw InputError(kept, kStabilityReportName, "has no reference, must be left out");
  if (line.caseReport.quick && raw.cases)
    throw InputError("--quick", std::to_string(kQuickStabilityCases),
                     "is another number than that of --cases, one must be left out");
  refuseSceneOptions(raw, kStabilityReportName);
  line.command = CommandLine::Command::StabilityReport;
  const int standard = line.caseReport.quick ? kQuickStabilityCases : kStabilityCases;
  line.stabilityReport = {raw.cases.value_or(standard), line.report.folder, line.report.write};
}

void sortSizes(CommandLine& line, const Raw& raw) {
  if (const char* kept = keepingOption(line.caseReport))
    throw InputError(kept, kSizeReportName, "has no reference, must be left out");
  if (line.caseReport.quick && line.sizeReport.longest)
    throw InputError("--quick", "", "is fewer elements and --long more, one must be left out");
  refuseSceneOptions(raw, kSizeReportName);
  line.command = CommandLine::Command::SizeReport;
  line.sizeReport = {line.caseReport.quick, line.sizeReport.longest, line.report.folder, line.report.write};
}

// Several words are cases; one may be a scene, the materials, the sizes of elements or stability.
void sortReport(CommandLine& line, const Raw& raw) {
  CaseReportOptions& cases = line.caseReport;
  if (raw.reported.empty() && !cases.all)
    throw InputError("report", "",
                     "has nothing to do, must have --all, a scene, " + std::string(kMaterialReportName) +
                         ", " + kSizeReportName + ", " + kStabilityReportName +
                         ", or cases of: " + reportCaseNames());
  const auto isAsked = [&](const char* word) {
    return raw.reported == std::vector<std::string>{word} && !cases.all;
  };
  if (line.sizeReport.longest && !isAsked(kSizeReportName))
    throw InputError("--long", "", std::string("is of ") + kSizeReportName + ", must be left out");
  if (isAsked(kStabilityReportName)) return sortStability(line, raw);
  if (raw.cases)
    throw InputError("--cases", std::to_string(*raw.cases),
                     std::string("is of ") + kStabilityReportName + ", must be left out");
  if (isAsked(kSizeReportName)) return sortSizes(line, raw);
  const auto isCase = [](const std::string& word) { return findReportCase(word) != nullptr; };
  if (isAsked(kMaterialReportName)) {
    if (cases.quick) throw InputError("--quick", kMaterialReportName, "is no case, must be left out");
    if (const char* kept = keepingOption(cases))
      throw InputError(kept, kMaterialReportName, "is no case, must be left out");
    refuseSceneOptions(raw, kMaterialReportName);
    line.command = CommandLine::Command::MaterialReport;
    line.materialReport = {line.report.folder, line.report.write};
    return;
  }
  const auto stranger = std::ranges::find_if_not(raw.reported, isCase);
  if (raw.reported.size() == 1 && !cases.all && stranger != raw.reported.end()) {
    line.scene = *stranger;
    if (!line.scene.empty() && !isPath(line.scene) && !isSceneName(line.scene))
      throw InputError("report", line.scene,
                       "is no case and no scene, must be one of: " + reportCaseNames() + ", " + sceneNames() +
                           ", " + kMaterialReportName + ", " + kSizeReportName + ", " + kStabilityReportName +
                           ", or the path of a JSON file");
    if (cases.quick) throw InputError("--quick", line.scene, "is a scene, must be left out");
    if (const char* kept = keepingOption(cases))
      throw InputError(kept, line.scene, "is a scene, must be left out");
    return;
  }
  if (stranger != raw.reported.end())
    throw InputError("report", *stranger, "is no case, must be one of: " + reportCaseNames());
  refuseSceneOptions(raw, raw.reported.empty() ? "--all" : raw.reported.front());
  line.command = CommandLine::Command::CaseReport;
  cases.cases = raw.reported;
  cases.folder = line.report.folder;
  cases.write = line.report.write;
  checkReference(line);
}

// An asset has nothing to run and no keys to change.
void checkAsset(const CommandLine& line) {
  if (!isAssetFile(line.scene)) return;
  if (line.command != CommandLine::Command::Info)
    throw InputError(line.scene, "", "is an asset, must be a scene; rubble info tells what an asset holds");
  if (!line.overrides.empty())
    throw InputError(line.overrides.front().source, line.overrides.front().path,
                     "changes a scene and not an asset, must be left out");
}

}  // namespace

CommandLine parseCommandLine(int argc, char** argv) {
  CommandLine line;
  Raw raw;
  line.run.threads = line.benchPaper.threads = defaultThreads();
  CLI::App app("Rubble: destruction for Bullet", "rubble");
  app.set_version_flag("--version", RUBBLE_VERSION);
  app.require_subcommand(1);
  app.footer(kExitCodes);
  addCommands(app, line, raw);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw HelpWanted{app.help()};
  } catch (const CLI::CallForVersion& version) {
    throw HelpWanted{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    throw InputError("command line", "", std::string(error.what()) + ", see rubble --help");
  }
  line.command = command(app);
  if (line.command == CommandLine::Command::Cook) {
    if (line.cook.mesh.empty()) throw InputError("MESH", "", "is empty, must be a path");
    if (raw.anchor) line.cook.anchor = parseDirection("--anchor", *raw.anchor);
    for (const std::string& box : raw.anchorBoxes)
      line.cook.anchorBoxes.push_back(parseBox("--anchor-box", box));
    return line;
  }
  if (line.command == CommandLine::Command::BenchPaper) {
    line.benchPaper.render = !raw.noRender;
    parseSize(raw.size, line.benchPaper.width, line.benchPaper.height);
    return line;
  }
  if (line.command == CommandLine::Command::Report) sortReport(line, raw);
  if (line.command == CommandLine::Command::CaseReport ||
      line.command == CommandLine::Command::MaterialReport ||
      line.command == CommandLine::Command::SizeReport ||
      line.command == CommandLine::Command::StabilityReport)
    return line;
  if (line.scene.empty()) throw InputError("SCENE", "", "is empty, must be a name or a path");
  for (const std::string& set : raw.sets) line.overrides.push_back(parseOverride(set));
  for (const std::string& sweep : raw.sweeps) line.report.sweeps.push_back(parseSweep(sweep));
  line.report.scene = line.scene;
  if (raw.frames) line.overrides.push_back({"frames", *raw.frames, "--frames"});
  if (raw.seed) line.overrides.push_back({"seed", *raw.seed, "--seed"});
  if (raw.error) line.error = parseErrorShare(*raw.error);
  checkAsset(line);
  line.report.overrides = line.overrides;
  line.run.cache = line.view.cache = line.report.cache = cacheOf(raw);
  line.run.render = !raw.noRender;
  parseSize(raw.size, line.run.width, line.run.height);
  line.view.width = line.run.width;
  line.view.height = line.run.height;
  line.view.threads = line.run.threads;
  line.view.closeAtEnd = raw.frames.has_value();
  return line;
}

}  // namespace rubble::demo
