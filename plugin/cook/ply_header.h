// What the header of a PLY file says lies behind it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rubble::cooking {

enum class PlyFormat { Ascii, LittleEndian, BigEndian };
enum class PlyType { Char, UChar, Short, UShort, Int, UInt, Float, Double };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float;  ///< of a list, that of its items
  bool isList = false;
  PlyType countType = PlyType::UChar;  ///< of a list: whole
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as the file says: it may hold fewer
  std::vector<PlyProperty> properties;
};

struct PlyLayout {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::size_t bodyAt = 0;  ///< [bytes] from the file's start
};

/// Throws rubble::Error that names the line which is wrong and what is allowed.
PlyLayout readPlyHeader(const std::string& bytes);

}  // namespace rubble::cooking
