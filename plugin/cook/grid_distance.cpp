#include "cook/grid_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "cook/box_distance.h"

namespace rubble::cooking {
namespace {

constexpr double kSpacing = 0.5;  // [radii] measured: errors of 0.07 to 0.25 r near edges of the surface
constexpr double kReach = 4;      // [spacings] beyond the radius; the last pushes ask 2 fastError() beyond it
constexpr double kFarSlack = 0.5;  // of distances far outside, which only say where to go
constexpr int kAxisBits = 21;      // of a block's number along each axis
constexpr int kKnownBits = 10;     // of the number of blocks that are found without a search: 16 KB
// Distances [of the solid's diagonal] that say on which side a place is; those of places on the surface do
// not.
constexpr double kSurelyBeside = 1e-9;
// Of the grid's edge, which then has 2^21 blocks of 4 nodes or less.
constexpr double kMostNodesAlong = 8e6;

// The top bits of a product that all bits of the key go into [Knuth, 6.4].
std::size_t scatter(std::uint64_t key, int bits) {
  return std::size_t((key * 0x9e3779b97f4a7c15u) >> (64 - bits));
}

}  // namespace

std::unique_ptr<SignedDistance> signedDistance(const CheckedMesh& mesh) {
  if (BoxDistance::isBox(mesh)) return std::make_unique<BoxDistance>(mesh.bounds);
  return std::make_unique<GridDistance>(mesh);
}

GridDistance::GridDistance(const CheckedMesh& mesh)
    : m_mesh(mesh), m_tree(mesh), m_known(std::size_t{1} << kKnownBits) {}

void GridDistance::fitTo(double radius) {
  assert(radius > 0);
  const double size = m_mesh.bounds.sizes().maxCoeff();
  // No wider than a tenth of the solid: few large elements still need to feel its shape.
  const double wanted = std::max(std::min(kSpacing * radius, size / 10), size / kMostNodesAlong);
  const auto reach = double(float(radius + kReach * wanted));  // as a node can hold it
  if (wanted == m_spacing && reach == m_reach) return;         // the nodes are good
  m_spacing = wanted;
  m_reach = reach;
  m_origin = m_mesh.bounds.min() - Eigen::Vector3d::Constant(m_reach + m_spacing);
  m_blocks.clear();
  std::fill(m_known.begin(), m_known.end(), Known{});
}

GridDistance::Block& GridDistance::block(std::uint64_t key) const {
  Known& known = m_known[scatter(key, kKnownBits)];
  if (known.block == nullptr || known.key != key) {
    const auto [entry, isNew] = m_blocks.try_emplace(key);
    if (isNew) entry->second.fill(std::numeric_limits<float>::quiet_NaN());
    known = {key, &entry->second};
  }
  return *known.block;
}

double GridDistance::nodeValue(const std::array<std::int32_t, 3>& node) const {
  std::uint64_t key = 0;
  std::size_t inBlock = 0;
  for (const std::int32_t n : node) {
    key = (key << kAxisBits) | std::uint64_t(n >> kBlockBits);
    inBlock = (inBlock << kBlockBits) | std::size_t(n & (kBlockEdge - 1));
  }
  Block& nodes = block(key);
  if (std::isnan(nodes[inBlock])) nodes[inBlock] = measure(node, nodes, inBlock);
  return double(nodes[inBlock]);
}

float GridDistance::measure(const std::array<std::int32_t, 3>& node, const Block& nodes,
                            std::size_t inBlock) const {
  ++m_nodesMeasured;
  const Eigen::Vector3d place = m_origin + m_spacing * Eigen::Vector3d(node[0], node[1], node[2]);
  const double distance = std::sqrt(m_tree.closest(place, m_reach).squaredDistance);
  // No surface lies between a node and its neighbour where either is farther from it than from the other.
  constexpr double kSurely = 1 + 1e-5;  // floats
  for (std::size_t step = 1; step < nodes.size(); step <<= kBlockBits) {
    const std::size_t along = inBlock / step % kBlockEdge;
    for (const bool isBehind : {false, true}) {
      if (along == (isBehind ? 0 : kBlockEdge - 1)) continue;
      const float neighbour = nodes[isBehind ? inBlock - step : inBlock + step];
      if (std::max(distance, std::abs(double(neighbour))) > kSurely * m_spacing && !std::isnan(neighbour))
        return float(std::copysign(distance, double(neighbour)));
    }
  }
  return float(holds(place, distance) ? -distance : distance);
}

Distance GridDistance::farOutside(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d away =
      p - m_tree.closest(p, std::numeric_limits<double>::infinity(), kFarSlack).point;
  const double distance = away.norm();
  return {distance, distance > 0 ? Eigen::Vector3d(away / distance) : Eigen::Vector3d::UnitZ()};
}

Distance GridDistance::fast(const Eigen::Vector3d& p) const {
  assert(m_spacing > 0);
  if (m_mesh.bounds.squaredExteriorDistance(p) >= m_reach * m_reach) return farOutside(p);
  const Eigen::Vector3d scaled = (p - m_origin) / m_spacing;
  std::array<std::int32_t, 3> cell{};
  std::array<double, 3> share{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell[axis] = std::int32_t(scaled[Eigen::Index(axis)]);
    share[axis] = scaled[Eigen::Index(axis)] - cell[axis];
  }
  Distance result{0, Eigen::Vector3d::Zero()};
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> bit = {corner & 1, (corner >> 1) & 1, (corner >> 2) & 1};
    const double value = nodeValue({cell[0] + bit[0], cell[1] + bit[1], cell[2] + bit[2]});
    if (value >= m_reach) return farOutside(p);
    std::array<double, 3> weight{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      weight[axis] = bit[axis] != 0 ? share[axis] : 1 - share[axis];
    result.value += weight[0] * weight[1] * weight[2] * value;
    result.gradient.x() += (bit[0] != 0 ? value : -value) * weight[1] * weight[2];
    result.gradient.y() += (bit[1] != 0 ? value : -value) * weight[0] * weight[2];
    result.gradient.z() += (bit[2] != 0 ? value : -value) * weight[0] * weight[1];
  }
  const double slope = result.gradient.norm();
  result.gradient = slope > 0 ? Eigen::Vector3d(result.gradient / slope) : Eigen::Vector3d::UnitZ();
  return result;
}

// Whether a place so far from the surface is inside: on the same side as the place asked for last, if a ball
// about one of them that holds no surface holds both.
bool GridDistance::holds(const Eigen::Vector3d& place, double distance) const {
  const double apart = (place - m_lastPlace).norm();
  const bool isSameSide =
      m_lastValue != 0 && (1 + kSurelyBeside) * apart < std::max(distance, std::abs(m_lastValue));
  const bool isInside = isSameSide ? m_lastValue < 0 : m_tree.holds(place);
  m_lastPlace = place;
  m_lastValue = distance < kSurelyBeside * m_mesh.diagonal() ? 0 : isInside ? -distance : distance;
  return isInside;
}

Distance GridDistance::exact(const Eigen::Vector3d& p) const {
  const TriangleTree::Closest closest = m_tree.closest(p);
  const double distance = std::sqrt(closest.squaredDistance);
  if (distance == 0) return {0, m_mesh.normals[closest.triangle]};
  const Eigen::Vector3d away = (p - closest.point) / distance;
  return holds(p, distance) ? Distance{-distance, -away} : Distance{distance, away};
}

}  // namespace rubble::cooking
