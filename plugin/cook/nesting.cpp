#include "cook/nesting.h"

#include <cmath>
#include <map>
#include <utility>

#include "cook/shell_tree.h"

namespace rubble::cooking {
namespace {

// Shells that turn together, the largest first.
struct Nest {
  std::vector<std::uint32_t> shells;
  double volume = 0;  // [m^3]
};

std::vector<Nest> findNests(const Shells& shells, const std::vector<std::uint32_t>& heaps) {
  std::vector<Nest> nests;
  std::map<std::uint32_t, std::size_t> known;
  for (std::uint32_t s = 0; s < shells.list.size(); ++s) {
    const Shell& shell = shells.list[s];
    const std::uint32_t heap = heaps[shell.triangles[0]];
    const auto [at, isNew] = known.try_emplace(heap, nests.size());
    if (isNew || heap == kNoElement) {
      at->second = nests.size();
      nests.emplace_back();
    }
    Nest& nest = nests[at->second];
    nest.shells.push_back(s);
    nest.volume += shell.volume;
    const double largest = shells.list[nest.shells.front()].bounds.diagonal().norm();
    if (shell.bounds.diagonal().norm() > largest) std::swap(nest.shells.front(), nest.shells.back());
  }
  return nests;
}

// By most of some of its corners: where shells touch, one may be beyond the other by a rounding.
bool liesMostlyWithin(const Soup& soup, const Shell& inner, const ShellTree& outer) {
  constexpr std::size_t kMostCorners = 64;
  const std::size_t step = 1 + (inner.triangles.size() - 1) / kMostCorners;
  int within = 0;
  for (std::size_t k = 0; k < inner.triangles.size(); k += step) {
    const ShellSide side = outer.sideOf(soup.vertices[soup.triangles[inner.triangles[k]][0]]);
    within += side == ShellSide::Within ? 1 : side == ShellSide::Outside ? -1 : 0;
  }
  return within > 0;
}

// Without volume it has no sides.
bool isFlat(const Shell& shell) {
  constexpr double kFlat = 1e-12;
  return !(std::abs(shell.volume) > kFlat * std::pow(shell.bounds.diagonal().norm(), 3));
}

}  // namespace

std::optional<WrongShell> findWrongShell(const Soup& soup) {
  const Shells shells = findShells(soup);
  if (shells.list.size() < 2) return std::nullopt;
  ShellTrees trees(soup, shells);
  for (std::uint32_t s = 0; s < shells.list.size(); ++s) {
    const Shell& own = shells.list[s];
    if (isFlat(own)) continue;
    int winding = 0;
    std::uint32_t around = kNoElement;
    for (std::uint32_t o = 0; o < shells.list.size(); ++o) {
      const Shell& other = shells.list[o];
      if (o == s || isFlat(other) || !other.bounds.contains(own.bounds)) continue;
      if (!liesMostlyWithin(soup, own, trees.of(o))) continue;
      winding += other.volume > 0 ? 1 : -1;
      if (around == kNoElement || shells.list[around].bounds.contains(other.bounds)) around = o;
    }
    const bool isInward = own.volume < 0;
    if (winding != (isInward ? 1 : 0))
      return WrongShell{s, around, isInward, soup.vertices[soup.triangles[own.triangles[0]][0]]};
  }
  return std::nullopt;
}

void turnOutwards(Soup& soup, const std::vector<std::uint32_t>& heaps) {
  const Shells shells = findShells(soup);
  ShellTrees trees(soup, shells);
  const std::vector<Nest> nests = findNests(shells, heaps);
  for (std::size_t n = 0; n < nests.size(); ++n) {
    const Shell& own = shells.list[nests[n].shells.front()];
    std::size_t around = 0;
    for (std::size_t other = 0; other < nests.size(); ++other) {
      if (other == n) continue;
      for (const std::uint32_t s : nests[other].shells)
        if (shells.list[s].bounds.contains(own.bounds) && liesWithin(soup, own, trees.of(s))) ++around;
    }
    if ((nests[n].volume > 0) == (around % 2 == 0)) continue;
    for (const std::uint32_t s : nests[n].shells)
      for (const std::uint32_t t : shells.list[s].triangles)
        std::swap(soup.triangles[t][1], soup.triangles[t][2]);
  }
}

}  // namespace rubble::cooking
