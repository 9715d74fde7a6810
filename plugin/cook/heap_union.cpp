#include "cook/heap_union.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "cook/heap_frame.h"

namespace rubble::cooking {
namespace {

// How fine a grid is that corners move to, where the union as it is passes through itself once it is rounded:
// what lay on each other but for a rounding then does, or is farther apart than roundings are [share of its
// size].
constexpr std::array kGrids = {0.0, 0x1p-44, 0x1p-42, 0x1p-40, 0x1p-38, 0x1p-36, 0x1p-34};

// Of the union as it is, by grids and roundings [share].
constexpr double kVolumeMoved = 1e-9;

// Triangles and crossings of all attempts together: more than one of the largest heaps is not tried again.
constexpr std::size_t kMostWork = 1'000'000;

// What passes through each other once a union is rounded.
std::size_t countPierced(const HeapSoup& heap, const United& united) {
  Soup whole = heap.soup;
  std::vector<bool> isGone;
  for (const std::uint32_t shell : heap.shells) isGone.push_back(!united.isKept[shell]);
  dropTriangles(whole, isGone);
  appendSoup(united.soup, whole);
  const std::vector<Crossing> crossings = findCrossings(whole);
  return std::size_t(std::count_if(crossings.begin(), crossings.end(), [&whole](const Crossing& crossing) {
    return isPierced(whole, crossing);
  }));
}

double keptVolume(const HeapSoup& heap, const std::vector<bool>& isKept) {
  double volume = 0;
  for (std::uint32_t t = 0; t < heap.soup.triangles.size(); ++t)
    if (isKept[heap.shells[t]]) volume += volumeAbout(heap.soup, t, heap.soup.vertices[0]);
  return volume;
}

bool isBetter(const HeapUnion& own, const HeapUnion& other) {
  if (!own.united.refusal.empty()) return false;
  return !other.united.refusal.empty() || own.pierced < other.pierced;
}

bool isDone(const HeapUnion& made) {
  return made.united.refusal.empty() && made.pierced == 0;
}

// `volume` is that of the heap as it is, and learned where it is not known.
HeapUnion makeUnion(const HeapSoup& heap, const HeapFrame& frame, double grid, bool keepsLone,
                    std::optional<double>& volume) {
  Soup moved{frame.places, heap.soup.triangles, heap.soup.sources};
  moveToGrid(moved.vertices, grid);
  const std::vector<Crossing> crossings = findCrossings(moved);
  HeapUnion made{uniteShells(moved, heap.shells, crossings, keepsLone)};
  made.work = moved.triangles.size() + crossings.size();
  United& united = made.united;
  if (united.volume > 0 && !volume)
    volume = keptVolume(heap, united.isKept) + united.volume / frame.normals.determinant();
  if (!united.refusal.empty() || united.soup.triangles.empty()) return made;
  united.soup.vertices = placesBack(frame, heap.soup, std::move(united.soup.vertices));
  const double own = keptVolume(heap, united.isKept) + volumeOf(united.soup);
  if (volume && std::abs(own - *volume) <= kVolumeMoved * *volume)
    made.pierced = countPierced(heap, united);
  else
    united.refusal = "rounding changes their volume";
  return made;
}

}  // namespace

HeapUnion unionOf(const HeapSoup& heap) {
  const HeapFrame frame = frameOf(heap.soup);
  HeapUnion best;
  std::optional<double> volume;
  std::size_t work = 0;
  for (const double grid : kGrids)
    for (const bool keepsLone : {true, false}) {  // what merely touches may pass through by a rounding
      HeapUnion own = makeUnion(heap, frame, grid, keepsLone, volume);
      const std::size_t ownWork = own.work;
      const std::vector<bool> isKept = own.united.isKept;
      const bool keepsAny = std::find(isKept.begin(), isKept.end(), true) != isKept.end();
      if ((grid == 0 && keepsLone) || isBetter(own, best)) best = std::move(own);
      work += ownWork;
      if (isDone(best) || work + ownWork > kMostWork) return best;
      if (!keepsAny) break;
    }
  return best;
}

}  // namespace rubble::cooking
