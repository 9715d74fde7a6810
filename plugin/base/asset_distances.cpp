// Elements in one place would push one another along no direction, and heaps of them make the search for
// contacts quadratic. A hashed grid finds them: its cells are two least distances wide, so what is too near
// to a place lies in the eight cells about it, and no cell can fill up before a pair in it is refused.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/asset_check.h"

namespace rubble::base {
namespace {

constexpr double kLeastDistance = 0.5;  // [r]; elements that the cook makes are at least 1.6 r apart

class PlaceGrid {
 public:
  explicit PlaceGrid(const Asset& asset)
      : m_asset(asset),
        m_least(kLeastDistance * asset.radius),
        m_heads(std::bit_ceil(2 * asset.elementCount()), kNoElement),
        m_next(asset.elementCount(), kNoElement) {
    for (const Eigen::Vector3d& place : asset.positions) m_low = m_low.cwiseMin(place);
  }

  // Throws if an element put before is too near.
  void put(std::uint32_t i) {
    // In units of half a cell: the nearer neighbour along an axis is on the side of the half that holds the
    // place.
    const Eigen::Vector3d halves = (m_asset.positions[i] - m_low) / m_least;
    std::array<std::int64_t, 3> cell{}, beside{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto half = std::int64_t(std::floor(halves[Eigen::Index(axis)]));
      cell[axis] = half >> 1;
      beside[axis] = half & 1 ? 1 : -1;
    }
    for (std::int64_t corner = 0; corner < 8; ++corner)
      compare(i, bucket(cell[0] + (corner & 1) * beside[0], cell[1] + (corner >> 1 & 1) * beside[1],
                        cell[2] + (corner >> 2) * beside[2]));
    const std::size_t own = bucket(cell[0], cell[1], cell[2]);
    m_next[i] = m_heads[own];
    m_heads[own] = i;
  }

 private:
  // Mixes as splitmix64 does [Steele14].
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
    std::uint64_t h = 0;
    for (const std::int64_t c : {x, y, z}) {
      h = (h ^ std::uint64_t(c)) + 0x9e3779b97f4a7c15u;
      h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
      h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
      h ^= h >> 31;
    }
    return std::size_t(h) & (m_heads.size() - 1);
  }

  void compare(std::uint32_t i, std::size_t bucket) const {
    for (std::uint32_t k = m_heads[bucket]; k != kNoElement; k = m_next[k]) {
      const double distance = (m_asset.positions[i] - m_asset.positions[k]).norm();
      if (!(distance >= m_least))
        refuseAsset("positions[", i, "] is ", distance, " m from positions[", k, "]; allowed: at least ",
                    m_least, ", half the radius");
    }
  }

  const Asset& m_asset;
  const double m_least;
  Eigen::Vector3d m_low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> m_heads, m_next;
};

}  // namespace

void checkDistances(const Asset& asset) {
  PlaceGrid grid(asset);
  for (std::uint32_t i = 0; i < asset.elementCount(); ++i) grid.put(i);
}

}  // namespace rubble::base
