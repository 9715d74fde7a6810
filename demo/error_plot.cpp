#include "demo/error_plot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "demo/markdown_table.h"
#include "demo/svg.h"

namespace rubble::demo {
namespace {

// Lengths in pixels of the SVG.
constexpr double kLeft = 70, kTop = 64;  // of the plot's corner
constexpr double kPlotWidth = 480, kPlotHeight = 340;
constexpr double kLegend = 310;       // right of the plot, at least
constexpr double kLetterWidth = 6.5;  // mean width
constexpr double kLine = 16;          // of text
constexpr double kDot = 3.5, kRing = 7;
constexpr double kMargin = 10;

// Told apart by people who see few colours (Okabe and Ito, Color Universal Design, 2008); methods beyond
// start again with squares for dots.
constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#000000"};

// Powers of ten around all values of one kind, and `also` where it is not 0; at least one decade.
struct Decades {
  Decades(const ErrorPlot& plot, double ErrorPlot::Point::*value, double also = 0) {
    double low = HUGE_VAL, high = 0;
    for (const ErrorPlot::Line& line : plot.lines) {
      for (const ErrorPlot::Point& point : line.points) {
        assert(point.*value > 0 && std::isfinite(point.*value));
        low = std::min(low, point.*value);
        high = std::max(high, point.*value);
      }
    }
    if (also > 0) {
      low = std::min(low, also);
      high = std::max(high, also);
    }
    assert(high > 0);
    first = int(std::floor(std::log10(low)));
    last = std::max(int(std::ceil(std::log10(high))), first + 1);
  }
  // 0 at the first power, 1 at the last.
  double share(double value) const { return (std::log10(value) - first) / double(last - first); }
  int first, last;  // exponents
};

struct Frame {
  explicit Frame(const ErrorPlot& plot)
      : times(plot, &ErrorPlot::Point::time), errors(plot, &ErrorPlot::Point::error, plot.level) {}
  double x(double time) const { return kLeft + kPlotWidth * times.share(time); }
  double y(double error) const { return kTop + kPlotHeight * (1 - errors.share(error)); }
  Decades times, errors;
};

void drawAxes(Svg& svg, const Frame& frame, const ErrorPlot& plot) {
  constexpr const char* kGrid = "#d8d8d8";
  constexpr double kBase = 4;  // of a number, below the middle of its line
  for (int e = frame.times.first; e <= frame.times.last; ++e) {
    const double value = std::pow(10.0, e), x = frame.x(value);
    svg.line(x, kTop, x, kTop + kPlotHeight, kGrid);
    svg.text(x, kTop + kPlotHeight + kLine, rounded(value), "middle");
  }
  for (int e = frame.errors.first; e <= frame.errors.last; ++e) {
    const double value = std::pow(10.0, e), y = frame.y(value);
    svg.line(kLeft, y, kLeft + kPlotWidth, y, kGrid);
    svg.text(kLeft - kMargin, y + kBase, rounded(value), "end");
  }
  svg.text(kMargin, kTop - kMargin, plot.errorAxis);
  svg.text(kLeft + kPlotWidth / 2, kTop + kPlotHeight + 2 * kLine, plot.timeAxis, "middle");
}

struct Look {
  explicit Look(std::size_t line)
      : colour(kColours[line % kColours.size()]), square(line / kColours.size() % 2 == 1) {}
  void draw(Svg& svg, double x, double y) const {
    if (square)
      svg.rectangle(x - kDot, y - kDot, 2 * kDot, 2 * kDot, colour);
    else
      svg.circle(x, y, kDot, colour);
  }
  const char* colour;
  bool square;
};

void drawLine(Svg& svg, const Frame& frame, const ErrorPlot::Line& line, const Look& look) {
  constexpr double kThickness = 1.5;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const ErrorPlot::Point &a = line.points[i - 1], &b = line.points[i];
    svg.line(frame.x(a.time), frame.y(a.error), frame.x(b.time), frame.y(b.error), look.colour, kThickness);
  }
  for (const ErrorPlot::Point& point : line.points) {
    look.draw(svg, frame.x(point.time), frame.y(point.error));
    if (point.standard) svg.circle(frame.x(point.time), frame.y(point.error), kRing, look.colour, false);
  }
}

void drawLevel(Svg& svg, const Frame& frame, const ErrorPlot& plot) {
  constexpr double kThickness = 2, kAbove = 4;
  constexpr const char* kGrey = "#888888";
  const double y = frame.y(plot.level);
  svg.line(kLeft, y, kLeft + kPlotWidth, y, kGrey, kThickness);
  svg.text(kLeft + kPlotWidth - kMargin, y - kAbove, plot.levelName, "end");
}

template <class Mark>
void drawLegendEntry(Svg& svg, double y, const std::string& words, Mark&& mark) {
  constexpr double kBase = 4;
  const double x = kLeft + kPlotWidth + 2 * kMargin;
  mark(x, y);
  svg.text(x + 2 * kMargin, y + kBase, words);
}

double widthOf(const ErrorPlot& plot) {
  std::size_t longest = 0;
  for (const ErrorPlot::Line& line : plot.lines) longest = std::max(longest, line.method.size());
  return kLeft + kPlotWidth + std::max(kLegend, 5 * kMargin + kLetterWidth * double(longest));
}

}  // namespace

std::string svgOf(const ErrorPlot& plot) {
  const Frame frame(plot);
  const std::vector<std::string> notes = wrappedForSvg(plot.notes);
  const double bottom = kTop + std::max(kPlotHeight + 3 * kLine, kLine * double(plot.lines.size() + 2));
  Svg svg(widthOf(plot), bottom + kLine * double(notes.size() + 1));
  svg.text(kMargin, 2 * kMargin, plot.title);
  drawAxes(svg, frame, plot);
  if (plot.level > 0) drawLevel(svg, frame, plot);
  double y = kTop;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    const Look look(i);
    drawLine(svg, frame, plot.lines[i], look);
    drawLegendEntry(svg, y, plot.lines[i].method, [&](double x, double at) { look.draw(svg, x, at); });
    y += kLine;
  }
  if (!plot.ring.empty())
    drawLegendEntry(svg, y, plot.ring,
                    [&](double x, double at) { svg.circle(x, at, kRing, "#000000", false); });
  y = bottom;
  for (const std::string& note : notes) svg.text(kMargin, y += kLine, note);
  return svg.finish();
}

}  // namespace rubble::demo
