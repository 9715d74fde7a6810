#include "cook/heaps.h"

#include <algorithm>
#include <set>

#include "base/groups.h"
#include "cook/shell_tree.h"

namespace rubble::cooking {
namespace {

// What was meant to touch may be this far apart [share of the largest coordinate]: thousands of roundings.
constexpr double kNear = 0x1p-40;

using ShellPairs = std::set<std::array<std::uint32_t, 2>>;  // the smaller first

double largestOf(const Eigen::AlignedBox3d& bounds) {
  return std::max(bounds.max().cwiseAbs().maxCoeff(), bounds.min().cwiseAbs().maxCoeff());
}

bool hasCornerNear(const Soup& soup, const Shell& corners, const Eigen::AlignedBox3d& within,
                   const ShellTree& tree, double reach) {
  for (const std::uint32_t t : corners.triangles)
    for (const std::uint32_t v : soup.triangles[t])
      if (within.contains(soup.vertices[v]) && tree.isNear(soup.vertices[v], reach)) return true;
  return false;
}

// Shells by their least x, each with those that begin before it ends.
template <class Visit>
void forEachCloseBoxes(const Shells& shells, Visit&& visit) {
  std::vector<std::uint32_t> order(shells.list.size());
  for (std::uint32_t s = 0; s < order.size(); ++s) order[s] = s;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return shells.list[a].bounds.min().x() < shells.list[b].bounds.min().x();
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Eigen::AlignedBox3d& one = shells.list[order[i]].bounds;
    const double slack = kNear * largestOf(one);
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Eigen::AlignedBox3d& other = shells.list[order[j]].bounds;
      if (other.min().x() > one.max().x() + slack) break;
      if ((other.min().array() <= one.max().array() + slack).all() &&
          (one.min().array() <= other.max().array() + slack).all())
        visit(std::min(order[i], order[j]), std::max(order[i], order[j]));
    }
  }
}

void addNear(const Soup& soup, const Shells& shells, ShellTrees& trees, ShellPairs& crossed) {
  forEachCloseBoxes(shells, [&](std::uint32_t a, std::uint32_t b) {
    const Shell &one = shells.list[a], &other = shells.list[b];
    if (one.isCrossed || other.isCrossed || crossed.contains({a, b})) return;
    const double reach = kNear * std::max(largestOf(one.bounds), largestOf(other.bounds));
    Eigen::AlignedBox3d both = one.bounds.intersection(other.bounds);
    both.min().array() -= 2 * reach;
    both.max().array() += 2 * reach;
    if (hasCornerNear(soup, one, both, trees.of(b), reach) ||
        hasCornerNear(soup, other, both, trees.of(a), reach))
      crossed.insert({a, b});
  });
}

// Shells turned inwards that lie inside of one turned outwards which they do not cross are its cavities, also
// where something else crosses both. Shells that stand alone have no host.
std::vector<std::uint32_t> findHosts(const Soup& soup, const Shells& shells, const ShellPairs& crossed,
                                     const std::vector<bool>& isWanted, ShellTrees& trees) {
  std::vector<std::uint32_t> hosts(shells.list.size(), kNoElement);
  for (std::uint32_t inner = 0; inner < hosts.size(); ++inner) {
    const Shell& own = shells.list[inner];
    if (!isWanted[inner] || own.volume >= 0) continue;
    for (std::uint32_t outer = 0; outer < hosts.size(); ++outer) {
      const Shell& host = shells.list[outer];
      if (!isWanted[outer] || host.volume <= 0 || !host.bounds.contains(own.bounds)) continue;
      if (hosts[inner] != kNoElement && host.volume >= shells.list[hosts[inner]].volume) continue;
      if (crossed.contains({std::min(inner, outer), std::max(inner, outer)})) continue;
      if (liesWithin(soup, own, trees.of(outer))) hosts[inner] = outer;
    }
  }
  return hosts;
}

std::vector<Heap> gather(const Shells& shells, const std::vector<std::uint32_t>& hosts,
                         const ShellPairs& crossed, const std::vector<bool>& isWanted) {
  base::Groups groups(hosts.size());
  for (const auto& [a, b] : crossed)
    if (isWanted[a] && isWanted[b]) groups.join(a, b);
  for (std::uint32_t s = 0; s < hosts.size(); ++s)
    if (hosts[s] != kNoElement) groups.join(s, hosts[s]);
  std::vector<Heap> heaps(hosts.size());
  for (std::uint32_t s = 0; s < hosts.size(); ++s) {
    if (!isWanted[s]) continue;
    Heap& heap = heaps[groups.of(s)];
    heap.shells.push_back(s);
    heap.isCavity.push_back(hosts[s] != kNoElement);
    heap.isTurned.push_back(hosts[s] == kNoElement && shells.list[s].volume < 0);
    heap.solids += hosts[s] == kNoElement ? 1 : 0;
  }
  std::erase_if(heaps, [](const Heap& heap) { return heap.solids < 2; });
  return heaps;
}

}  // namespace

std::vector<Heap> findHeaps(const Soup& soup, const Shells& shells, const std::vector<Crossing>& crossings) {
  if (shells.list.size() < 2) return {};
  ShellPairs crossed;
  for (const auto& [s, t] : crossings) {
    const std::uint32_t a = shells.of[s], b = shells.of[t];
    if (a != b) crossed.insert({std::min(a, b), std::max(a, b)});
  }
  ShellTrees trees(soup, shells);
  addNear(soup, shells, trees, crossed);
  if (crossed.empty()) return {};
  std::vector<bool> isWanted(shells.list.size(), false);
  for (const auto& [a, b] : crossed)
    for (const std::uint32_t shell : {a, b}) isWanted[shell] = !shells.list[shell].isCrossed;
  for (std::uint32_t s = 0; s < isWanted.size(); ++s)  // cavities of parts that cross others
    isWanted[s] = isWanted[s] || (shells.list[s].volume < 0 && !shells.list[s].isCrossed);
  return gather(shells, findHosts(soup, shells, crossed, isWanted, trees), crossed, isWanted);
}

HeapSoup soupOf(const Heap& heap, const Soup& soup, const Shells& shells) {
  HeapSoup own;
  std::vector<std::uint32_t> vertices(soup.vertices.size(), kNoElement);
  for (std::uint32_t s = 0; s < heap.shells.size(); ++s)
    for (const std::uint32_t t : shells.list[heap.shells[s]].triangles) {
      auto corners = soup.triangles[t];
      for (std::uint32_t& v : corners) {
        if (vertices[v] == kNoElement) {
          vertices[v] = std::uint32_t(own.soup.vertices.size());
          own.soup.vertices.push_back(soup.vertices[v]);
        }
        v = vertices[v];
      }
      if (heap.isTurned[s]) std::swap(corners[1], corners[2]);
      own.soup.triangles.push_back(corners);
      own.soup.sources.push_back(soup.sources[t]);
      own.shells.push_back(s);
    }
  return own;
}

}  // namespace rubble::cooking
