// The asset file's layout, written down a second time on purpose, and tools to forge files.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/hash.h"
#include "rubble/asset.h"
#include "rubble/error.h"

namespace rubble::test {

inline constexpr std::size_t kVersionAt = 8;
inline constexpr std::size_t kHeaderSizeAt = 12;
inline constexpr std::size_t kChecksumAt = 16;
inline constexpr std::size_t kBodyAt = 24;
inline constexpr std::size_t kRadiusAt = 24;
inline constexpr std::size_t kOriginAt = 32;
inline constexpr std::size_t kPresetAt = 56;
inline constexpr std::size_t kCountsAt = 120;
inline constexpr std::size_t kHeaderBytes = 216;
inline constexpr std::size_t kOldCountsAt = 32;         // of versions 1 to 4, which have no origin
inline constexpr std::size_t kOldHeaderBytes = 96;      // of versions 1 and 2
inline constexpr std::size_t kLookHeaderBytes = 128;    // of versions 3 and 4
inline constexpr std::size_t kOriginHeaderBytes = 152;  // of version 5

/// Little-endian, as the hosts of these tests are.
template <class T>
void setNumber(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}
template <class T>
T numberAt(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// Versions 1 to 3: no gaps, the checksum of one lane.
inline bool isOld(const std::string& bytes) {
  return numberAt<std::uint32_t>(bytes, kVersionAt) <= 3;
}

/// The checksum of a file's body, word by word.
inline std::uint64_t bodySum(const std::string& bytes) {
  const auto step = [](std::uint64_t sum, std::uint64_t word) {
    sum = (sum ^ word) * base::Fnv1a::kPrime;
    return sum ^ sum >> 32;
  };
  std::vector<std::uint64_t> lanes(isOld(bytes) ? 1 : 8, base::Fnv1a::kOffsetBasis);
  for (std::size_t at = kBodyAt, word = 0; at < bytes.size(); at += 8, ++word) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    lanes[word % lanes.size()] = step(lanes[word % lanes.size()], value);
  }
  if (lanes.size() == 1) return lanes[0];
  std::uint64_t sum = base::Fnv1a::kOffsetBasis;
  for (const std::uint64_t lane : lanes) sum = step(sum, lane);
  return sum;
}

/// Makes the checksum right again.
inline void seal(std::string& bytes) {
  setNumber(bytes, kChecksumAt, bodySum(bytes));
}

inline void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
}

/// What the loader says of a file; empty if it takes it.
inline std::string refusal(const std::filesystem::path& file) {
  try {
    load(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}
/// The same of these bytes, sealed, in that file.
inline std::string refusalOf(const std::filesystem::path& file, std::string bytes) {
  seal(bytes);
  writeBytes(file, bytes);
  return refusal(file);
}

inline void expectHas(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << '"' << text << "\" lacks: " << words;
}

enum class NumberKind { Index, Float, Double, Gap };
/// Where a number stands in the file.
struct NumberPlace {
  std::string name;
  std::size_t at;
  NumberKind kind;
};

/// All numbers of the file's body but the counts, of a file of versions 1, 2 or 6 without look and static
/// state.
inline std::vector<NumberPlace> numberPlaces(const std::string& bytes) {
  using enum NumberKind;
  struct Table {
    const char* name;
    std::size_t count;  // which of the header's
    std::vector<NumberKind> record;
  };
  const std::vector<Table> tables = {
      {"positions", 0, {Double, Double, Double}},
      {"volumes", 0, {Double}},
      {"gyrations", 0, {Double}},
      {"springs", 1, {Index, Index, Double}},
      {"anchors", 2, {Index, Gap, Double, Double, Double, Double}},
      {"vertices", 3, {Float, Float, Float, Index, Index, Index, Index}},
      {"corners", 4, {Index, Index, Float, Float, Float}},
      {"triangles", 5, {Index, Index, Index}},
      {"faces", 6, {Index, Float, Float, Float, Float, Float, Float, Float}},
      {"cells", 7, {Index, Index, Index, Index, Index}},
  };
  std::vector<NumberPlace> places = {{"radius", kRadiusAt, Double}};
  const bool old = isOld(bytes);
  if (!old)
    for (std::size_t axis = 0; axis < 3; ++axis)
      places.push_back({"origin number " + std::to_string(axis), kOriginAt + 8 * axis, Double});
  const std::size_t countsAt = old ? kOldCountsAt : kCountsAt;
  std::size_t at = old ? kOldHeaderBytes : kHeaderBytes;
  for (const Table& table : tables) {
    for (std::uint64_t k = 0; k < numberAt<std::uint64_t>(bytes, countsAt + 8 * table.count); ++k)
      for (std::size_t f = 0; f < table.record.size(); ++f) {
        if (table.record[f] != Gap)
          places.push_back(
              {std::string(table.name) + '[' + std::to_string(k) + "] number " + std::to_string(f), at,
               table.record[f]});
        if (table.record[f] != Gap || !old) at += table.record[f] == Double ? 8 : 4;
      }
    if (!old) at = (at + 7) / 8 * 8;
  }
  return places;
}

}  // namespace rubble::test
