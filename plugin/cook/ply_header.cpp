#include "cook/ply_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <string_view>

#include "rubble/error.h"

namespace rubble::cooking {
namespace {

constexpr std::array<std::array<std::string_view, 2>, 8> kTypes = {{{"char", "int8"},
                                                                    {"uchar", "uint8"},
                                                                    {"short", "int16"},
                                                                    {"ushort", "uint16"},
                                                                    {"int", "int32"},
                                                                    {"uint", "uint32"},
                                                                    {"float", "float32"},
                                                                    {"double", "float64"}}};

// A type by the first of its two names; empty if it is none.
std::string_view typeOf(const std::string& word) {
  for (const auto& names : kTypes)
    if (word == names[0] || word == names[1]) return names[0];
  return {};
}

class Header {
 public:
  explicit Header(const std::string& bytes) : m_bytes(bytes) {}

  std::string plain() {
    if (take() != "ply") refuse("does not start with ply", "ply");
    while (readLine()) {
    }
    constexpr int kVertexNumbers = 3;
    if (m_format.empty() || m_coordinates != kVertexNumbers || m_faceLists != 1)
      throw Error(
          "its PLY header names no mesh; allowed: a format, vertices with x, y and z, and faces with "
          "vertex_indices, each once");
    return "ply\nformat " + m_format + " 1.0\n" + m_plain + "end_header\n" + m_bytes.substr(m_at);
  }

 private:
  [[noreturn]] void refuse(const std::string& wrong, const std::string& allowed) const {
    throw Error("line " + std::to_string(m_line) + " of its PLY header " + wrong + "; allowed: " + allowed);
  }

  // The first word of the next line; m_words goes on behind it.
  std::string take() {
    const std::size_t end = m_bytes.find('\n', m_at);
    ++m_line;
    if (end == std::string::npos) refuse("is the last", "a header that ends with end_header");
    m_words = std::istringstream(m_bytes.substr(m_at, end - m_at));
    m_at = end + 1;
    return word();
  }
  std::string word() {
    std::string text;
    m_words >> text;
    return text;
  }

  // False at the header's end.
  bool readLine() {
    const std::string keyword = take();
    if (keyword == "end_header") return false;
    if (keyword == "format") {
      readFormat();
    } else if (keyword == "element") {
      readElement();
    } else if (keyword == "property") {
      readProperty();
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      refuse("starts with no keyword", "format, element, property, comment, obj_info, end_header");
    }
    return true;
  }

  void readFormat() {
    m_format = word();
    for (const char* known : {"ascii", "binary_little_endian", "binary_big_endian"})
      if (m_format == known) return;
    refuse("names no format", "ascii, binary_little_endian, binary_big_endian");
  }

  void readElement() {
    m_element = word();
    std::uint64_t count = 0;
    if (!(m_words >> count)) refuse("has no number of elements", "element, name, number");
    const bool isUsed = m_element == "vertex" || m_element == "face";
    m_plain += "element " + (isUsed ? m_element : "unused") + ' ' + std::to_string(count) + '\n';
  }

  void readProperty() {
    const std::string first = word();
    if (m_element.empty()) refuse("is a property of nothing", "properties behind their element");
    if (first == "list") return readList();
    const std::string_view type = typeOf(first);
    const std::string name = word();
    if (type.empty() || name.empty()) refuse("is no property", "property, type, name");
    const bool isCoordinate = m_element == "vertex" && (name == "x" || name == "y" || name == "z");
    if (isCoordinate && type != "float" && type != "double")
      refuse("makes a coordinate a " + std::string(type), "float and double");
    m_coordinates += isCoordinate;
    m_plain += "property " + std::string(type) + ' ' + (isCoordinate ? name : "unused") + '\n';
  }

  // Counts in 32 bits could claim gigabytes, and CGAL believes them. In text they are written like any other.
  void readList() {
    std::string_view count = typeOf(word());
    const std::string_view item = typeOf(word());
    const std::string name = word();
    if (count.empty() || item.empty() || name.empty())
      refuse("is no list", "property list, type, type, name");
    if (m_format == "ascii") count = "ushort";
    if (count != "uchar" && count != "ushort" && count != "char" && count != "short")
      refuse("counts the items of a list as " + std::string(count), "uchar, ushort, char and short");
    const bool isFace = m_element == "face" && (name == "vertex_indices" || name == "vertex_index");
    if (isFace && item != "int" && item != "uint")
      refuse("names vertices by " + std::string(item), "int and uint");
    m_faceLists += isFace;
    m_plain += "property list " + std::string(count) + ' ' + std::string(item) + ' ' +
               (isFace ? "vertex_indices" : "unused") + '\n';
  }

  const std::string& m_bytes;
  std::size_t m_at = 0, m_line = 0;
  std::istringstream m_words;
  std::string m_format, m_element, m_plain;
  int m_coordinates = 0, m_faceLists = 0;
};

}  // namespace

std::string plainPly(const std::string& bytes) {
  return Header(bytes).plain();
}

}  // namespace rubble::cooking
