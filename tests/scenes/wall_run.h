// The bundled scene `wall` in this process: runs and what they leave behind.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "demo/run.h"
#include "demo/world.h"
#include "scenes/scene_file.h"
#include "support/strict_log.h"

namespace rubble::test {

using Json = nlohmann::ordered_json;
using Overrides = std::vector<demo::Override>;

/// The ball touches the wall in frame 4 and is through it by frame 12.
inline const demo::Override kThroughTheWall = {"frames", "12"};
/// As far as runs are compared that must be the same. Under sanitizers, into the wall: a frame takes a
/// second.
#ifdef RUBBLE_SANITIZED
inline constexpr std::size_t kComparedFrames = 6;
#else
inline constexpr std::size_t kComparedFrames = 12;
#endif
inline const demo::Override kCompared = {"frames", std::to_string(kComparedFrames)};

struct SceneRun {
  std::vector<Json> frames;  ///< statistics, one object a frame
  std::vector<Json> events;
  demo::Summary summary;

  std::vector<Json> eventsOf(const std::string& kind) const {
    std::vector<Json> list;
    for (const Json& event : events)
      if (event["event"] == kind) list.push_back(event);
    return list;
  }
};

inline std::vector<Json> readLines(const std::filesystem::path& path) {
  std::vector<Json> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(Json::parse(line));
  return lines;
}

/// Runs the scene `wall`; pictures, if any, are 160 x 90.
inline SceneRun runWall(const Overrides& overrides, int threads = 1, bool render = false) {
  const TestFolder folder;
  const std::filesystem::path events = folder.path() / "events.jsonl";
  std::ostringstream report;
  SceneRun run;
  run.summary = demo::runScene(demo::loadScene("wall", overrides),
                               {.out = folder.path() / "out",
                                .events = events,
                                .render = render,
                                .width = 160,
                                .height = 90,
                                .threads = threads,
                                .log = strictLog()},
                               report);
  run.frames = readLines(folder.path() / "out/stats.jsonl");
  run.events = readLines(events);
  return run;
}

/// `hash` and `hash_debris` of every frame.
inline std::vector<std::string> hashesOf(const SceneRun& run) {
  std::vector<std::string> list;
  for (const Json& frame : run.frames)
    list.push_back(frame["hash"].get<std::string>() + " " + frame["hash_debris"].get<std::string>());
  return list;
}

/// Closing errors of the ledgers, dimensionless.
struct LedgerErrors {
  double mass = 0, momentum = 0, energy = 0, dust = 0;
};

/// The largest of each over all frames.
inline LedgerErrors worstErrors(const SceneRun& run) {
  LedgerErrors worst;
  const auto raise = [](double& largest, const Json& value) {
    largest = std::max(largest, value.get<double>());
  };
  for (const Json& frame : run.frames) {
    raise(worst.mass, frame["mass_kg"]["error"]);
    raise(worst.dust, frame["mass_kg"]["dust_error"]);
    raise(worst.momentum, frame["momentum"]["error"]);
    raise(worst.energy, frame["energy_J"]["error"]);
  }
  return worst;
}

/// The scene `wall_quiet`, frame by frame, and how fast its elements are.
class QuietWall {
 public:
  explicit QuietWall(const Overrides& overrides)
      : m_world(demo::loadScene("wall_quiet", overrides),
                demo::cookObjects(demo::loadScene("wall_quiet", overrides), {}, strictLog()), strictLog()),
        m_body(*m_world.destruction().bodies().front()),
        m_places(places()) {
    const std::vector<double>& volumes = m_body.asset()->volumes;
    m_lightest = m_body.material().density * *std::min_element(volumes.begin(), volumes.end());
  }

  /// Runs a frame and returns a speed that no element passed [m/s]: the larger of the fastest element's mean
  /// speed in the frame, and of the speed that the lightest would have with all of the kinetic energy at its
  /// end.
  double step() {
    const std::vector<Eigen::Vector3f> before = std::exchange(m_places, {});
    m_world.step();
    m_places = places();
    double moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      moved = std::max(moved, double((m_places[i] - before[i]).norm()));
    const double kinetic = std::max(0.0, m_world.destruction().ledger().kinetic);
    return std::max(moved * m_world.scene().fps, std::sqrt(2 * kinetic / m_lightest));
  }
  const DestructibleBody& body() const { return m_body; }
  demo::World& world() { return m_world; }

 private:
  std::vector<Eigen::Vector3f> places() const {
    std::vector<ElementPose> poses(m_body.asset()->elementCount());
    m_body.poses(poses);
    std::vector<Eigen::Vector3f> list;
    for (const ElementPose& pose : poses) list.push_back(pose.position);
    return list;
  }

  demo::World m_world;
  const DestructibleBody& m_body;
  std::vector<Eigen::Vector3f> m_places;
  double m_lightest = 0;  // mass of an element [kg]
};

}  // namespace rubble::test
