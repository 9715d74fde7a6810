#include "demo/csv_table.h"

namespace rubble::demo {
namespace {

// JSON values and names of machines hold commas and quotes.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + '"';
}

}  // namespace

std::string csvTable(const TextRows& rows) {
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) text += ',';
      text += quoted(row[c]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace rubble::demo
