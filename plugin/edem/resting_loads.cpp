#include "edem/resting_loads.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rubble::edem {
namespace {

// Gauss-Seidel sweeps a substep. They go on where the last substep's ended.
constexpr int kSweeps = 2;

}  // namespace

std::size_t RestingLoads::Hash::operator()(const Name& name) const {
  return std::size_t((name.first * 0x9e3779b97f4a7c15u ^ name.second) * 0xff51afd7ed558ccdu >> 7);
}

void RestingLoads::beginTick(const Eigen::Vector3d& gravity) {
  m_gravity = gravity;
  const std::vector<Pair> pairs = std::exchange(m_pairs, {});
  const std::vector<Node> nodes = std::exchange(m_nodes, {});
  m_pairOf.clear();
  m_nodeOf.clear();
  for (const Pair& p : pairs) {
    if (!(p.load > 0)) continue;
    Pair& kept = m_pairs[pairOf(nodes[p.first].thing, nodes[p.second].thing)];
    kept.normal = p.normal;
    kept.load = p.load;
    kept.share = p.share;
  }
}

void RestingLoads::rename(std::uint64_t from, std::uint64_t to) {
  for (Node& n : m_nodes)
    if (n.thing.name == from) n.thing.name = to;
  for (Pair& p : m_pairs) {
    const std::uint64_t first = m_nodes[p.first].thing.name, second = m_nodes[p.second].thing.name;
    const bool areFragments = std::max(first, second) < rigidName(0);
    if ((first != to && second != to) || !areFragments || first < second) continue;
    std::swap(p.first, p.second);
    p.normal = -p.normal;
  }
  m_nodeOf.clear();
  for (std::size_t n = 0; n < m_nodes.size(); ++n) m_nodeOf[m_nodes[n].thing.name] = n;
  m_pairOf.clear();
  for (std::size_t p = 0; p < m_pairs.size(); ++p)
    m_pairOf[{m_nodes[m_pairs[p].first].thing.name, m_nodes[m_pairs[p].second].thing.name}] = p;
}

std::size_t RestingLoads::nodeOf(const LoadedThing& thing) {
  const auto [at, added] = m_nodeOf.try_emplace(thing.name, m_nodes.size());
  if (added) m_nodes.emplace_back();
  return at->second;
}

std::size_t RestingLoads::pairOf(const LoadedThing& first, const LoadedThing& second) {
  assert(first.name != second.name && first.inverseMass >= 0 && second.inverseMass >= 0);
  const auto [at, added] = m_pairOf.try_emplace({first.name, second.name}, m_pairs.size());
  if (added) {
    m_pairs.emplace_back();
    m_pairs.back().first = nodeOf(first);
    m_pairs.back().second = nodeOf(second);
  }
  const Pair& pair = m_pairs[at->second];
  m_nodes[pair.first].thing = first;
  m_nodes[pair.second].thing = second;
  return at->second;
}

void RestingLoads::settle() {
  for (Node& n : m_nodes)
    n.acceleration = n.thing.inverseMass > 0 ? n.thing.external : Eigen::Vector3d::Zero();
  for (Pair& p : m_pairs) {
    const double size = p.pushed.norm();
    if (size > 0)
      p.normal = p.pushed / size;
    else
      p.load = 0;
    accelerate(p, p.load);
  }
  for (int i = 0; i < kSweeps; ++i) sweep();
  for (Pair& p : m_pairs) {
    const double size = p.pushed.norm();
    p.share = size > p.load ? p.load / size : double(size > 0);
    p.pushed.setZero();
  }
}

// Each load comes to where it just keeps its two things from closing in on each other. None pulls.
void RestingLoads::sweep() {
  for (Pair& p : m_pairs) {
    const Node &first = m_nodes[p.first], &second = m_nodes[p.second];
    const double mobility = first.thing.inverseMass + second.thing.inverseMass;
    if (!(mobility > 0) || p.pushed.isZero(0)) continue;
    const double closing = (first.acceleration - second.acceleration).dot(p.normal);
    const double change = std::max(-p.load, closing / mobility);
    p.load += change;
    accelerate(p, change);
  }
}

void RestingLoads::accelerate(const Pair& p, double load) {
  m_nodes[p.first].acceleration -= load * m_nodes[p.first].thing.inverseMass * p.normal;
  m_nodes[p.second].acceleration += load * m_nodes[p.second].thing.inverseMass * p.normal;
}

}  // namespace rubble::edem
