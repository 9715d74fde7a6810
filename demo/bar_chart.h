// Two numbers side by side for each of a few settings, as an SVG file.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rubble::demo {

/// Lying bars on a logarithmic axis.
struct BarChart {
  struct Row {
    std::string label;
    std::optional<double> first, second;  ///< > 0; none: no bar, a dash
  };
  std::string title;
  std::string axis;           ///< what the numbers are, with their unit
  std::string first, second;  ///< names of the two series
  std::vector<Row> rows;
  std::vector<std::string> notes;  ///< lines below
};

/// The whole file. At least one row must have a number.
std::string svgOf(const BarChart& chart);

}  // namespace rubble::demo
