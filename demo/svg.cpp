#include "demo/svg.h"

namespace rubble::demo {
namespace {

constexpr std::size_t kLetters = 130;  // of a note's line, about 6 pixels each

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> wrappedForSvg(const std::vector<std::string>& notes) {
  std::vector<std::string> lines;
  for (const std::string& note : notes) {
    std::istringstream words(note);
    lines.emplace_back();
    for (std::string word; words >> word;) {
      if (!lines.back().empty() && lines.back().size() + 1 + word.size() > kLetters) lines.emplace_back();
      lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
  }
  return lines;
}

Svg::Svg(double width, double height) {
  m_out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
        << "\" viewBox=\"0 0 " << width << ' ' << height
        << "\" font-family=\"sans-serif\" font-size=\"11\">\n";
  rectangle(0, 0, width, height, "#ffffff");
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& colour) {
  m_out << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << width << "\" height=\"" << height
        << "\" fill=\"" << colour << "\"/>\n";
}

void Svg::text(double x, double y, const std::string& words, const char* anchor) {
  m_out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << escaped(words)
        << "</text>\n";
}

void Svg::line(double x1, double y1, double x2, double y2, const std::string& colour, double thickness) {
  m_out << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2 << "\" stroke=\""
        << colour << "\" stroke-width=\"" << thickness << "\"/>\n";
}

void Svg::circle(double x, double y, double radius, const std::string& colour, bool filled) {
  m_out << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"" << radius << "\" stroke=\"" << colour
        << "\" stroke-width=\"2\" fill=\"" << (filled ? colour : "none") << "\"/>\n";
}

std::string Svg::finish() {
  m_out << "</svg>\n";
  return m_out.str();
}

}  // namespace rubble::demo
