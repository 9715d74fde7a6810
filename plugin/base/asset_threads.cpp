// Asset::validate by parts. Threads only ever say that all is well: where one finds a fault, or cannot be
// had, one thread goes through everything again in order, so that the first fault is the one that is told.
#include <algorithm>
#include <atomic>
#include <exception>
#include <vector>

#include "base/asset_cell_walk.h"
#include "base/asset_check.h"
#include "base/threads.h"

namespace rubble::base {
namespace {

// False where work(part) throws for a part of [0, parts).
template <class Work>
bool succeedsInParts(ThreadPool& pool, int parts, const Work& work) {
  constexpr int kCostly = 1 << 20;  // worth waking threads for
  std::atomic<bool> isWell{true};
  pool.run(parts, kCostly, [&](int begin, int end) {
    try {
      for (int part = begin; part < end; ++part) work(part);
    } catch (const std::exception&) {
      isWell = false;
    }
  });
  return isWell;
}

// The first corner of a cell, where all corners stand by their cells.
std::uint32_t firstCornerOf(const Asset& asset, std::uint32_t cell) {
  const auto isBefore = [](const CellCorner& corner, std::uint32_t wanted) {
    return corner.element < wanted;
  };
  return std::uint32_t(std::lower_bound(asset.corners.begin(), asset.corners.end(), cell, isBefore) -
                       asset.corners.begin());
}

bool passesCells(const Asset& asset, const AssetScale& scale, ThreadPool& pool, int parts) {
  const auto firstCell = [&](int part) {
    return std::uint32_t(asset.elementCount() * std::size_t(part) / std::size_t(parts));
  };
  std::vector<std::uint32_t> firstCorners;
  std::vector<CellWalk> walks;
  for (int part = 0; part < parts; ++part) {
    firstCorners.push_back(part == 0 ? 0 : firstCornerOf(asset, firstCell(part)));
    walks.emplace_back(asset, scale.rounding, firstCorners.back());
  }
  const bool isWell = succeedsInParts(pool, parts, [&](int part) {
    checkCells(asset, walks[std::size_t(part)], firstCell(part), firstCell(part + 1));
  });
  if (!isWell) return false;
  for (std::size_t part = 1; part < walks.size(); ++part) {
    // Corners that stand elsewhere would be looked at by nobody.
    if (walks[0].cornersEnd() != firstCorners[part]) return false;
    walks[0].continueFrom(walks[part]);
  }
  return succeedsInParts(pool, 1, [&](int) { walks[0].finish(); });
}

bool passesInParts(const Asset& asset, const AssetScale& scale, int threads) try {
  ThreadPool pool(threads);
  return passesCells(asset, scale, pool, threads) && succeedsInParts(pool, 2, [&](int part) {
           part == 0 ? checkNeighbours(asset) : checkDistances(asset);
         });
} catch (const std::exception&) {  // no thread or no memory to be had
  return false;
}

}  // namespace

void checkAsset(const Asset& asset, int threads) {
  checkCounts(asset);
  checkIndices(asset);
  checkLook(asset);
  const AssetScale scale = checkNumbers(asset);
  if (threads > 1 && passesInParts(asset, scale, threads)) return;
  checkCells(asset, scale);
  checkNeighbours(asset);
  checkDistances(asset);
}

}  // namespace rubble::base
