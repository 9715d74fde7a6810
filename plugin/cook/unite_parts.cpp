#include "cook/unite_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cook/shells.h"
#include "cook/surface_sides.h"
#include "cook/windings.h"

namespace rubble::cooking {
namespace {

// Bounds for time and memory. Two balls of 99,224 triangles each, one turned within the other so that nearly
// all cross, met 392,528 times and took 34 s of a core and 0.9 GB; shifted by 0.3 radii they took 2 s.
constexpr std::size_t kMostTriangles = 200'000;
constexpr std::size_t kMostCrossings = 300'000;

// Of the union, by rounding [share].
constexpr double kVolumeLost = 1e-9;

// Closed pieces that are smaller are left out [share of the union].
constexpr double kDust = 1e-12;

bool isKeptAsGiven(const Facet& facet) {
  return facet.covers.size() == 1 && std::min(facet.front, facet.back) == 0 &&
         std::max(facet.front, facet.back) == 1;
}

// Corners that rounding brought to the same place become one. Triangles that have not three corners left go,
// and so does each two that lie on each other, back to back.
void joinRounded(Soup& soup) {
  std::map<std::array<double, 3>, std::uint32_t> ids;
  std::vector<std::uint32_t> idOf;
  for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) {
    const Eigen::Vector3d& p = soup.vertices[v];
    idOf.push_back(ids.try_emplace({p.x(), p.y(), p.z()}, v).first->second);
  }
  std::vector<bool> isSpare(soup.triangles.size(), false);
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> lone;  // by corners from the least on
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    auto& corners = soup.triangles[t];
    for (std::uint32_t& v : corners) v = idOf[v];
    const auto& [a, b, c] = corners;
    isSpare[t] = a == b || b == c || c == a;
    if (isSpare[t]) continue;
    std::array<std::uint32_t, 3> key = corners;
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    const auto behind = lone.find({key[0], key[2], key[1]});
    if (behind == lone.end() || behind->second.empty()) {
      lone[key].push_back(t);
    } else {
      isSpare[t] = isSpare[behind->second.back()] = true;
      behind->second.pop_back();
    }
  }
  dropTriangles(soup, isSpare);
}

// Shells that lie between what was meant to lie on each other.
void dropDust(Soup& soup, double least) {
  const Shells shells = findShells(soup);
  std::vector<bool> isDust(soup.triangles.size());
  for (std::size_t t = 0; t < isDust.size(); ++t)
    isDust[t] = std::abs(shells.list[shells.of[t]].volume) < least;
  dropTriangles(soup, isDust);
}

Soup surfaceOf(const Arrangement& arrangement, const std::vector<std::uint32_t>& shells,
               const std::vector<bool>& isKept) {
  Soup soup{arrangement.rounded, {}, {}};
  for (const Facet& facet : arrangement.facets) {
    if ((facet.front > 0) == (facet.back > 0)) continue;
    const int way = facet.back > 0 ? 1 : -1;
    for (const auto& [source, own] : facet.covers) {
      if (own != way) continue;
      if (isKept[shells[source]]) break;
      auto corners = facet.corners;
      if (way < 0) std::swap(corners[1], corners[2]);
      soup.triangles.push_back(corners);
      soup.sources.push_back(arrangement.soup.sources[source]);
      break;
    }
  }
  return soup;
}

United unite(const Soup& soup, const std::vector<std::uint32_t>& shells,
             const std::vector<Crossing>& crossings, bool keepsLone) {
  if (soup.triangles.size() > kMostTriangles || crossings.size() > kMostCrossings)
    throw Refused{"they are too large"};
  Arrangement arrangement(soup, crossings);
  countWindings(arrangement);
  United united;
  united.isKept.assign(*std::max_element(shells.begin(), shells.end()) + 1, keepsLone);
  for (const Facet& facet : arrangement.facets) {
    if (facet.front < 0 || facet.back < 0) throw Refused{"they are inside out in places"};
    if (isKeptAsGiven(facet)) continue;
    for (const Cover& cover : facet.covers) united.isKept[shells[cover.source]] = false;
  }
  united.soup = surfaceOf(arrangement, shells, united.isKept);
  if (united.soup.triangles.empty()) return united;
  const Eigen::Vector3d origin = soup.vertices[soup.triangles[0][0]];
  for (std::uint32_t t = 0; t < united.soup.triangles.size(); ++t)
    united.volume += volumeAbout(united.soup, t, origin);
  joinRounded(united.soup);
  const bool isSurface = makeSided(united.soup) && openEdges(united.soup).empty();
  if (isSurface) dropDust(united.soup, kDust * united.volume);
  if (!isSurface || !(std::abs(volumeOf(united.soup) - united.volume) <= kVolumeLost * united.volume))
    united.refusal = "their union has details too fine for numbers of 64 bits";
  return united;
}

}  // namespace

United uniteShells(const Soup& soup, const std::vector<std::uint32_t>& shells,
                   const std::vector<Crossing>& crossings, bool keepsLone) {
  try {
    return unite(soup, shells, crossings, keepsLone);
  } catch (const Refused& refused) {
    United none;
    none.refusal = refused.why;
    return none;
  }
}

}  // namespace rubble::cooking
