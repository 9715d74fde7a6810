// The numbers of a PLY file, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "cook/ply_header.h"

namespace rubble::cooking {

class PlyBody {
 public:
  /// `bytes` must outlive it.
  PlyBody(const std::string& bytes, const PlyLayout& layout)
      : m_rest(std::string_view(bytes).substr(layout.bodyAt)), m_format(layout.format) {}

  /// The next number, as its type holds it. False where the file ends, or has none in its text.
  bool take(PlyType type, double& number);
  /// Whether the last take failed for the file's end.
  bool hasEnded() const { return m_hasEnded; }

 private:
  bool takeText(double& number);
  bool takeBytes(PlyType type, double& number);

  std::string_view m_rest;
  PlyFormat m_format;
  bool m_hasEnded = false;
};

}  // namespace rubble::cooking
