#include "demo/stability_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "demo/commit.h"
#include "demo/machine.h"

namespace rubble::demo {
namespace {

using stability::Case;
using stability::Happening;

struct CaseRange {
  std::string name;
  std::function<bool(const Case&)> holds;
};

// A row below the first border, one from each to the next, and one from the last on; of what is often nothing
// a row for that before them.
void addRanges(std::vector<CaseRange>& rows, const std::string& name, double Case::*field,
               const std::vector<double>& borders, bool oftenNothing = false) {
  if (oftenNothing) rows.push_back({name + ", 0", [=](const Case& c) { return c.*field == 0; }});
  const auto add = [&](const std::string& words, double low, double high) {
    rows.push_back({name + ", " + words, [=](const Case& c) {
                      return c.*field >= low && c.*field < high && !(oftenNothing && c.*field == 0);
                    }});
  };
  add("below " + rounded(borders.front()), 0, borders.front());
  for (std::size_t i = 1; i < borders.size(); ++i)
    add(rounded(borders[i - 1]) + " to " + rounded(borders[i]), borders[i - 1], borders[i]);
  add("from " + rounded(borders.back()), borders.back(), HUGE_VAL);
}

// Not of finite input, but the promise holds for it, too.
bool getsNoNumber(const Case& c) {
  return c.happening >= Happening::NaNVelocity;
}

std::vector<CaseRange> caseRanges() {
  std::vector<CaseRange> rows = {{"all", [](const Case&) { return true; }}};
  addRanges(rows, "stiffness, of `concrete_soft`'s", &Case::stiffness, {1e-3, 1, 1e3});
  addRanges(rows, "radius of the elements, m", &Case::radius, {0.01, 0.3, 10});
  addRanges(rows, "mass of the impactor / of one element", &Case::massRatio, {1e-3, 1, 1e3});
  addRanges(rows, "speed, m/s", &Case::speed, {1, 30});
  addRanges(rows, "gravity, m/s^2", &Case::gravity, {9, 100}, true);
  addRanges(rows, "frame step, s", &Case::frameStep, {0.004, 0.017});
  addRanges(rows, "distance from the origin, m", &Case::distance, {100}, true);
  rows.push_back({"frame steps that jump", [](const Case& c) { return c.jumping; }});
  rows.push_back({"NaN or an infinite force from the application", getsNoNumber});
  rows.push_back({"whole until struck", [](const Case& c) { return c.regime == Regime::RigidUntilStruck; }});
  rows.push_back({"in double", [](const Case& c) { return c.precision == Precision::Double; }});
  rows.push_back({"`Model::paper()`", [](const Case& c) { return c.paper; }});
  return rows;
}

std::string onOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// Borders of cells along an axis, growing.
struct MapAxis {
  std::string name;
  double Case::*field;
  std::vector<double> ends;
  bool isLogarithm;  // what is written at the borders

  // What lies beyond is in the outermost.
  std::size_t cell(const Case& c) const {
    const auto next = std::upper_bound(ends.begin() + 1, ends.end() - 1, c.*field);
    return std::size_t(next - ends.begin() - 1);
  }
  std::vector<std::string> labels() const {
    std::vector<std::string> words;
    for (const double end : ends)
      words.push_back(isLogarithm ? std::to_string(std::lround(std::log10(end))) : rounded(end));
    return words;
  }
};

std::vector<double> geometric(double first, double factor, int count) {
  std::vector<double> ends = {first};
  for (int i = 0; i < count; ++i) ends.push_back(ends.back() * factor);
  return ends;
}

HeatMap::Panel mapPanel(std::span<const StabilityResult> results, const MapAxis& across, const MapAxis& up,
                        bool stock) {
  HeatMap::Panel panel{.title = stock ? "stock Bullet, a rigid box in place of the body" : "Rubble",
                       .across = across.name,
                       .up = up.name,
                       .columnEnds = across.labels(),
                       .rowEnds = up.labels(),
                       .counts = {}};
  const std::size_t columns = across.ends.size() - 1;
  panel.counts.assign(columns * (up.ends.size() - 1), std::vector<int>(kStabilityKinds));
  for (const StabilityResult& r : results) {
    const std::size_t stockKind = r.stock.violation.empty() ? 0 : kStabilityKinds - 1;
    ++panel.counts[up.cell(r.definition) * columns + across.cell(r.definition)]
                  [stock ? stockKind : kindOf(r.outcome)];
  }
  return panel;
}

}  // namespace

std::size_t kindOf(const stability::Outcome& outcome) {
  return outcome.violations.empty() ? std::size_t(outcome.kind) : kStabilityKinds - 1;
}

const char* kindName(std::size_t kind) {
  return kind + 1 == kStabilityKinds ? "promise broken" : nameOf(stability::Outcome::Kind(kind));
}

TextRows stabilityTable(std::span<const StabilityResult> results) {
  TextRows table = {{"cases", "all"}};
  for (std::size_t kind = 0; kind < kStabilityKinds; ++kind) table[0].push_back(kindName(kind));
  table[0].push_back("stock Bullet: stable");
  table[0].push_back("stock Bullet: promise broken");
  for (const CaseRange& row : caseRanges()) {
    std::array<int, kStabilityKinds> counts{};
    int all = 0, broken = 0;
    for (const StabilityResult& r : results) {
      if (!row.holds(r.definition)) continue;
      ++all;
      ++counts[kindOf(r.outcome)];
      broken += r.stock.violation.empty() ? 0 : 1;
    }
    if (all == 0) continue;
    table.push_back({row.name, std::to_string(all)});
    for (const int count : counts) table.back().push_back(std::to_string(count));
    table.back().push_back(std::to_string(all - broken));
    table.back().push_back(std::to_string(broken));
  }
  return table;
}

TextRows stabilityCsv(std::span<const StabilityResult> results) {
  TextRows table = {{"case",        "outcome",     "said",         "broken",       "ticks",
                     "work",        "put_J",       "held_J",       "stock",        "stock_broken",
                     "stock_ticks", "stock_put_J", "stock_held_J", "stiffness",    "radius_m",
                     "elements",    "mass_ratio",  "speed_m_s",    "gravity_m_s2", "frame_step_s",
                     "definition",  "commit",      "machine"}};
  for (const StabilityResult& r : results) {
    const Case& c = r.definition;
    table.push_back({std::to_string(c.number),
                     kindName(kindOf(r.outcome)),
                     onOneLine(r.outcome.said),
                     r.outcome.violations.empty() ? "" : onOneLine(r.outcome.violations.front()),
                     std::to_string(r.outcome.ticks),
                     rounded(r.outcome.work),
                     rounded(r.outcome.energyPut),
                     rounded(r.outcome.energyHeld),
                     r.stock.violation.empty() ? "stable" : "promise broken",
                     onOneLine(r.stock.violation),
                     std::to_string(r.stock.ticks),
                     rounded(r.stock.energyPut),
                     rounded(r.stock.energyHeld),
                     rounded(c.stiffness),
                     rounded(c.radius),
                     std::to_string(c.elements),
                     rounded(c.massRatio),
                     rounded(c.speed),
                     rounded(c.gravity),
                     rounded(c.frameStep),
                     describe(c),
                     commitName(),
                     machineName()});
  }
  return table;
}

HeatMap stabilityMap(std::span<const StabilityResult> results) {
  const MapAxis stiffness{"stiffness, of concrete_soft's, power of ten", &Case::stiffness,
                          geometric(1e-6, 10, 12), true};
  const MapAxis mass{"mass of the impactor / of one element, power of ten", &Case::massRatio,
                     geometric(1e-6, 100, 6), true};
  const MapAxis step{"frame step, s", &Case::frameStep, geometric(1e-3, 2, 6), false};
  constexpr std::array kColours = {"#009e73", "#f0e442", "#c8c8c8", "#0072b2", "#d55e00"};
  HeatMap map{.title = "What " + std::to_string(results.size()) +
                       " generated cases came to; each cell is split by their shares",
              .kinds = {},
              .panels = {},
              .notes = {}};
  for (std::size_t kind = 0; kind < kStabilityKinds; ++kind)
    map.kinds.push_back({kindName(kind), kColours[kind]});
  for (const MapAxis& up : {mass, step})
    for (const bool stock : {false, true}) map.panels.push_back(mapPanel(results, stiffness, up, stock));
  return map;
}

}  // namespace rubble::demo
