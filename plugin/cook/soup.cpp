#include "cook/soup.h"

#include <algorithm>
#include <tuple>

namespace rubble::cooking {

std::vector<SoupEdge> sortedEdges(const Soup& soup) {
  std::vector<SoupEdge> edges;
  edges.reserve(3 * soup.triangles.size());
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t a = soup.triangles[t][side];
      const std::uint32_t b = soup.triangles[t][(side + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, side, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const SoupEdge& a, const SoupEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) < std::tie(b.low, b.high, b.triangle, b.side);
  });
  return edges;
}

std::vector<SoupEdge> openEdges(const Soup& soup) {
  std::vector<SoupEdge> open;
  forEachEdge(sortedEdges(soup), [&open](std::span<const SoupEdge> sides) {
    if (sides.size() == 1) open.push_back(sides[0]);
  });
  return open;
}

void dropTriangles(Soup& soup, const std::vector<bool>& isSpare) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (isSpare[t]) continue;
    soup.triangles[kept] = soup.triangles[t];
    soup.sources[kept] = soup.sources[t];
    ++kept;
  }
  soup.triangles.resize(kept);
  soup.sources.resize(kept);
}

}  // namespace rubble::cooking
