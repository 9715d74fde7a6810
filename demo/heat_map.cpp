#include "demo/heat_map.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "demo/svg.h"

namespace rubble::demo {
namespace {

// Lengths in pixels of the SVG.
constexpr double kMapMargin = 10;
constexpr double kMapLine = 16;                         // of text
constexpr double kMapHead = 2 * kMapMargin + kMapLine;  // title and legend
constexpr double kPanelWidth = 430;                     // with its axes
constexpr double kUpAxis = 60;                          // left of the cells
constexpr double kCells = kPanelWidth - kUpAxis;        // their width
constexpr double kAboveCells = 3 * kMapLine;            // of the cells: title and the name of the upward axis
constexpr double kBelowCells = 3 * kMapLine;
constexpr double kCellHeight = 30, kCellGap = 3;

double heightOf(const HeatMap::Panel& panel) {
  return kAboveCells + kCellHeight * double(panel.rowEnds.size() - 1) + kBelowCells;
}

void drawKinds(Svg& svg, const std::vector<HeatMap::Kind>& kinds) {
  constexpr double kSquare = 10, kLetter = 6.5;
  double x = kMapMargin;
  for (const HeatMap::Kind& kind : kinds) {
    svg.rectangle(x, kMapHead - kSquare, kSquare, kSquare, kind.colour);
    svg.text(x + 1.5 * kSquare, kMapHead - 1, kind.name);
    x += 3 * kSquare + kLetter * double(kind.name.size());
  }
}

void drawCell(Svg& svg, double x, double y, double width, const std::vector<int>& counts,
              const std::vector<HeatMap::Kind>& kinds) {
  const int all = std::accumulate(counts.begin(), counts.end(), 0);
  double at = x + kCellGap / 2;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    const double share = (width - kCellGap) * counts[k] / all;
    svg.rectangle(at, y + kCellGap / 2, share, kCellHeight - kCellGap, kinds[k].colour);
    at += share;
  }
}

void drawPanel(Svg& svg, double x, double y, const HeatMap::Panel& panel,
               const std::vector<HeatMap::Kind>& kinds) {
  constexpr double kBase = 4;  // of a number, below the middle of its line
  const std::size_t columns = panel.columnEnds.size() - 1, rows = panel.rowEnds.size() - 1;
  assert(panel.counts.size() == columns * rows);
  const double left = x + kUpAxis, top = y + kAboveCells, width = (kCells - 2 * kMapMargin) / double(columns);
  const double bottom = top + kCellHeight * double(rows);
  svg.text(left, y + kMapLine, panel.title);
  svg.text(x + kMapMargin, top - kMapMargin, panel.up);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      drawCell(svg, left + width * double(c), bottom - kCellHeight * double(r + 1), width,
               panel.counts[r * columns + c], kinds);
  for (std::size_t r = 0; r <= rows; ++r)
    svg.text(left - kBase, bottom - kCellHeight * double(r) + kBase, panel.rowEnds[r], "end");
  for (std::size_t c = 0; c <= columns; ++c)
    svg.text(left + width * double(c), bottom + kMapLine, panel.columnEnds[c], "middle");
  svg.text(left + (kCells - 2 * kMapMargin) / 2, bottom + 2 * kMapLine, panel.across, "middle");
}

}  // namespace

std::string svgOf(const HeatMap& map) {
  const std::vector<std::string> notes = wrappedForSvg(map.notes);
  double bottom = kMapHead;
  for (std::size_t p = 0; p < map.panels.size(); p += 2) bottom += heightOf(map.panels[p]);
  Svg svg(2 * kPanelWidth, bottom + kMapLine * double(notes.size() + 1));
  svg.text(kMapMargin, kMapMargin + kMapLine / 2, map.title);
  drawKinds(svg, map.kinds);
  double y = kMapHead;
  for (std::size_t p = 0; p < map.panels.size(); ++p) {
    drawPanel(svg, kPanelWidth * double(p % 2), y, map.panels[p], map.kinds);
    if (p % 2 == 1) y += heightOf(map.panels[p]);
  }
  for (const std::string& note : notes) svg.text(kMapMargin, bottom += kMapLine, note);
  return svg.finish();
}

}  // namespace rubble::demo
