#include "bench/crack_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace rubble::test {
namespace {

// Greatest flow between two nodes of an undirected graph, which is the least cut [Dinic].
class Flow {
 public:
  explicit Flow(std::size_t nodes) : m_links(nodes), m_level(nodes), m_next(nodes) {}

  void tie(std::uint32_t a, std::uint32_t b, double capacity) {
    m_links[a].push_back(std::uint32_t(m_ends.size()));
    m_ends.push_back({b, capacity});
    m_links[b].push_back(std::uint32_t(m_ends.size()));
    m_ends.push_back({a, capacity});
  }
  double between(std::uint32_t source, std::uint32_t sink) {
    double sum = 0;
    while (findLevels(source, sink)) {
      std::fill(m_next.begin(), m_next.end(), 0);
      while (const double pushed = push(source, sink, HUGE_VAL)) sum += pushed;
    }
    return sum;
  }

 private:
  static constexpr double kNone = 1e-15;  // [m^2]; what is left of a full spring by rounding
  struct End {
    std::uint32_t node;
    double capacity;
  };

  bool findLevels(std::uint32_t source, std::uint32_t sink) {
    std::fill(m_level.begin(), m_level.end(), -1);
    m_level[source] = 0;
    std::vector<std::uint32_t> queue = {source};
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const std::uint32_t link : m_links[queue[i]]) {
        const End& end = m_ends[link];
        if (end.capacity <= kNone || m_level[end.node] >= 0) continue;
        m_level[end.node] = m_level[queue[i]] + 1;
        queue.push_back(end.node);
      }
    return m_level[sink] >= 0;
  }
  double push(std::uint32_t node, std::uint32_t sink, double most) {
    if (node == sink) return most;
    for (std::size_t& i = m_next[node]; i < m_links[node].size(); ++i) {
      const std::uint32_t link = m_links[node][i];
      if (m_ends[link].capacity <= kNone || m_level[m_ends[link].node] != m_level[node] + 1) continue;
      const double pushed = push(m_ends[link].node, sink, std::min(most, m_ends[link].capacity));
      if (pushed <= 0) continue;
      m_ends[link].capacity -= pushed;
      m_ends[link ^ 1].capacity += pushed;
      return pushed;
    }
    return 0;
  }

  std::vector<End> m_ends;                          // those of a tie stand side by side
  std::vector<std::vector<std::uint32_t>> m_links;  // of a node
  std::vector<int> m_level;
  std::vector<std::size_t> m_next;
};

// Of the plane direction . x = offset with the solid [m^2]: twice the area is the sum of p x q over the sides
// p, q of the section, each inside one triangle.
double sectionArea(const cooking::CheckedMesh& solid, const Eigen::Vector3d& direction, double offset) {
  double sum = 0;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    std::vector<Eigen::Vector3d> ends;
    for (std::size_t side = 0; side < 3; ++side) {
      const Eigen::Vector3d& a = solid.vertices[solid.triangles[t][side]];
      const Eigen::Vector3d& b = solid.vertices[solid.triangles[t][(side + 1) % 3]];
      const double before = direction.dot(a) - offset, behind = direction.dot(b) - offset;
      if ((before < 0) != (behind < 0)) ends.emplace_back(a + before / (before - behind) * (b - a));
    }
    if (ends.size() != 2) continue;
    const double area = direction.dot(ends[0].cross(ends[1]));
    const bool isAlong =
        direction.cross(solid.normals[t]).dot(ends[1] - ends[0]) > 0;  // outside on the right
    sum += isAlong ? area : -area;
  }
  return sum / 2;
}

}  // namespace

double crackRoughness(const Asset& asset, const cooking::CheckedMesh& solid, const Eigen::Vector3d& direction,
                      double band) {
  const double middle = direction.dot(solid.bounds.center());
  const auto n = std::uint32_t(asset.elementCount());
  const auto nodeOf = [&](std::uint32_t element) {  // one for all on either side of the band
    const double at = direction.dot(asset.positions[element]) - middle;
    return at < -band ? n : at > band ? n + 1 : element;
  };
  Flow flow(n + 2);
  for (const AssetSpring& spring : asset.springs)
    if (const auto a = nodeOf(spring.first), b = nodeOf(spring.second); a != b) flow.tie(a, b, spring.area);
  double flat = HUGE_VAL;
  constexpr int kSections = 10;  // to either side of the middle
  for (int k = -kSections; k <= kSections; ++k)
    flat = std::min(flat, sectionArea(solid, direction, middle + (k + 0.01) * band / (kSections + 1)));
  return flow.between(n, n + 1) / flat;
}

double shareOfOneDirection(const Asset& asset) {
  constexpr int kDirections = 2000;  // three degrees apart
  const double close = std::cos(10 * std::numbers::pi / 180);
  std::vector<std::pair<Eigen::Vector3d, double>> faces;
  double all = 0;
  for (const AssetSpring& spring : asset.springs) {
    const Eigen::Vector3d along = asset.positions[spring.second] - asset.positions[spring.first];
    faces.emplace_back(along.normalized(), spring.area);
    all += spring.area;
  }
  double most = 0;
  const auto look = [&](const Eigen::Vector3d& direction) {
    double sum = 0;
    for (const auto& [normal, area] : faces)
      if (std::abs(normal.dot(direction)) > close) sum += area;
    most = std::max(most, sum);
  };
  for (int k = 0; k < kDirections; ++k) {  // a spiral over half of the sphere
    const double z = (k + 0.5) / kDirections, turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    look({r * std::cos(turn), r * std::sin(turn), z});
  }
  for (int axis = 0; axis < 3; ++axis) look(Eigen::Vector3d::Unit(axis));
  return most / all;
}

}  // namespace rubble::test
