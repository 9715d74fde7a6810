// The parts that our charts are made of, as an SVG file.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace rubble::demo {

/// Broken between words into lines of about 130 letters: SVG breaks none by itself.
std::vector<std::string> wrappedForSvg(const std::vector<std::string>& notes);

/// A picture on white; lengths in pixels from its upper left corner.
class Svg {
 public:
  Svg(double width, double height);
  void rectangle(double x, double y, double width, double height, const std::string& colour);
  /// `anchor`: start, middle or end of the text stands at x.
  void text(double x, double y, const std::string& words, const char* anchor = "start");
  void line(double x1, double y1, double x2, double y2, const std::string& colour, double thickness = 1);
  /// A disk, or a ring where it is not `filled`.
  void circle(double x, double y, double radius, const std::string& colour, bool filled = true);
  /// The whole file.
  std::string finish();

 private:
  std::ostringstream m_out;
};

}  // namespace rubble::demo
