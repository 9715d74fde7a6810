// Error against run time, both logarithmic, a line a method, as an SVG file.
#pragma once

#include <string>
#include <vector>

namespace rubble::demo {

struct ErrorPlot {
  struct Point {
    double time, error;     ///< > 0, finite
    bool standard = false;  ///< of the default setting: marked by a ring
  };
  struct Line {
    std::string method;
    std::vector<Point> points;  ///< joined in this order
  };
  std::string title;
  std::string timeAxis, errorAxis;  ///< what is measured, with its unit
  std::vector<Line> lines;
  double level = 0;                          ///< an error that is marked by a line across; 0: none
  std::string levelName = {};                ///< what it is
  std::string ring = "the default setting";  ///< what a ring marks; empty: there are none
  std::vector<std::string> notes;            ///< below
};

/// The whole file. At least one line must have a point.
std::string svgOf(const ErrorPlot& plot);

}  // namespace rubble::demo
