#include "cook/caps.h"

#include <algorithm>
#include <tuple>

#include "cook/contradiction.h"
#include "cook/triangulation.h"

namespace rubble::cooking {
namespace {

// A piece of the outline of the face between `first` and `second`, counter-clockwise seen from `second`.
struct OutlineEdge {
  std::uint32_t first, second;
  std::uint32_t from, to;  // pool vertices
  bool isCut;              // lies on the solid's surface
};

// Of the three faces around a Voronoi edge (i, j, k), the outlines of (i, j) and (j, k) run along its
// direction, that of (i, k) against it.
void addStretch(const VoronoiEdge& edge, const InsideStretch& stretch, std::vector<OutlineEdge>& outline) {
  const auto& [i, j, k] = edge.sites;
  outline.push_back({i, j, stretch.from, stretch.to, false});
  outline.push_back({j, k, stretch.from, stretch.to, false});
  outline.push_back({i, k, stretch.to, stretch.from, false});
}

// Chains the outline of one face, sorted by `from`, into loops.
std::vector<Loop> chain(std::span<const OutlineEdge> outline) {
  std::vector<Loop> loops;
  std::vector<bool> used(outline.size(), false);
  for (std::size_t start = 0; start < outline.size(); ++start) {
    if (used[start]) continue;
    Loop& loop = loops.emplace_back();
    for (std::size_t at = start; !used[at];) {
      used[at] = true;
      loop.push_back(outline[at].from);
      const auto next =
          std::lower_bound(outline.begin(), outline.end(), outline[at].to,
                           [](const OutlineEdge& edge, std::uint32_t v) { return edge.from < v; });
      if (next == outline.end() || next->from != outline[at].to)
        throw Contradiction("the outline of a face is open");
      at = std::size_t(next - outline.begin());
    }
    if (loop.size() < 3) throw Contradiction("the outline of a face has two corners");
  }
  return loops;
}

void buildCap(const VoronoiDiagram& diagram, std::span<const OutlineEdge> outline, const VertexPool& pool,
              Caps& result) {
  for (std::size_t e = 1; e < outline.size(); ++e)
    if (outline[e].from == outline[e - 1].from) throw Contradiction("the outline of a face branches");
  const std::uint32_t first = outline[0].first;
  const std::uint32_t second = outline[0].second;
  const std::vector<Loop> loops = chain(outline);
  const auto start = std::uint32_t(result.triangles.size());
  const bool isCut =
      std::any_of(outline.begin(), outline.end(), [](const OutlineEdge& edge) { return edge.isCut; });
  if (isCut || loops.size() > 1) {
    const Eigen::Vector3d normal = (diagram.points[second] - diagram.points[first]).normalized();
    triangulate(loops, pool.positions(), normal, result.triangles);
  } else {
    triangulateFan(loops[0], result.triangles);
  }
  result.caps.push_back({first, second, start, std::uint32_t(result.triangles.size()) - start, true});
}

}  // namespace

Caps buildCaps(const VoronoiDiagram& diagram, const SurfacePieces& pieces,
               const std::vector<InsideStretch>& stretches, const VertexPool& pool) {
  std::vector<OutlineEdge> outline;
  outline.reserve(3 * stretches.size() + pieces.cuts.size());
  for (const InsideStretch& stretch : stretches) addStretch(diagram.edges[stretch.edge], stretch, outline);
  for (const SurfacePieces::Cut& cut : pieces.cuts)  // the cap is the polygon's neighbour in the cell's mesh
    outline.push_back({cut.first, cut.second, cut.to, cut.from, true});
  std::sort(outline.begin(), outline.end(), [](const OutlineEdge& a, const OutlineEdge& b) {
    return std::tie(a.first, a.second, a.from, a.to) < std::tie(b.first, b.second, b.from, b.to);
  });

  Caps result;
  for (std::size_t at = 0; at < outline.size();) {
    std::size_t end = at + 1;
    while (end < outline.size() && outline[end].first == outline[at].first &&
           outline[end].second == outline[at].second)
      ++end;
    buildCap(diagram, std::span(outline).subspan(at, end - at), pool, result);
    at = end;
  }
  return result;
}

}  // namespace rubble::cooking
