#include "cook/ply_header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>

#include "rubble/error.h"

namespace rubble::cooking {
namespace {

struct NamedPlyType {
  std::array<std::string_view, 2> names;
  PlyType type;
};
constexpr std::array<NamedPlyType, 8> kPlyTypes = {{{{"char", "int8"}, PlyType::Char},
                                                    {{"uchar", "uint8"}, PlyType::UChar},
                                                    {{"short", "int16"}, PlyType::Short},
                                                    {{"ushort", "uint16"}, PlyType::UShort},
                                                    {{"int", "int32"}, PlyType::Int},
                                                    {{"uint", "uint32"}, PlyType::UInt},
                                                    {{"float", "float32"}, PlyType::Float},
                                                    {{"double", "float64"}, PlyType::Double}}};

std::optional<PlyType> plyTypeOf(const std::string& word) {
  for (const NamedPlyType& known : kPlyTypes)
    if (word == known.names[0] || word == known.names[1]) return known.type;
  return std::nullopt;
}

class PlyHeader {
 public:
  explicit PlyHeader(const std::string& bytes) : m_bytes(bytes) {}

  PlyLayout read() {
    if (take() != "ply") refuse("does not start with ply", "ply");
    while (readLine()) {
    }
    if (!m_hasFormat) throw Error("its PLY header names no format; allowed: " + std::string(kFormats));
    m_layout.bodyAt = m_at;
    return std::move(m_layout);
  }

 private:
  static constexpr const char* kFormats = "ascii, binary_little_endian, binary_big_endian";

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
    const std::string format = word();
    if (format == "ascii") {
      m_layout.format = PlyFormat::Ascii;
    } else if (format == "binary_little_endian") {
      m_layout.format = PlyFormat::LittleEndian;
    } else if (format == "binary_big_endian") {
      m_layout.format = PlyFormat::BigEndian;
    } else {
      refuse("names no format", kFormats);
    }
    m_hasFormat = true;
  }

  void readElement() {
    PlyElement& element = m_layout.elements.emplace_back();
    element.name = word();
    if (!(m_words >> element.count)) refuse("has no number of elements", "element, name, number");
  }

  void readProperty() {
    if (m_layout.elements.empty()) refuse("is a property of nothing", "properties behind their element");
    PlyProperty property;
    std::string type = word();
    property.isList = type == "list";
    if (property.isList) {
      const std::optional<PlyType> count = plyTypeOf(word());
      if (!count || *count == PlyType::Float || *count == PlyType::Double)
        refuse("is no list", "property list, whole type, type, name");
      property.countType = *count;
      type = word();
    }
    const std::optional<PlyType> known = plyTypeOf(type);
    property.name = word();
    if (!known || property.name.empty()) refuse("is no property", "property, type, name");
    property.type = *known;
    m_layout.elements.back().properties.push_back(property);
  }

  const std::string& m_bytes;
  std::size_t m_at = 0, m_line = 0;
  std::istringstream m_words;
  PlyLayout m_layout;
  bool m_hasFormat = false;
};

}  // namespace

PlyLayout readPlyHeader(const std::string& bytes) {
  return PlyHeader(bytes).read();
}

}  // namespace rubble::cooking
