#include "demo/markdown_table.h"

#include <iomanip>
#include <sstream>

namespace rubble::demo {

std::string markdownTable(const TextRows& rows) {
  std::ostringstream text;
  for (const std::vector<std::string>& row : rows) {
    text << '|';
    for (const std::string& cell : row) text << ' ' << cell << " |";
    text << '\n';
    if (&row != &rows.front()) continue;
    text << '|';
    for (std::size_t c = 0; c < row.size(); ++c) text << "---|";
    text << '\n';
  }
  return text.str();
}

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

}  // namespace rubble::demo
