// The layout of the asset file. Little-endian whatever the host; every record is written field by field, so
// padding never shows.
//
//   magic "RUBBLEAS" | version u32 | header size u32 | checksum u64 | radius f64 | 8 counts u64 | the arrays,
//   in that order
//
// The checksum covers everything behind it. The counts say how long the file must be.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>

#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::base {

inline constexpr std::array<char, 8> kAssetMagic = {'R', 'U', 'B', 'B', 'L', 'E', 'A', 'S'};
inline constexpr std::uint32_t kAssetVersion = 1;

enum AssetArray {
  kElements,
  kSprings,
  kAnchors,
  kVertices,
  kCorners,
  kTriangles,
  kFaces,
  kCells,
  kAssetArrays
};

/// Bytes of one record of each array in the file, and what messages call it.
struct AssetRecord {
  std::uint64_t bytes;
  const char* name;
};
inline constexpr std::array<AssetRecord, kAssetArrays> kAssetRecords = {{{3 * 8 + 8 + 8, "elements"},
                                                                         {4 + 4 + 8, "springs"},
                                                                         {4 + 8 + 3 * 8, "anchors"},
                                                                         {3 * 4 + 4 * 4, "cell vertices"},
                                                                         {4 + 4 + 3 * 4, "corners"},
                                                                         {3 * 4, "triangles"},
                                                                         {4 + 4 + 3 * 4 + 3 * 4, "faces"},
                                                                         {5 * 4, "cells"}}};
using AssetCounts = std::array<std::uint64_t, kAssetArrays>;

inline constexpr std::size_t kAssetChecksumOffset = kAssetMagic.size() + 4 + 4;
inline constexpr std::size_t kAssetBodyOffset = kAssetChecksumOffset + 8;  ///< where the checksum's cover begins
inline constexpr std::size_t kAssetHeaderBytes = kAssetBodyOffset + 8 + 8 * kAssetArrays;
/// Files are read and written in pieces of so many bytes; a multiple of the checksum's words.
inline constexpr std::size_t kAssetBlock = 1 << 16;
static_assert(kAssetBlock % 8 == 0);

/// Copies a plain number to or from its little-endian bytes.
template <class T>
void swapToLittleEndian(std::span<std::uint8_t, sizeof(T)> bytes) {
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
}

/// Takes vectors, arrays and numbers apart and calls `number` with a reference to each plain number.
template <class Value, class Number>
void visitNumbers(Value& value, Number&& number) {
  if constexpr (std::is_arithmetic_v<std::remove_const_t<Value>>) {
    number(value);
  } else {
    for (std::size_t k = 0; k < std::size_t(value.size()); ++k) number(value[typename SizeOf<Value>::Index(k)]);
  }
}

}  // namespace rubble::base
