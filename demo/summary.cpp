#include "demo/summary.h"

#include <iomanip>
#include <sstream>

namespace rubble::demo {
namespace {

std::string text(double value) {
  std::ostringstream stream;
  stream << std::setprecision(3) << value;
  return stream.str();
}

void row(std::ostream& out, const char* name, const std::string& value) {
  constexpr int kNameWidth = 20;  // of the longest name
  out << "  " << std::left << std::setw(kNameWidth) << name << value << '\n';
}

}  // namespace

void printSummary(std::ostream& out, const Summary& s) {
  const DestructionCounts& c = s.counts;
  row(out, "elements", std::to_string(c.crushed) + " of " + std::to_string(c.elements) + " crushed");
  row(out, "springs", std::to_string(c.springsBroken) + " of " + std::to_string(c.springs) + " broken");
  row(out, "fragments", std::to_string(c.fragments));
  row(out, "debris", std::to_string(c.debrisSpawned) + " pieces, " + std::to_string(c.debrisAlive) + " left");
  row(out, "dust", text(s.ledger.massDustEmitted) + " kg");
  if (s.exitSpeed) row(out, "impactor leaves at", text(*s.exitSpeed) + " m/s");
  row(out, "ledger errors",
      "mass " + text(s.ledger.massError) + ", momentum " + text(s.ledger.momentumError()) + ", energy " +
          text(s.ledger.energyError) + ", dust " + text(s.dust.error()));
  if (s.frames > 0)
    row(out, "time",
        text(1000 * s.seconds / s.frames) + " ms a frame, " + std::to_string(s.frames) + " frames");
  if (!s.drawnBy.empty()) row(out, "drawn by", s.drawnBy);
  if (s.eventsDropped > 0) row(out, "events dropped", std::to_string(s.eventsDropped) + "; raise max_events");
}

}  // namespace rubble::demo
