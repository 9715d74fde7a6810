#include "demo/cases/scene_case.h"

#include <cmath>
#include <limits>

#include "demo/input_error.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace {

constexpr double kParts[] = {1, 0.5, 0.25};  // of the default substep

// A line of the plot.
struct Method {
  std::string name;
  std::vector<Override> changes;
  bool standard = false;  // what the scene sets
  bool whole = false;     // bodies until they are struck
};

CaseOutcome failed(const SceneReference& reference, const Scene& scene) {
  CaseOutcome outcome{.error = HUGE_VAL, .simulatedSeconds = scene.frames / scene.fps};
  outcome.scatter = reference.scatter;
  for (std::size_t q = 0; q < reference.quantities.size(); ++q)
    outcome.quantities.push_back({reference.quantities[q].name, std::numeric_limits<double>::quiet_NaN(),
                                  reference.quantities[q].value, reference.scatters[q]});
  return outcome;
}

CaseOutcome runCompared(const ReferenceDef& def, const std::vector<Override>& changes) {
  const SceneReference reference = readReference(def, referenceFile(def));
  const Scene scene = comparedScene(def, changes);
  CaseOutcome outcome = failed(reference, scene);
  try {
    const SceneOutcome run = runToEnd(scene);
    requireSameQuantities(def, reference, run);
    outcome.error = relativeDifference(run.quantities, reference.quantities);
    outcome.processorSeconds = run.processorSeconds;
    for (std::size_t q = 0; q < run.quantities.size(); ++q)
      outcome.quantities[q].value = run.quantities[q].value;
  } catch (const RunStopped&) {
  }
  return outcome;
}

std::vector<Method> sceneMethods(const SceneCaseDef& def) {
  std::vector<Method> methods = {{"float", {{"precision", "float"}}, true},
                                 {"double", {{"precision", "double"}}},
                                 {"float, Bullet at 60 Hz", {{"bullet_rate", "60"}}}};
  if (!def.wholeBodies) return methods;
  methods.push_back({"float, rigid until struck", {}, false, true});
  for (int i = 0; i < def.objects; ++i)
    methods.back().changes.push_back({"objects." + std::to_string(i) + ".regime", "rigid_until_struck"});
  return methods;
}

}  // namespace

ReportCase sceneCase(const SceneCaseDef& def) {
  ReportCase c{
      .name = def.name,
      .what = def.what,
      .closedForm =
          "the mean of five runs in double at an eighth of the substep, micrometres apart in "
          "where the blow comes",
      .error =
          "root mean square of the relative differences of exit speed, broken springs, crushed mass and dust",
      .runs = {},
      .reference = ReferenceDef{def.name, def.scene, def.frames, def.minutes}};
  const ReferenceDef reference = *c.reference;
  const double safety = Scene().substepSafety;
  for (const Method& method : sceneMethods(def)) {
    for (const double part : kParts) {
      std::vector<Override> changes = method.changes;
      changes.push_back({"substep_safety", rounded(safety * part)});
      const bool standard = method.standard && part == 1;
      const bool inAll = !def.fewInAll || (method.standard ? part > 0.4 : method.whole && part == 1);
      c.runs.push_back({method.name, "substep_safety " + rounded(safety * part), standard, standard,
                        [=] { return runCompared(reference, changes); }, def.frameSeconds * def.frames / part,
                        changes, !inAll});
    }
  }
  return c;
}

}  // namespace rubble::demo
