// What a scene leaves in double at an eighth of its substep, kept as data: the answer with which runs of the
// scene at other settings are compared.
//
// What breaks is brittle: the last bit of the blow decides where a crack goes, and the counts of two runs
// differ however short their substeps. So the answer is the mean of some runs that differ by micrometres in
// where the blow comes, and beside it is kept how far one such run is from the mean of the others. A
// difference no greater tells nothing about a setting.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "demo/scene.h"
#include "demo/scene_outcome.h"
#include "rubble/version.h"

namespace rubble::demo {

struct ReferenceDef {
  std::string caseName;  ///< of the case that is compared with it
  std::string scene;     ///< name, or path of a JSON file
  int frames = 0;        ///< of it, from its start
  int minutes = 0;       ///< about how long making it takes
};

struct SceneReference {
  std::vector<SceneQuantity> quantities;
  std::vector<double> scatters;  ///< of each quantity: relative, root mean square
  double scatter = 0;            ///< of relativeDifference, root mean square
};

/// By which the blows of the runs of a reference are shifted along x [m]: far below what one could see, and
/// above the 6e-8 that Bullet's floats tell apart at a metre.
inline constexpr double kBlowShifts[] = {0, 1e-6, -1e-6, 2e-6, -2e-6};

/// The scene as it is compared, of that seed and length, with these changes and its blow shifted [m].
Scene comparedScene(const ReferenceDef& def, std::vector<Override> changes, double shift = 0);

/// Of runs of the same quantities, at least two.
SceneReference referenceOf(std::span<const std::vector<SceneQuantity>> runs);

/// Makes and writes the reference; `shown` gets the share done, 0 to 1. Throws InputError, MachineError,
/// RunStopped; the file is then as it was.
void writeReference(const ReferenceDef& def, const std::filesystem::path& file,
                    const std::function<void(double)>& shown = {});

/// Throws InputError, which names the command that makes it anew, when there is none or when it is of another
/// scene or another solver.
SceneReference readReference(const ReferenceDef& def, const std::filesystem::path& file,
                             std::span<const SolverVersion> versions = kSolverVersions);

/// Throws InputError as readReference does when a run has other quantities than the reference.
void requireSameQuantities(const ReferenceDef& def, const SceneReference& reference, const SceneOutcome& run);

/// Where that of a scene is kept: in the folder `references` beside that of the scenes.
std::filesystem::path referenceFile(const ReferenceDef& def);

/// What a reference depends on: scene, settings and solver; as 16 hexadecimal digits.
std::string referenceHash(const ReferenceDef& def, std::span<const SolverVersion> versions = kSolverVersions);

}  // namespace rubble::demo
