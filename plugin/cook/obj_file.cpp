// By hand: CGAL's reader leaves out all but the shape, and tinyobjloader takes a number that it cannot read
// for zero and rounds those that it can by a parser of its own, so that a damaged file would give another
// solid.
#include "cook/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>

#include "base/material_name.h"
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

// Takes the next word off the line; empty at its end.
std::string_view takeWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(word.size());
  return word;
}

// False unless all of the word is a finite number.
template <class Number>
bool read(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [next, error] = std::from_chars(word.data(), end, number);
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(number)) return false;
  return !word.empty() && error == std::errc() && next == end;
}

// False unless the first words are numbers, `least` of them; those behind are zero. What follows is not
// looked at.
template <class Vector>
bool read(std::string_view line, Vector& vector, int least) {
  vector.setZero();
  for (int axis = 0; axis < vector.size(); ++axis) {
    const std::string_view word = takeWord(line);
    if (word.empty() && axis >= least) return true;
    if (!read(word, vector[axis])) return false;
  }
  return true;
}

class ObjParser {
 public:
  explicit ObjParser(const std::string& text) : m_lines(text) {}

  PolygonSoup parse() {
    while (!m_lines.isAtEnd()) {
      const std::string line = m_lines.take();
      std::string_view rest = line;
      takeLine(takeWord(rest), rest);
    }
    if (!m_soup.looks.empty()) m_soup.looks.resize(m_soup.polygons.size());
    return std::move(m_soup);
  }

 private:
  void takeLine(std::string_view keyword, std::string_view rest) {
    if (keyword == "v") {
      if (!read(rest, m_soup.points.emplace_back(), 3)) refuse("vertex", "v and three finite numbers");
    } else if (keyword == "vn") {
      if (!read(rest, m_soup.normals.emplace_back(), 3)) refuse("normal", "vn and three finite numbers");
    } else if (keyword == "vt") {
      if (!read(rest, m_soup.uvs.emplace_back(), 1))
        refuse("texture coordinates", "vt and one to three finite numbers");
    } else if (keyword == "usemtl") {
      useMaterial(rest);
    } else if (keyword == "f") {
      takeFace(rest);
    }
  }

  void useMaterial(std::string_view name) {
    name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
    name.remove_suffix(name.size() - std::min(name.find_last_not_of(' ') + 1, name.size()));
    if (!base::isMaterialName(name)) refuse("material", std::string("usemtl and ") + base::kMaterialNames);
    m_material = name;
    m_usesMaterials = true;
  }

  void takeFace(std::string_view rest) {
    auto& polygon = m_soup.polygons.emplace_back();
    m_look.clear();
    bool hasLook = false;
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
      CornerLook& look = m_look.emplace_back();
      polygon.push_back(takeCorner(word, look));
      hasLook = hasLook || look.uv != kNoLook || look.normal != kNoLook;
    }
    if (hasLook) {
      m_soup.looks.resize(m_soup.polygons.size());
      m_soup.looks.back() = m_look;
    }
    takeMaterial();
  }

  // One of v, v/vt, v//vn and v/vt/vn.
  std::uint32_t takeCorner(std::string_view word, CornerLook& look) const {
    const std::size_t first = std::min(word.find('/'), word.size());
    const std::uint32_t vertex = takeIndex(word.substr(0, first), m_soup.points.size());
    if (first == word.size()) return vertex;
    word.remove_prefix(first + 1);
    const std::size_t second = std::min(word.find('/'), word.size());
    if (second > 0) look.uv = takeIndex(word.substr(0, second), m_soup.uvs.size());
    // v/ and v//, as some programs write them, name nothing.
    if (second + 1 < word.size()) look.normal = takeIndex(word.substr(second + 1), m_soup.normals.size());
    return vertex;
  }

  // Counted from 1, or back from the last one so far, which is -1. What is too large to be named is
  // kTooLarge.
  std::uint32_t takeIndex(std::string_view word, std::size_t count) const {
    constexpr std::uint32_t kTooLarge = kNoLook - 1;
    std::int64_t index = 0;
    const bool isRead = read(word, index);
    if (isRead && index < 0) index += std::int64_t(count) + 1;
    if (!isRead || index < 1)
      refuse("face",
             "f and corners v, v/vt, v//vn or v/vt/vn, which count from 1 or, back from the last, from -1");
    return std::uint32_t(std::min<std::int64_t>(index - 1, kTooLarge));
  }

  // Of the last polygon. Those before the first usemtl have one without a name.
  void takeMaterial() {
    if (!m_usesMaterials) return;
    const auto number = [this](const std::string& name) {
      const auto [entry, isNew] = m_numbers.try_emplace(name, m_soup.materialNames.size());
      if (isNew) m_soup.materialNames.push_back(name);
      if (m_soup.materialNames.size() > base::kMostMaterials)
        throw Error("names more materials than are allowed: up to " + std::to_string(base::kMostMaterials));
      return std::uint16_t(entry->second);
    };
    const std::size_t before = m_soup.polygons.size() - 1;
    if (m_soup.materials.size() < before) m_soup.materials.resize(before, number(""));
    m_soup.materials.push_back(number(m_material));
  }

  [[noreturn]] void refuse(const char* what, const std::string& allowed) const {
    throw Error("line " + std::to_string(m_lines.number()) + " is no " + what + "; allowed: " + allowed);
  }

  Lines m_lines;
  PolygonSoup m_soup;
  std::vector<CornerLook> m_look;  // of the face that is read
  std::string m_material;
  bool m_usesMaterials = false;
  std::map<std::string, std::size_t> m_numbers;  // of the materials, by name
};

}  // namespace

PolygonSoup parseObj(const std::string& text) {
  return ObjParser(text).parse();
}

}  // namespace rubble::cooking
