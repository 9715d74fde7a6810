// What a run leaves behind in numbers: one JSON object a frame, one an event, and the sums for the final
// table.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "demo/exit_speed.h"
#include "demo/output_file.h"
#include "demo/world.h"
#include "rubble/dust.h"

namespace rubble::demo {

/// Wall time of the parts of one frame [ms].
struct FrameTimes {
  double step = 0, dust = 0, upload = 0, render = 0, total = 0;
};

/// The end of a run.
struct Summary {
  int frames = 0;
  double seconds = 0;  ///< of wall time, in frames
  DestructionCounts counts;
  Ledger ledger;
  DustTotals dust;
  std::optional<double> exitSpeed;  ///< [m/s], of the first impactor
  std::uint32_t eventsDropped = 0;
  std::string drawnBy;  ///< name of the GL renderer; empty without pictures
};

class Recorder {
 public:
  /// Empty paths: nothing is written. Throws MachineError when a file cannot be made.
  Recorder(const World& world, const std::filesystem::path& stats, const std::filesystem::path& events);

  /// Books one frame. Throws RunStopped when a number is no longer finite, and MachineError when a file
  /// cannot be written; the files then end with their last whole frame.
  void record(int frame, World& world, const DustGrid* dust, const Events& events, const FrameTimes& times);

  /// The line of the last frame.
  const nlohmann::ordered_json& lastFrame() const { return m_line; }
  const Summary& summary() const { return m_summary; }

 private:
  std::optional<OutputFile> m_stats, m_events;
  nlohmann::ordered_json m_line;
  ExitSpeed m_exitSpeed;
  Summary m_summary;
};

}  // namespace rubble::demo
