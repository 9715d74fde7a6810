#include "demo/event_lines.h"

#include <nlohmann/json.hpp>

namespace rubble::demo {
namespace {

using Line = nlohmann::ordered_json;

const char* name(BreakMode mode) {
  switch (mode) {
    case BreakMode::Tension:
      return "tension";
    case BreakMode::Compression:
      return "compression";
    case BreakMode::Shear:
      return "shear";
    case BreakMode::Rotation:
      return "rotation";
    case BreakMode::Stretch:
      return "stretch";
    case BreakMode::Crushed:
      return "crushed";
  }
  return "unknown";
}

Line list(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

Line line(int frame, const SpringBroken& e) {
  return {{"frame", frame},
          {"event", "spring_broken"},
          {"body", e.body},
          {"spring", e.spring},
          {"mode", name(e.mode)},
          {"energy_J", e.energy},
          {"position_m", list(e.position)}};
}

Line line(int frame, const ElementCrushed& e) {
  return {{"frame", frame},
          {"event", "element_crushed"},
          {"body", e.body},
          {"element", e.element},
          {"pieces", e.pieces},
          {"mass_kg", e.mass},
          {"dust_kg", e.dustMass},
          {"fracture_J", e.fractureEnergy},
          {"max_radius_m", e.maxRadius},
          {"position_m", list(e.position)},
          {"velocity_m_s", list(e.velocity)}};
}

Line line(int frame, const DebrisSpawned& e) {
  return {{"frame", frame},       {"event", "debris_spawned"}, {"body", e.body},
          {"element", e.element}, {"radius_m", e.radius},      {"mass_kg", e.mass}};
}

Line line(int frame, const FragmentSplit& e) {
  return {{"frame", frame}, {"event", "fragment_split"}, {"body", e.body},
          {"root", e.root}, {"elements", e.elements},    {"mass_kg", e.mass}};
}

Line line(int frame, const BodySplit& e) {
  return {{"frame", frame}, {"event", "body_split"},  {"body", e.body},   {"new_body", e.newBody},
          {"root", e.root}, {"elements", e.elements}, {"mass_kg", e.mass}};
}

template <class Event>
void writeAll(std::ostream& out, int frame, const std::vector<Event>& events) {
  for (const Event& event : events) out << line(frame, event).dump() << '\n';
}

}  // namespace

void writeEvents(std::ostream& out, int frame, const Events& events) {
  writeAll(out, frame, events.springsBroken);
  writeAll(out, frame, events.elementsCrushed);
  writeAll(out, frame, events.debrisSpawned);
  writeAll(out, frame, events.fragmentsSplit);
  writeAll(out, frame, events.bodiesSplit);
}

}  // namespace rubble::demo
