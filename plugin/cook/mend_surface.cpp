#include "cook/mend_surface.h"

#include <utility>

#include "cook/crossings.h"
#include "cook/heap_union.h"
#include "cook/heaps.h"
#include "cook/nesting.h"
#include "cook/shells.h"

namespace rubble::cooking {
namespace {

void tell(const Soup& soup, const Crossing& crossing, Mended& mended) {
  if (mended.crossings++ == 0) mended.crossing = soup.vertices[soup.triangles[crossing[0]][0]];
}

void markCrossed(const Soup& soup, const std::vector<Crossing>& crossings, Shells& shells) {
  for (const Crossing& crossing : crossings) {
    Shell& shell = shells.list[shells.of[crossing[0]]];
    if (shells.of[crossing[0]] == shells.of[crossing[1]] && !shell.isCrossed)
      shell.isCrossed = isPierced(soup, crossing);
  }
}

void tellUnion(const Heap& heap, const HeapUnion& made, Mended& mended) {
  for (std::uint32_t s = 0; s < heap.shells.size(); ++s)
    mended.united += made.united.isKept[s] || heap.isCavity[s] ? 0 : 1;
  const Soup& soup = made.united.soup;
  if (made.pierced > 0 && mended.crossings == 0 && !soup.triangles.empty())
    mended.crossing = soup.vertices[soup.triangles[0][0]];
  mended.crossings += made.pierced;
  for (const Shell& shell : findShells(soup).list) mended.remaining += shell.volume > 0 ? 1 : 0;
}

// Shells that cross none are left as they are, and so are those that cross themselves. Returns the heaps of
// triangles.
std::vector<std::uint32_t> uniteParts(Soup& soup, const std::vector<Crossing>& crossings, Mended& mended) {
  Shells shells = findShells(soup);
  markCrossed(soup, crossings, shells);
  Soup fresh;
  std::vector<std::uint32_t> heapOf(soup.triangles.size(), kNoElement), freshHeaps;
  std::vector<bool> isGone(soup.triangles.size(), false), isSettled(shells.list.size(), false);
  std::uint32_t number = 0;
  for (const Heap& heap : findHeaps(soup, shells, crossings)) {
    const HeapUnion made = unionOf(soupOf(heap, soup, shells));
    if (!made.united.refusal.empty()) {
      mended.notUnited.push_back({heap.solids, made.united.refusal});
      continue;
    }
    tellUnion(heap, made, mended);
    for (std::uint32_t s = 0; s < heap.shells.size(); ++s) {
      isSettled[heap.shells[s]] = true;
      for (const std::uint32_t t : shells.list[heap.shells[s]].triangles) {
        heapOf[t] = number;
        isGone[t] = !made.united.isKept[s];
        if (heap.isTurned[s]) std::swap(soup.triangles[t][1], soup.triangles[t][2]);
      }
    }
    appendSoup(made.united.soup, fresh);
    freshHeaps.resize(fresh.triangles.size(), number++);
  }
  for (const Crossing& crossing : crossings) {
    const std::uint32_t a = shells.of[crossing[0]], b = shells.of[crossing[1]];
    if (!(isSettled[a] && isSettled[b]) && isPierced(soup, crossing)) tell(soup, crossing, mended);
  }
  std::vector<std::uint32_t> heaps;
  for (std::size_t t = 0; t < heapOf.size(); ++t)
    if (!isGone[t]) heaps.push_back(heapOf[t]);
  heaps.insert(heaps.end(), freshHeaps.begin(), freshHeaps.end());
  dropTriangles(soup, isGone);
  appendSoup(fresh, soup);
  return heaps;
}

}  // namespace

Mended mendSurface(Soup& soup, const RepairOptions& options) {
  Mended mended;
  if (!isManifold(soup)) return mended;
  mended.holes = fillHoles(soup, options);
  if (!openEdges(soup).empty()) return mended;
  const std::vector<Crossing> crossings = findCrossings(soup);
  std::vector<std::uint32_t> heaps(soup.triangles.size(), kNoElement);
  if (options.unite) {
    heaps = uniteParts(soup, crossings, mended);
  } else {
    for (const Crossing& crossing : crossings)
      if (isPierced(soup, crossing)) tell(soup, crossing, mended);
  }
  if (!isManifold(soup)) return mended;  // left for the check of the mesh to name
  if (mended.crossings == 0) {
    turnOutwards(soup, heaps);
  } else if (volumeOf(soup) < 0) {  // which shell is within which cannot be told
    for (auto& triangle : soup.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mended;
}

}  // namespace rubble::cooking
