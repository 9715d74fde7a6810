// How far off a scene is at each of several settings and what each costs, kept as data beside its reference:
// `rubble report CASE --keep` writes them, and `rubble run SCENE --error` chooses by them.
//
// A blow that breaks is chaotic: a run at one setting may come near the reference by luck. So each setting
// runs a few times, micrometres apart as the runs of the reference are, and the worst of them counts; no
// error counts as less than the scatter of the reference, below which nothing can be told.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "demo/report_case.h"
#include "demo/scene.h"
#include "rubble/version.h"

namespace rubble::demo {

struct KeptSetting {
  std::string name;               ///< "float, substep_safety 0.9"
  bool standard = false;          ///< what the scene sets
  std::vector<Override> changes;  ///< of the scene
  std::vector<double> errors;     ///< of each run, as ReportCase::error says; not finite: it failed
  double largest = 0;             ///< relative difference of one quantity in any run: for readers
  double milliseconds = 0;        ///< of one core per simulated second, the least of the runs
};

struct KeptSettings {
  std::string scene;       ///< a bundled one's name
  std::string madeBy;      ///< the command that makes them anew
  std::string sceneHash;   ///< as comparedHash
  std::string solverHash;  ///< as settingsHash of no scene
  double simulated = 0;    ///< from the start of the scene [s]
  double scatter = 0;      ///< of the reference
  std::vector<KeptSetting> settings;

  /// That counts: the worst of its runs, at least the scatter.
  double errorOf(const KeptSetting& setting) const;
};

/// Of all that decides what a scene leaves but its length; as 16 hexadecimal digits.
std::string comparedHash(const Scene& scene);

/// Runs all settings of the case, which is of a scene, and writes how far they are from the reference;
/// `shown` gets the share done, 0 to 1. Throws InputError, MachineError; the file is then as it was.
void writeSettings(const ReportCase& reportCase, const SceneReference& reference,
                   const std::filesystem::path& file, const std::function<void(double)>& shown = {});

/// Throws InputError.
KeptSettings readSettings(const std::filesystem::path& file);

/// Why they may no longer hold, in words that follow "they are"; empty: they are of this scene and solver.
std::string staleness(const KeptSettings& kept, const Scene& scene,
                      std::span<const SolverVersion> versions = kSolverVersions);

/// Where those of a scene are kept: beside its reference.
std::filesystem::path settingsFile(const ReferenceDef& def);

/// All that are kept, by name of the scene. Throws InputError.
std::vector<KeptSettings> allKeptSettings();

/// Of their scenes, "wall"; "none".
std::string keptSceneNames();

}  // namespace rubble::demo
