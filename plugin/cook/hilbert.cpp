#include "cook/hilbert.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

namespace rubble::cooking {
namespace {

constexpr unsigned kBits = 20;  // a coordinate

// Position along the curve, by Skilling's transform ["Programming the Hilbert curve", 2004].
std::uint64_t hilbertIndex(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& axis : x) {
      if ((axis & q) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t swap = (x[0] ^ axis) & below;
        x[0] ^= swap;
        axis ^= swap;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t gray = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    if ((x[2] & q) != 0) gray ^= q - 1;
  std::uint64_t index = 0;
  for (unsigned bit = kBits; bit-- > 0;)
    for (const std::uint32_t axis : x) index = (index << 1) | (((axis ^ gray) >> bit) & 1u);
  return index;
}

}  // namespace

std::vector<std::uint32_t> hilbertOrder(const std::vector<Eigen::Vector3d>& places) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& place : places) box.extend(place);
  const double size = places.empty() ? 0 : box.sizes().maxCoeff();
  const double scale = size > 0 ? ((1u << kBits) - 1) / size : 0;
  std::vector<std::uint64_t> keys;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d scaled = (place - box.min()) * scale;
    keys.push_back(
        hilbertIndex({std::uint32_t(scaled.x()), std::uint32_t(scaled.y()), std::uint32_t(scaled.z())}));
  }
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&keys](std::uint32_t a, std::uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  return order;
}

}  // namespace rubble::cooking
