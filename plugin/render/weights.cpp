#include "render/weights.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

namespace rubble::render {
namespace {

constexpr std::uint32_t kNoPair = 0xffffffffu;
// The six pairs among four places, in the order of the bits of a joint set.
constexpr std::array<std::array<unsigned, 2>, 6> kPlaces{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr unsigned kJointSets = 64;

constexpr std::array<unsigned, 4> directNeighbours(unsigned joints) {
  std::array<unsigned, 4> follows{1, 2, 4, 8};
  for (unsigned p = 0; p < kPlaces.size(); ++p) {
    if ((joints >> p & 1u) == 0) continue;
    follows[kPlaces[p][0]] |= 1u << kPlaces[p][1];
    follows[kPlaces[p][1]] |= 1u << kPlaces[p][0];
  }
  return follows;
}

constexpr std::array<CellMask, kJointSets> makeTable(bool transitive) {
  std::array<CellMask, kJointSets> table{};
  for (unsigned joints = 0; joints < kJointSets; ++joints) {
    auto follows = directNeighbours(joints);
    // A chain among four elements has at most three links: two rounds of doubling reach its end.
    for (int round = 0; transitive && round < 2; ++round) {
      const auto before = follows;
      for (unsigned i = 0; i < 4; ++i) {
        for (unsigned j = 0; j < 4; ++j) {
          if (before[i] >> j & 1u) follows[i] |= before[j];
        }
      }
    }
    for (unsigned i = 0; i < 4; ++i) table[joints] = CellMask(table[joints] | follows[i] << (4 * i));
  }
  return table;
}

constexpr auto kTransitive = makeTable(true);
constexpr auto kDirect = makeTable(false);

using Pair = std::array<std::uint32_t, 2>;

Pair ordered(std::uint32_t a, std::uint32_t b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

// Index of a pair in a sorted list, or kNoPair.
std::uint32_t find(std::span<const Pair> sorted, const Pair& pair) {
  const auto it = std::lower_bound(sorted.begin(), sorted.end(), pair);
  return it != sorted.end() && *it == pair ? std::uint32_t(it - sorted.begin()) : kNoPair;
}

// Rows from (row, item) entries; rows keep ascending items, twins are dropped.
Rows makeRows(std::size_t rows, std::vector<Pair>& entries) {
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  Rows result;
  result.first.assign(rows + 1, 0);
  result.items.reserve(entries.size());
  for (const Pair& entry : entries) {
    ++result.first[entry[0] + 1];
    result.items.push_back(entry[1]);
  }
  for (std::size_t r = 0; r < rows; ++r) result.first[r + 1] += result.first[r];
  return result;
}

}  // namespace

CellWeights::CellWeights(const Asset& asset, CellJoining joining) : m_joining(joining) {
  m_springs.reserve(asset.springs.size());
  for (const AssetSpring& spring : asset.springs) m_springs.push_back(ordered(spring.first, spring.second));
  findPairs(asset);
  m_joined.assign(m_pairVertices.first.size() - 1, 1);
  for (std::uint32_t b = 0; b + 1 < m_bridges.first.size(); ++b) {
    m_joined[m_springs.size() + b] = bridged(b) ? 1 : 0;
  }
  m_masks.resize(asset.vertices.size());
  m_isMarked.assign(asset.vertices.size(), 0);
  m_marked.reserve(asset.vertices.size());
  m_changed.reserve(asset.vertices.size());
  for (std::uint32_t v = 0; v < m_masks.size(); ++v) m_masks[v] = maskAt(v);
}

void CellWeights::findPairs(const Asset& asset) {
  std::vector<Pair> without;  // pairs at a vertex that have no spring
  for (const CellVertex& vertex : asset.vertices) {
    for (const auto& [a, b] : kPlaces) {
      if (vertex.elements[a] == kNoElement || vertex.elements[b] == kNoElement) continue;
      const Pair pair = ordered(vertex.elements[a], vertex.elements[b]);
      if (find(m_springs, pair) == kNoPair) without.push_back(pair);
    }
  }
  std::sort(without.begin(), without.end());
  without.erase(std::unique(without.begin(), without.end()), without.end());
  if (m_joining == CellJoining::Direct) without.clear();

  const auto springs = std::uint32_t(m_springs.size());
  std::vector<Pair> pairVertex;
  m_vertexPairs.resize(asset.vertices.size());
  for (std::uint32_t v = 0; v < asset.vertices.size(); ++v) {
    const auto& elements = asset.vertices[v].elements;
    for (unsigned p = 0; p < kPlaces.size(); ++p) {
      std::uint32_t& id = m_vertexPairs[v][p];
      id = kNoPair;
      const std::uint32_t a = elements[kPlaces[p][0]], b = elements[kPlaces[p][1]];
      if (a == kNoElement || b == kNoElement) continue;
      id = find(m_springs, ordered(a, b));
      if (id == kNoPair) {
        const std::uint32_t bridge = find(without, ordered(a, b));
        if (bridge != kNoPair) id = springs + bridge;
      }
      if (id != kNoPair) pairVertex.push_back({id, v});
    }
  }
  m_pairVertices = makeRows(m_springs.size() + without.size(), pairVertex);
  findBridges(asset, without);
}

void CellWeights::findBridges(const Asset& asset, std::span<const Pair> pairs) {
  std::vector<Pair> bridgedElement;  // (bridged pair, third element)
  for (std::uint32_t b = 0; b < pairs.size(); ++b) {
    for (const std::uint32_t v : m_pairVertices.row(m_springs.size() + b)) {
      for (const std::uint32_t third : asset.vertices[v].elements) {
        if (third == kNoElement || third == pairs[b][0] || third == pairs[b][1]) continue;
        bridgedElement.push_back({b, third});
      }
    }
  }
  const Rows thirds = makeRows(pairs.size(), bridgedElement);
  m_bridges.first.assign(1, 0);
  for (std::uint32_t b = 0; b < pairs.size(); ++b) {
    for (const std::uint32_t third : thirds.row(b)) {
      const std::uint32_t s = find(m_springs, ordered(pairs[b][0], third));
      const std::uint32_t t = find(m_springs, ordered(pairs[b][1], third));
      if (s == kNoPair || t == kNoPair) continue;
      m_bridges.items.insert(m_bridges.items.end(), {s, t});
    }
    m_bridges.first.push_back(std::uint32_t(m_bridges.items.size()));
  }
}

bool CellWeights::bridged(std::uint32_t bridgedPair) const {
  const auto springs = m_bridges.row(bridgedPair);
  for (std::size_t i = 0; i < springs.size(); i += 2) {
    if (m_joined[springs[i]] && m_joined[springs[i + 1]]) return true;
  }
  return false;
}

CellMask CellWeights::maskAt(std::uint32_t vertex) const {
  unsigned joints = 0;
  for (unsigned p = 0; p < kPlaces.size(); ++p) {
    const std::uint32_t pair = m_vertexPairs[vertex][p];
    if (pair != kNoPair && m_joined[pair]) joints |= 1u << p;
  }
  return m_joining == CellJoining::Transitive ? kTransitive[joints] : kDirect[joints];
}

void CellWeights::setPair(std::uint32_t pair, bool joined) {
  m_joined[pair] = joined ? 1 : 0;
  for (const std::uint32_t v : m_pairVertices.row(pair)) {
    if (m_isMarked[v]) continue;
    m_isMarked[v] = 1;
    m_marked.push_back(v);
  }
}

bool CellWeights::update(std::span<const std::uint8_t> springsIntact, std::span<const ElementPose> poses) {
  assert(springsIntact.size() >= m_springs.size());
  m_marked.clear();
  m_changed.clear();
  const auto isJoined = [&](std::uint32_t s) {
    const auto& [a, b] = m_springs[s];
    return springsIntact[s] != 0 && poses[a].alive > 0 && poses[b].alive > 0;
  };
  // Springs first, all of them: a bridged pair looks at two.
  const auto springs = std::uint32_t(m_springs.size());
  bool any = false;
  for (std::uint32_t s = 0; s < springs; ++s) {
    if (isJoined(s) == (m_joined[s] != 0)) continue;
    setPair(s, isJoined(s));
    any = true;
  }
  if (!any) return false;
  for (std::uint32_t b = 0; b + 1 < m_bridges.first.size(); ++b) {
    if (bridged(b) != (m_joined[springs + b] != 0)) setPair(springs + b, bridged(b));
  }
  std::sort(m_marked.begin(), m_marked.end());
  for (const std::uint32_t v : m_marked) {
    m_isMarked[v] = 0;
    const CellMask mask = maskAt(v);
    if (mask == m_masks[v]) continue;
    m_masks[v] = mask;
    m_changed.push_back(v);
  }
  return !m_changed.empty();
}

Eigen::Vector3f cellPoint(const Asset& asset, std::span<const ElementPose> poses, CellMask mask,
                          std::uint32_t vertex, unsigned owner) {
  assert(vertex < asset.vertices.size() && owner < 4 && poses.size() >= asset.elementCount());
  const CellVertex& cellVertex = asset.vertices[vertex];
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0;
  for (unsigned j = 0; j < 4; ++j) {
    if ((maskOf(mask, owner) >> j & 1u) == 0) continue;
    const std::uint32_t element = cellVertex.elements[j];
    const Eigen::Vector3f arm = cellVertex.position - asset.positions[element].cast<float>();
    sum += poses[element].position + Eigen::Quaternionf(poses[element].rotation) * arm;
    weights += 1;
  }
  return sum / weights;
}

}  // namespace rubble::render
