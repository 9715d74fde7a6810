#include "demo/kept_settings.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "demo/commit.h"
#include "demo/input_error.h"
#include "demo/machine.h"
#include "demo/output_file.h"
#include "demo/settings_hash.h"

namespace rubble::demo {
namespace {

using SettingsDocument = nlohmann::ordered_json;

constexpr std::size_t kRuns = 3;  // of each setting, by the first shifts of the reference's
constexpr const char* kSettingsEnding = "_settings.json";

std::filesystem::path keptFolder() {
  return sceneFolder().parent_path() / "references";
}

// Of the scenes, sorted.
std::vector<std::string> keptNames() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(keptFolder(), error)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with(kSettingsEnding)) names.push_back(file.substr(0, file.rfind(kSettingsEnding)));
  }
  std::ranges::sort(names);
  return names;
}

double largestDifference(std::span<const SceneQuantity> found, std::span<const SceneQuantity> expected) {
  double largest = 0;
  for (std::size_t q = 0; q < found.size(); ++q)
    if (expected[q].inError) largest = std::max(largest, std::abs(found[q].value / expected[q].value - 1));
  return largest;
}

KeptSetting measured(const ReferenceDef& def, const SceneReference& reference, const CaseRun& run,
                     const std::function<void(double)>& shown) {
  KeptSetting setting{run.method + ", " + run.setting, run.standard, run.changes, {}, 0, HUGE_VAL};
  for (std::size_t i = 0; i < kRuns; ++i) {
    const auto share = [&](double ofRun) { shown((double(i) + ofRun) / double(kRuns)); };
    try {
      const SceneOutcome outcome = runToEnd(comparedScene(def, run.changes, kBlowShifts[i]), share);
      requireSameQuantities(def, reference, outcome);
      setting.errors.push_back(relativeDifference(outcome.quantities, reference.quantities));
      setting.largest =
          std::max(setting.largest, largestDifference(outcome.quantities, reference.quantities));
      setting.milliseconds =
          std::min(setting.milliseconds, 1e3 * outcome.processorSeconds / outcome.simulatedSeconds);
    } catch (const RunStopped&) {
      setting.errors.push_back(HUGE_VAL);
    }
  }
  return setting;
}

// JSON knows no infinity, and null stands for it.
SettingsDocument settingDocument(const KeptSetting& setting) {
  SettingsDocument changes = SettingsDocument::object(), errors = SettingsDocument::array();
  for (const Override& change : setting.changes) changes[change.path] = change.value;
  for (const double error : setting.errors)
    errors.push_back(std::isfinite(error) ? SettingsDocument(error) : SettingsDocument());
  return {
      {"name", setting.name},
      {"default", setting.standard},
      {"set", changes},
      {"errors", errors},
      {"largest_difference", setting.largest},
      {"ms_per_simulated_second",
       std::isfinite(setting.milliseconds) ? SettingsDocument(setting.milliseconds) : SettingsDocument()}};
}

SettingsDocument settingsDocument(const KeptSettings& kept) {
  SettingsDocument document = {
      {"made_by", kept.madeBy},        {"commit", commitName()},
      {"machine", machineName()},      {"scene", kept.scene},
      {"scene_hash", kept.sceneHash},  {"solver_hash", kept.solverHash},
      {"simulated_s", kept.simulated}, {"blow_shifted_m", std::vector(kBlowShifts, kBlowShifts + kRuns)},
      {"scatter", kept.scatter},       {"settings", SettingsDocument::array()}};
  for (const KeptSetting& setting : kept.settings) document["settings"].push_back(settingDocument(setting));
  return document;
}

double numberOrInfinity(const SettingsDocument& json) {
  return json.is_null() ? HUGE_VAL : json.get<double>();
}

KeptSetting settingIn(const SettingsDocument& json) {
  KeptSetting setting{.name = json.at("name").get<std::string>(),
                      .standard = json.at("default").get<bool>(),
                      .changes = {},
                      .errors = {},
                      .largest = json.at("largest_difference").get<double>(),
                      .milliseconds = numberOrInfinity(json.at("ms_per_simulated_second"))};
  for (const auto& [path, value] : json.at("set").items())
    setting.changes.push_back({path, value.get<std::string>(), "--error"});
  for (const SettingsDocument& error : json.at("errors")) setting.errors.push_back(numberOrInfinity(error));
  return setting;
}

}  // namespace

double KeptSettings::errorOf(const KeptSetting& setting) const {
  double worst = setting.errors.empty() ? HUGE_VAL : scatter;
  for (const double error : setting.errors) worst = std::max(worst, error);
  return worst;
}

std::string comparedHash(const Scene& scene) {
  Scene compared = scene;
  compared.frames = Scene().frames;
  compared.dust.reset();  // it does not act back on the mechanics
  return settingsHash({&compared, 1}, {});
}

void writeSettings(const ReportCase& reportCase, const SceneReference& reference,
                   const std::filesystem::path& file, const std::function<void(double)>& shown) {
  const ReferenceDef& def = *reportCase.reference;
  checkFile("--keep", file, file.parent_path());
  const Scene scene = comparedScene(def, {});
  KeptSettings kept{.scene = scene.name,
                    .madeBy = "rubble report " + reportCase.name + " --keep",
                    .sceneHash = comparedHash(scene),
                    .solverHash = settingsHash({}, kSolverVersions),
                    .simulated = scene.frames / scene.fps,
                    .scatter = reference.scatter,
                    .settings = {}};
  double all = 0, done = 0;  // [s], as the runs say
  for (const CaseRun& run : reportCase.runs) all += run.seconds;
  for (const CaseRun& run : reportCase.runs) {
    kept.settings.push_back(measured(def, reference, run, [&](double share) {
      if (shown) shown((done + share * run.seconds) / all);
    }));
    done += run.seconds;
  }
  writeWhole(file, settingsDocument(kept).dump(2) + "\n");
}

KeptSettings readSettings(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string(), "", "cannot be read");
  try {
    const SettingsDocument json = SettingsDocument::parse(stream);
    KeptSettings kept{.scene = json.at("scene").get<std::string>(),
                      .madeBy = json.at("made_by").get<std::string>(),
                      .sceneHash = json.at("scene_hash").get<std::string>(),
                      .solverHash = json.at("solver_hash").get<std::string>(),
                      .simulated = json.at("simulated_s").get<double>(),
                      .scatter = json.at("scatter").get<double>(),
                      .settings = {}};
    for (const SettingsDocument& setting : json.at("settings")) kept.settings.push_back(settingIn(setting));
    return kept;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string(), "", "holds no kept settings; `rubble report CASE --keep` writes them");
  }
}

std::string staleness(const KeptSettings& kept, const Scene& scene, std::span<const SolverVersion> versions) {
  if (kept.solverHash != settingsHash({}, versions)) return "of another version of the solver";
  if (kept.sceneHash != comparedHash(scene)) return "of that scene with other values";
  return "";
}

std::filesystem::path settingsFile(const ReferenceDef& def) {
  return keptFolder() / (std::filesystem::path(def.scene).stem().string() + kSettingsEnding);
}

std::vector<KeptSettings> allKeptSettings() {
  std::vector<KeptSettings> all;
  for (const std::string& name : keptNames())
    all.push_back(readSettings(keptFolder() / (name + kSettingsEnding)));
  return all;
}

std::string keptSceneNames() {
  std::string text;
  for (const std::string& name : keptNames()) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace rubble::demo
