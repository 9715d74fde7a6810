#include "cook/nesting.h"

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

}  // namespace

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
