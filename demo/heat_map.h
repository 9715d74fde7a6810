// How often each of a few kinds of outcome came over two quantities, as an SVG file.
#pragma once

#include <string>
#include <vector>

namespace rubble::demo {

/// Panels of cells, two a line. A cell is split from left to right by the shares of the kinds in it; one
/// without any stays white.
struct HeatMap {
  struct Kind {
    std::string name, colour;
  };
  struct Panel {
    std::string title;
    std::string across, up;                        ///< what is along the axes, with the unit
    std::vector<std::string> columnEnds, rowEnds;  ///< numbers at the borders, from the left and from below
    std::vector<std::vector<int>> counts;          ///< of each kind; cell by cell, the lowest row first
  };
  std::string title;
  std::vector<Kind> kinds;
  std::vector<Panel> panels;
  std::vector<std::string> notes;  ///< lines below
};

/// The whole file.
std::string svgOf(const HeatMap& map);

}  // namespace rubble::demo
