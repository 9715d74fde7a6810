#include "demo/recorder.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "demo/event_lines.h"
#include "demo/input_error.h"

namespace rubble::demo {
namespace {

using Line = nlohmann::ordered_json;

// 64 bits as text: JSON numbers hold 53.
std::string hex(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << value;
  return text.str();
}

Line list(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Line countsOf(const DestructionCounts& c, Line line) {
  line["elements"] = {{"intact", c.intact()}, {"crushed", c.crushed}, {"awake", c.awake}};
  line["fragments"] = c.fragments;
  line["springs"] = {{"intact", c.springsIntact()}, {"broken", c.springsBroken}};
  line["debris"] = {{"alive", c.debrisAlive}, {"spawned", c.debrisSpawned}, {"removed", c.debrisRemoved}};
  return line;
}

Line massOf(const Ledger& ledger, const DustTotals& dust) {
  return {{"elements", ledger.massElements},
          {"debris", ledger.massDebris},
          {"dust_emitted", ledger.massDustEmitted},
          {"dust_air", dust.air},
          {"dust_settled", dust.settled},
          {"dust_left", dust.left},
          {"total", ledger.massElements + ledger.massDebris + ledger.massDustEmitted + ledger.massRemoved},
          {"error", ledger.massError},
          {"dust_error", dust.error()}};
}

// What sleep, removal and dust took away is booked under `dissipated`, so that the printed columns close.
Line energyOf(const Ledger& ledger) {
  return {{"kinetic", ledger.kinetic},     {"elastic", ledger.elastic},
          {"gravity", ledger.gravity},     {"dissipated", ledger.dissipated + ledger.removed},
          {"fracture", ledger.fracture},   {"debris", ledger.debris},
          {"exchanged", ledger.exchanged}, {"error", ledger.energyError}};
}

Line timesOf(const DestructionTimes& parts, const FrameTimes& times) {
  const double ours = parts.edem + parts.neighbours + parts.fracture + parts.debris;
  return {{"bullet", std::max(0.0, times.step - ours)},
          {"edem", parts.edem},
          {"neighbours", parts.neighbours},
          {"fracture", parts.fracture},
          {"debris", parts.debris},
          {"dust", times.dust},
          {"upload", times.upload},
          {"render", times.render},
          {"total", times.total}};
}

void requireFinite(const Line& value, const std::string& path, int frame) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw RunStopped(path + " is not finite in frame " + std::to_string(frame) + "; lower substep_safety");
  }
  if (!value.is_structured()) return;
  for (const auto& [key, child] : value.items())
    requireFinite(child, path.empty() ? key : path + "." + key, frame);
}

}  // namespace

Recorder::Recorder(const World& world, const std::filesystem::path& stats,
                   const std::filesystem::path& events)
    : m_exitSpeed(world) {
  if (!stats.empty()) m_stats.emplace(stats);
  if (!events.empty()) m_events.emplace(events);
}

void Recorder::record(int frame, World& world, const DustGrid* dust, const Events& events,
                      const FrameTimes& times) {
  Destruction& destruction = world.destruction();
  const Ledger& ledger = destruction.ledger();
  const DustTotals totals = dust ? dust->totals() : DustTotals();
  m_line = Line{{"frame", frame},
                {"time_s", (frame + 1) / world.scene().fps},
                {"substeps", world.substeps()},
                {"dt_s", world.substepLength()}};
  m_line = countsOf(destruction.counts(), std::move(m_line));
  m_line["mass_kg"] = massOf(ledger, totals);
  m_line["momentum"] = {{"linear", list(ledger.linearMomentum)},
                        {"angular", list(ledger.angularMomentum)},
                        {"error", ledger.momentumError()}};
  m_line["energy_J"] = energyOf(ledger);
  m_line["ms"] = timesOf(destruction.takeTimes(), times);
  m_line["hash"] = hex(world.hash());
  m_line["hash_debris"] = hex(destruction.debrisHash());
  requireFinite(m_line, "", frame);

  if (m_events) {
    std::ostringstream lines;
    writeEvents(lines, frame, events);
    m_events->append(lines.str());
  }
  if (m_stats) m_stats->append(m_line.dump() + "\n");
  m_exitSpeed.update(world);
  m_summary.frames += 1;
  m_summary.seconds += times.total / 1000;
  m_summary.counts = destruction.counts();
  m_summary.ledger = ledger;
  m_summary.dust = totals;
  m_summary.exitSpeed = m_exitSpeed.value();
  m_summary.eventsDropped += events.dropped;
}

}  // namespace rubble::demo
