// By hand and not by CGAL, which welds the points while it reads, and so would lose one that is not a number.
#include "cook/stl_file.h"

#include <bit>
#include <cstring>

#include "rubble/error.h"

namespace rubble::cooking {
namespace {

constexpr std::size_t kHeader = 80;    // [bytes]
constexpr std::size_t kNormal = 12;    // [bytes] of a triangle before its corners
constexpr std::size_t kTriangle = 50;  // [bytes] with normal, corners and attribute

std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t k = 4; k-- > 0;) number = number << 8 | std::uint8_t(bytes[at + k]);  // little-endian
  return number;
}

}  // namespace

std::optional<PolygonSoup> parseBinaryStl(const std::string& bytes) {
  constexpr std::size_t kFirst = kHeader + 4;
  const bool looksLikeText = bytes.starts_with("solid");  // some binary files do
  if (bytes.size() < kFirst) return std::nullopt;
  const std::uint32_t count = numberAt(bytes, kHeader);
  const std::uint64_t size = kFirst + std::uint64_t(count) * kTriangle;
  if (looksLikeText && bytes.size() != size) return std::nullopt;
  if (bytes.size() < size)
    throw Error("is cut off, or no STL: it has " + std::to_string(bytes.size()) + " bytes; its " +
                std::to_string(count) + " triangles take " + std::to_string(size));
  PolygonSoup soup;
  soup.points.reserve(3 * std::size_t(count));
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto first = std::uint32_t(soup.points.size());
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d& point = soup.points.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[int(axis)] = double(std::bit_cast<float>(
            numberAt(bytes, kFirst + t * kTriangle + kNormal + 4 * (3 * corner + axis))));
    }
    soup.polygons.push_back({first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace rubble::cooking
