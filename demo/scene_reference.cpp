#include "demo/scene_reference.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "demo/commit.h"
#include "demo/input_error.h"
#include "demo/keys.h"
#include "demo/output_file.h"
#include "demo/report_case.h"
#include "demo/settings_hash.h"

namespace rubble::demo {
namespace {

using Document = nlohmann::ordered_json;

constexpr double kSubstepPart = 1.0 / 8;  // of the scene's own

// The first impactor is moved, or the last object where there is none.
Override shifted(const Scene& scene, double shift) {
  const bool hasImpactor = !scene.impactors.empty();
  const std::size_t index = hasImpactor ? 0 : scene.objects.size() - 1;
  Eigen::Vector3d at = hasImpactor ? scene.impactors[index].position : scene.objects[index].position;
  at.x() += shift;
  return {(hasImpactor ? "impactors." : "objects.") + std::to_string(index) + ".position", shown(at)};
}

// `shift` of 0 leaves the scene as it is.
Scene referenceScene(const ReferenceDef& def, double shift = 0) {
  const Scene own = comparedScene(def, {});
  return comparedScene(
      def, {{"precision", "double"}, {"substep_safety", shown(own.substepSafety * kSubstepPart)}}, shift);
}

std::string sceneHash(const ReferenceDef& def) {
  const Scene scene = referenceScene(def);
  return settingsHash({&scene, 1}, {});
}

std::string solverHash(std::span<const SolverVersion> versions) {
  return settingsHash({}, versions);
}

std::string commandOf(const ReferenceDef& def) {
  return "rubble report " + def.caseName + " --reference";
}

InputError stale(const ReferenceDef& def, const std::filesystem::path& file, const std::string& problem) {
  return {file.string(), "",
          problem + "; made anew in about " + std::to_string(def.minutes) + " minutes by: " + commandOf(def)};
}

// Of runs of the same names.
std::vector<SceneQuantity> meanOf(std::span<const std::vector<SceneQuantity>> runs) {
  std::vector<SceneQuantity> mean = runs.front();
  for (std::size_t q = 0; q < mean.size(); ++q) {
    mean[q].value = 0;
    for (const std::vector<SceneQuantity>& run : runs) mean[q].value += run[q].value / double(runs.size());
  }
  return mean;
}

Document documentOf(const ReferenceDef& def, std::span<const std::vector<SceneQuantity>> runs) {
  const Scene scene = referenceScene(def);
  Document document = {{"made_by", commandOf(def)},
                       {"commit", commitName()},
                       {"scene", def.scene},
                       {"scene_hash", sceneHash(def)},
                       {"solver_hash", solverHash(kSolverVersions)},
                       {"settings",
                        {{"precision", "double"},
                         {"substep_safety", scene.substepSafety},
                         {"bullet_rate", scene.bulletRate},
                         {"seed", scene.seed},
                         {"frames", scene.frames},
                         {"fps", scene.fps}}},
                       {"blow_shifted_m", kBlowShifts},
                       {"quantities", Document::array()}};
  for (std::size_t q = 0; q < runs.front().size(); ++q) {
    Document values = Document::array();
    for (const std::vector<SceneQuantity>& run : runs) values.push_back(run[q].value);
    document["quantities"].push_back(
        {{"name", runs.front()[q].name}, {"in_error", runs.front()[q].inError}, {"runs", values}});
  }
  return document;
}

std::vector<std::vector<SceneQuantity>> runsIn(const Document& document) {
  std::vector<std::vector<SceneQuantity>> runs(std::size(kBlowShifts));
  for (const Document& quantity : document.at("quantities"))
    for (std::size_t run = 0; run < runs.size(); ++run)
      runs[run].push_back({quantity.at("name").get<std::string>(), quantity.at("runs").at(run).get<double>(),
                           quantity.at("in_error").get<bool>()});
  return runs;
}

}  // namespace

Scene comparedScene(const ReferenceDef& def, std::vector<Override> changes, double shift) {
  changes.push_back({"seed", std::to_string(kCaseSeed)});
  changes.push_back({"frames", std::to_string(def.frames)});
  if (shift != 0) changes.push_back(shifted(loadScene(def.scene, changes), shift));
  Scene scene = loadScene(def.scene, changes);
  scene.dust.reset();  // it does not act back on the mechanics
  return scene;
}

SceneReference referenceOf(std::span<const std::vector<SceneQuantity>> runs) {
  SceneReference reference{meanOf(runs), {}, 0};
  reference.scatters.resize(reference.quantities.size());
  for (std::size_t left = 0; left < runs.size(); ++left) {
    std::vector<std::vector<SceneQuantity>> others(runs.begin(), runs.end());
    others.erase(others.begin() + std::ptrdiff_t(left));
    const std::vector<SceneQuantity> mean = meanOf(others);
    for (std::size_t q = 0; q < mean.size(); ++q)
      reference.scatters[q] += std::pow(runs[left][q].value / mean[q].value - 1, 2) / double(runs.size());
    reference.scatter += std::pow(relativeDifference(runs[left], mean), 2) / double(runs.size());
  }
  for (double& scatter : reference.scatters) scatter = std::sqrt(scatter);
  reference.scatter = std::sqrt(reference.scatter);
  return reference;
}

void writeReference(const ReferenceDef& def, const std::filesystem::path& file,
                    const std::function<void(double)>& shown) {
  checkFolder("--reference", file.parent_path());
  makeFolder(file.parent_path());
  checkFile("--reference", file, file.parent_path());
  std::vector<std::vector<SceneQuantity>> runs;
  for (const double shift : kBlowShifts) {
    const auto shareOfAll = [&](double share) {
      if (shown) shown((double(runs.size()) + share) / double(std::size(kBlowShifts)));
    };
    runs.push_back(runToEnd(referenceScene(def, shift), shareOfAll).quantities);
    for (const SceneQuantity& quantity : runs.back())
      if (!(std::abs(quantity.value) > 0))
        throw RunStopped(def.scene + ": " + quantity.name + " is 0, so nothing differs from it by a share");
  }
  writeWhole(file, documentOf(def, runs).dump(2) + "\n");
}

SceneReference readReference(const ReferenceDef& def, const std::filesystem::path& file,
                             std::span<const SolverVersion> versions) {
  std::ifstream stream(file);
  if (!stream) throw stale(def, file, "cannot be read");
  try {
    const Document document = Document::parse(stream);
    if (document.at("scene_hash").get<std::string>() != sceneHash(def))
      throw stale(def, file, "is of the scene " + def.scene + " as it was before, or at other settings");
    if (document.at("solver_hash").get<std::string>() != solverHash(versions))
      throw stale(def, file, "is of another version of the solver (rubble/version.h)");
    return referenceOf(runsIn(document));
  } catch (const nlohmann::json::exception&) {
    throw stale(def, file, "is no reference");
  }
}

void requireSameQuantities(const ReferenceDef& def, const SceneReference& reference,
                           const SceneOutcome& run) {
  if (!std::ranges::equal(reference.quantities, run.quantities, {}, &SceneQuantity::name,
                          &SceneQuantity::name))
    throw stale(def, referenceFile(def), "is of other quantities than a run has");
}

std::filesystem::path referenceFile(const ReferenceDef& def) {
  const std::string name = std::filesystem::path(def.scene).stem().string();
  return sceneFolder().parent_path() / "references" / (name + ".json");
}

std::string referenceHash(const ReferenceDef& def, std::span<const SolverVersion> versions) {
  const Scene scene = referenceScene(def);
  return settingsHash({&scene, 1}, versions);
}

}  // namespace rubble::demo
