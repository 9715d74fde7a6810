#include "demo/bar_chart.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "demo/markdown_table.h"
#include "demo/svg.h"

namespace rubble::demo {
namespace {

// Lengths in pixels of the SVG.
constexpr double kLabels = 260;  // left of the axis
constexpr double kPlot = 520;    // the axis
constexpr double kRight = 60;    // for the number behind the longest bar
constexpr double kWidth = kLabels + kPlot + kRight;
constexpr double kTop = 74;  // title, legend and the axis' numbers
constexpr double kBar = 9, kRow = 2 * kBar + 8;
constexpr double kLine = 16;  // of the notes

constexpr const char* kFirstColour = "#8a8a8a";
constexpr const char* kSecondColour = "#1f6fb4";

// Powers of ten around all numbers, at least one decade.
struct LogAxis {
  explicit LogAxis(const std::vector<BarChart::Row>& rows) {
    double low = HUGE_VAL, high = 0;
    for (const BarChart::Row& row : rows) {
      for (const std::optional<double>& value : {row.first, row.second}) {
        if (!value) continue;
        assert(*value > 0 && std::isfinite(*value));
        low = std::min(low, *value);
        high = std::max(high, *value);
      }
    }
    assert(high > 0);
    first = int(std::ceil(std::log10(low))) - 1;  // below the smallest, which shall have a bar
    last = std::max(int(std::ceil(std::log10(high))), first + 1);
  }
  double at(double value) const {
    return kLabels + kPlot * (std::log10(value) - first) / double(last - first);
  }
  int first, last;  // exponents
};

void drawHead(Svg& svg, const BarChart& chart) {
  constexpr double kTitle = 20, kLegend = 40, kSecondEntry = 160;
  svg.text(kLabels, kTitle, chart.title);
  svg.rectangle(kLabels, kLegend - kBar, kBar, kBar, kFirstColour);
  svg.text(kLabels + 2 * kBar, kLegend, chart.first);
  svg.rectangle(kLabels + kSecondEntry, kLegend - kBar, kBar, kBar, kSecondColour);
  svg.text(kLabels + kSecondEntry + 2 * kBar, kLegend, chart.second);
  svg.text(kLabels - kBar, kTop - kBar, chart.axis, "end");
}

void drawAxis(Svg& svg, const LogAxis& axis, double bottom) {
  for (int exponent = axis.first; exponent <= axis.last; ++exponent) {
    const double value = std::pow(10.0, exponent), x = axis.at(value);
    svg.rectangle(x, kTop, 1, bottom - kTop, "#d8d8d8");
    svg.text(x, kTop - kBar, rounded(value), "middle");
  }
}

void drawBar(Svg& svg, const LogAxis& axis, double y, const std::optional<double>& value,
             const char* colour) {
  constexpr double kGap = 4;
  const double end = value ? axis.at(*value) : kLabels;
  if (value) svg.rectangle(kLabels, y, end - kLabels, kBar, colour);
  svg.text(end + kGap, y + kBar, value ? rounded(*value) : "-");
}

}  // namespace

std::string svgOf(const BarChart& chart) {
  const LogAxis axis(chart.rows);
  const double bottom = kTop + kRow * double(chart.rows.size());
  const std::vector<std::string> notes = wrappedForSvg(chart.notes);
  Svg svg(kWidth, bottom + kLine * double(notes.size() + 1));
  drawHead(svg, chart);
  drawAxis(svg, axis, bottom);
  double y = kTop;
  for (const BarChart::Row& row : chart.rows) {
    constexpr double kBase = 14;  // of the label, from the top of its row
    svg.text(kLabels - kBar, y + kBase, row.label, "end");
    drawBar(svg, axis, y + 2, row.first, kFirstColour);
    drawBar(svg, axis, y + 2 + kBar, row.second, kSecondColour);
    y += kRow;
  }
  for (const std::string& note : notes) svg.text(kBar, y += kLine, note);
  return svg.finish();
}

}  // namespace rubble::demo
