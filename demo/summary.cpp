#include "demo/summary.h"

#include <iomanip>

#include "demo/markdown_table.h"

namespace rubble::demo {
namespace {

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
  row(out, "dust", rounded(s.ledger.massDustEmitted) + " kg");
  if (s.exitSpeed) row(out, "impactor leaves at", rounded(*s.exitSpeed) + " m/s");
  row(out, "ledger errors",
      "mass " + rounded(s.ledger.massError) + ", momentum " + rounded(s.ledger.momentumError()) +
          ", energy " + rounded(s.ledger.energyError) + ", dust " + rounded(s.dust.error()));
  if (s.frames > 0)
    row(out, "time",
        rounded(1000 * s.seconds / s.frames) + " ms a frame, " + std::to_string(s.frames) + " frames");
  if (!s.drawnBy.empty()) row(out, "drawn by", s.drawnBy);
  if (s.eventsDropped > 0) row(out, "events dropped", std::to_string(s.eventsDropped) + "; raise max_events");
}

}  // namespace rubble::demo
