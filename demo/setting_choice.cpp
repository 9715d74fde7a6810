#include "demo/setting_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "demo/input_error.h"
#include "demo/markdown_table.h"
#include "demo/output_file.h"

namespace rubble::demo {
namespace {

std::string percent(double share) {
  return std::isfinite(share) ? rounded(100 * share) + " %" : "failed";
}

std::string costText(const KeptSetting& setting) {
  return rounded(setting.milliseconds) + " ms";
}

// A scene is that of the figures when it has the same values, wherever its file is, or when it is the bundled
// file itself, which may have changed since.
bool isSceneOf(const KeptSettings& kept, const Scene& scene) {
  return kept.sceneHash == comparedHash(scene) ||
         sameFile(scene.file, sceneFolder() / (kept.scene + ".json"));
}

// The command that would make figures of the scene.
std::string makingCommand(const Scene& scene) {
  for (const ReportCase& c : reportCases())
    if (c.reference && c.reference->scene == scene.name)
      return "they are made by: rubble report " + c.name + " --keep";
  return "none can be made, for no case of rubble report is of it (" + referenceCaseNames() + ")";
}

KeptSettings keptOf(const Scene& scene) {
  for (KeptSettings& kept : allKeptSettings())
    if (isSceneOf(kept, scene)) return std::move(kept);
  throw InputError("--error", scene.name,
                   "has no kept errors of its settings; scenes that have: " + keptSceneNames() + "; " +
                       makingCommand(scene));
}

// What is chosen cannot be given too.
void requireNotChosen(const KeptSettings& kept, const std::vector<Override>& overrides) {
  for (const KeptSetting& setting : kept.settings)
    for (const Override& chosen : setting.changes)
      for (const Override& given : overrides)
        if (given.path == chosen.path)
          throw InputError(given.source, given.path, "is what --error chooses, must be left out with it");
}

InputError noneWithin(const KeptSettings& kept, double error) {
  const auto errorOf = [&](const KeptSetting& setting) { return kept.errorOf(setting); };
  const auto least = std::ranges::min_element(kept.settings, {}, errorOf);
  if (least == kept.settings.end())
    return {"--error", percent(error), "cannot be kept: no setting of " + kept.scene + " was measured"};
  return {"--error", percent(error),
          "is below what any setting of " + kept.scene + " kept: the least was " + percent(errorOf(*least)) +
              " by " + least->name + "; runs of the reference itself scatter by " + percent(kept.scatter)};
}

std::string choiceText(const KeptSettings& kept, const KeptSetting& chosen, double error) {
  std::string text = "setting: " + chosen.name + ": error " + percent(kept.errorOf(chosen)) + ", " +
                     costText(chosen) + " of one core per simulated second, the cheapest of " +
                     std::to_string(kept.settings.size()) + " to keep " + percent(error);
  const auto standard = std::ranges::find_if(kept.settings, &KeptSetting::standard);
  if (standard == kept.settings.end()) return text;
  if (&*standard == &chosen) return text + "; it is the default";
  return text + "; the default (" + standard->name + "): " + percent(kept.errorOf(*standard)) + ", " +
         costText(*standard);
}

}  // namespace

double parseErrorShare(const std::string& text) {
  const bool isPercent = text.ends_with('%');
  const char* const end = text.data() + text.size() - (isPercent ? 1 : 0);
  double value = 0;
  const auto [rest, failure] = std::from_chars(text.data(), end, value);
  const double limit = isPercent ? 100 : 1;
  if (failure != std::errc() || rest != end || !(value > 0) || !(value < limit))
    throw InputError("--error", text,
                     "is no error, must be a percentage such as 2%, or a share above 0 and below 1 such as "
                     "0.02");
  return isPercent ? value / 100 : value;
}

const KeptSetting* cheapestWithin(const KeptSettings& kept, double error) {
  const KeptSetting* cheapest = nullptr;
  for (const KeptSetting& setting : kept.settings) {
    if (!(kept.errorOf(setting) <= error)) continue;
    if (!cheapest || setting.milliseconds < cheapest->milliseconds) cheapest = &setting;
  }
  return cheapest;
}

Scene sceneWithin(double error, const std::string& nameOrPath, std::vector<Override> overrides,
                  const LogFunction& log, std::ostream& out) {
  const Scene scene = loadScene(nameOrPath, overrides);
  const KeptSettings kept = keptOf(scene);
  requireNotChosen(kept, overrides);
  const KeptSetting* chosen = cheapestWithin(kept, error);
  if (!chosen) throw noneWithin(kept, error);
  if (const std::string stale = staleness(kept, scene); log && !stale.empty())
    log(LogLevel::Warning, "--error: the errors kept of " + kept.scene + " may no longer hold, they are " +
                               stale + "; made anew by: " + kept.madeBy);
  overrides.insert(overrides.end(), chosen->changes.begin(), chosen->changes.end());
  Scene within = loadScene(nameOrPath, overrides);
  out << choiceText(kept, *chosen, error) << '\n';
  return within;
}

}  // namespace rubble::demo
