// Which names and numbers of materials a mesh and an asset may have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace rubble::base {

/// 16 bits name them, and the one of inner faces.
inline constexpr std::size_t kMostMaterials = 0xfffe;
/// Of a name [bytes]. Names are for files, messages and look-ups, where such lengths are damage.
inline constexpr std::size_t kMostNameBytes = 255;
/// Of a preset's name [bytes]: the file has room for 64, the last of them a zero.
inline constexpr std::size_t kMostPresetBytes = 63;
inline constexpr const char* kMaterialNames = "up to 255 bytes without control characters";

inline bool isMaterialName(std::string_view name) {
  const auto isControl = [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; };
  return name.size() <= kMostNameBytes && std::none_of(name.begin(), name.end(), isControl);
}

}  // namespace rubble::base
