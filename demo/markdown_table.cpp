#include "demo/markdown_table.h"

#include <cmath>
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
  const bool thousands = std::abs(value) >= 999.5 && std::abs(value) < 1e6;  // else 2300 reads 2.3e+03
  return thousands ? std::to_string(std::lround(std::stod(text.str()))) : text.str();
}

}  // namespace rubble::demo
