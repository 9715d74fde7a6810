#include "cook/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "rubble/error.h"

namespace rubble::cooking {
namespace {

class Lines {
 public:
  explicit Lines(const std::string& text) : m_text(text) {}

  bool isAtEnd() const { return m_at >= m_text.size(); }
  std::size_t number() const { return m_number; }  // of the last line taken, counted from 1
  /// With those that it goes on in; without leading blanks, tabs and carriage returns.
  std::string take() {
    std::string line;
    bool goesOn = true;
    while (goesOn && !isAtEnd()) {
      const std::size_t end = std::min(m_text.find('\n', m_at), m_text.size());
      line.append(m_text, m_at, end - m_at);
      m_at = end + 1;
      ++m_number;
      if (line.ends_with('\r')) line.pop_back();
      goesOn = line.ends_with('\\');
      if (goesOn) line.back() = ' ';
    }
    std::replace(line.begin(), line.end(), '\t', ' ');
    std::replace(line.begin(), line.end(), '\r', ' ');
    line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
    return line;
  }

 private:
  const std::string& m_text;
  std::size_t m_at = 0, m_number = 0;
};

bool isVertex(const std::string& line) {
  const char* at = line.data() + 1;
  const char* const end = line.data() + line.size();
  for (int axis = 0; axis < 3; ++axis) {
    while (at != end && *at == ' ') ++at;
    if (at != end && *at == '+') ++at;
    double number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number) || (next != end && *next != ' ')) return false;
    at = next;
  }
  return true;
}

}  // namespace

std::string plainObj(const std::string& text) {
  std::string plain;
  plain.reserve(text.size());
  for (Lines lines(text); !lines.isAtEnd();) {
    const std::string line = lines.take();
    const bool startsVertex = line.starts_with("v ");
    if (startsVertex && !isVertex(line))
      throw Error("line " + std::to_string(lines.number()) +
                  " is no vertex; allowed: v and three finite numbers");
    if (startsVertex || line.starts_with("f ")) plain += line + '\n';
  }
  return plain;
}

}  // namespace rubble::cooking
