#include "cook/triangle_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace rubble::cooking {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kDeepest = 64;  // halving 2^32 triangles gives 32 levels

}  // namespace

Eigen::Vector3d closestOnTriangle(const Eigen::Vector3d& place, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double abA = ab.dot(place - a);
  const double acA = ac.dot(place - a);
  if (abA <= 0 && acA <= 0) return a;
  const double abB = ab.dot(place - b);
  const double acB = ac.dot(place - b);
  if (abB >= 0 && acB <= abB) return b;
  const double besideAb = abA * acB - abB * acA;
  if (besideAb <= 0 && abA >= 0 && abB <= 0 && abA > abB) return a + abA / (abA - abB) * ab;
  const double abC = ab.dot(place - c);
  const double acC = ac.dot(place - c);
  if (acC >= 0 && abC <= acC) return c;
  const double besideAc = abC * acA - abA * acC;
  if (besideAc <= 0 && acA >= 0 && acC <= 0 && acA > acC) return a + acA / (acA - acC) * ac;
  const double besideBc = abB * acC - abC * acB;
  const double alongB = acB - abB;
  const double alongC = abC - acC;
  if (besideBc <= 0 && alongB >= 0 && alongC >= 0 && alongB + alongC > 0)
    return b + alongB / (alongB + alongC) * (c - b);
  const double sum = besideAb + besideAc + besideBc;
  if (!(sum > 0)) return a;  // no area and none of the cases above
  return a + besideAc / sum * ab + besideAb / sum * ac;
}

TriangleTree::TriangleTree(const CheckedMesh& mesh) : m_mesh(mesh), m_order(mesh.triangles.size()) {
  std::iota(m_order.begin(), m_order.end(), 0u);
  m_nodes.reserve(2 * m_order.size());
  build(0, std::uint32_t(m_order.size()));
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count) {
  const std::size_t node = m_nodes.size();
  m_nodes.push_back({{}, first, count});
  Eigen::AlignedBox3d centres;
  const auto centre = [this](std::uint32_t t) -> Eigen::Vector3d {
    const auto& [a, b, c] = m_mesh.triangles[t];
    return (m_mesh.vertices[a] + m_mesh.vertices[b] + m_mesh.vertices[c]) / 3;
  };
  for (std::uint32_t k = first; k < first + count; ++k) {
    for (const std::uint32_t v : m_mesh.triangles[m_order[k]]) m_nodes[node].box.extend(m_mesh.vertices[v]);
    centres.extend(centre(m_order[k]));
  }
  if (count <= kLeafSize) return;
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const auto begin = m_order.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t s, std::uint32_t t) {
    const double atS = centre(s)[axis];
    const double atT = centre(t)[axis];
    return atS != atT ? atS < atT : s < t;
  });
  build(first, count / 2);
  m_nodes[node].first = std::uint32_t(m_nodes.size());
  m_nodes[node].count = 0;
  build(first + count / 2, count - count / 2);
}

TriangleTree::Closest TriangleTree::closest(const Eigen::Vector3d& place, std::uint32_t hint) const {
  Closest best{Eigen::Vector3d::Zero(), 0, std::numeric_limits<double>::infinity()};
  const auto consider = [&](std::uint32_t triangle) {
    const auto& [a, b, c] = m_mesh.triangles[triangle];
    const Eigen::Vector3d point =
        closestOnTriangle(place, m_mesh.vertices[a], m_mesh.vertices[b], m_mesh.vertices[c]);
    const double distance = (point - place).squaredNorm();
    if (distance < best.squaredDistance || (distance == best.squaredDistance && triangle < best.triangle))
      best = {point, triangle, distance};
  };
  consider(hint);
  std::array<std::uint32_t, kDeepest> stack{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = m_nodes[index];
    if (node.box.squaredExteriorDistance(place) > best.squaredDistance) continue;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) consider(m_order[k]);
    if (node.count > 0) continue;
    const bool leftIsNearer = m_nodes[index + 1].box.squaredExteriorDistance(place) <=
                              m_nodes[node.first].box.squaredExteriorDistance(place);
    stack[depth++] = leftIsNearer ? node.first : index + 1;
    stack[depth++] = leftIsNearer ? index + 1 : node.first;
  }
  return best;
}

}  // namespace rubble::cooking
