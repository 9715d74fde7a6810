#include "cook/weld.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/groups.h"
#include "base/hash.h"

namespace rubble::cooking {
namespace {

// More are no seams but a soup of another kind; looking for what lies on them would take minutes.
constexpr std::size_t kMostSplitEdges = 100'000;
// A triangle gets corners on one side at a time; it has three.
constexpr int kSplitPasses = 3;

std::vector<std::uint32_t> verticesOf(const std::vector<SoupEdge>& edges) {
  std::vector<std::uint32_t> vertices;
  for (const SoupEdge& edge : edges) vertices.insert(vertices.end(), {edge.low, edge.high});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

void joinEqual(const Soup& soup, std::vector<std::uint32_t> vertices, base::Groups& groups) {
  const auto& points = soup.vertices;
  const auto key = [&points](std::uint32_t v) {
    return std::tuple(points[v].x(), points[v].y(), points[v].z(), v);
  };
  std::sort(vertices.begin(), vertices.end(),
            [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t k = 1; k < vertices.size(); ++k)
    if (points[vertices[k]] == points[vertices[k - 1]]) groups.join(vertices[k], vertices[k - 1]);
}

using GridCell = std::array<std::int64_t, 3>;
struct CellHash {
  std::size_t operator()(const GridCell& cell) const {
    base::Fnv1a hash;
    for (const std::int64_t number : cell) hash.add(number);
    return std::size_t(hash.value());
  }
};

void joinNear(const Soup& soup, const std::vector<std::uint32_t>& vertices, double distance,
              base::Groups& groups) {
  std::unordered_map<GridCell, std::vector<std::uint32_t>, CellHash> grid;
  for (const std::uint32_t v : vertices) {
    GridCell home{};
    for (int axis = 0; axis < 3; ++axis)
      home[std::size_t(axis)] = std::int64_t(std::floor(soup.vertices[v][axis] / distance));
    for (int n = 0; n < 27; ++n) {
      const auto near = grid.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
      if (near == grid.end()) continue;
      for (const std::uint32_t other : near->second)
        if ((soup.vertices[v] - soup.vertices[other]).norm() <= distance) groups.join(v, other);
    }
    grid[home].push_back(v);
  }
}

// Each corner becomes the first of its group.
void rename(Soup& soup, base::Groups& groups) {
  std::vector<std::uint32_t> first(soup.vertices.size(), kNoElement);
  for (std::uint32_t v = 0; v < soup.vertices.size(); ++v)
    if (first[groups.of(v)] == kNoElement) first[groups.of(v)] = v;
  for (auto& triangle : soup.triangles)
    for (std::uint32_t& v : triangle) v = first[groups.of(v)];
}

struct Split {
  double share;  // of the way along the edge
  std::uint32_t vertex;
};

// Vertices of `ordered`, sorted along x, strictly within an edge.
std::vector<Split> splitsOf(const Soup& soup, const std::array<std::uint32_t, 2>& edge,
                            const std::vector<std::uint32_t>& ordered, double distance) {
  const Eigen::Vector3d& from = soup.vertices[edge[0]];
  const Eigen::Vector3d way = soup.vertices[edge[1]] - from;
  const double length = way.norm();
  std::vector<Split> splits;
  if (length <= 2 * distance) return splits;
  const double low = std::min(from.x(), from.x() + way.x()) - distance;
  const double high = std::max(from.x(), from.x() + way.x()) + distance;
  for (auto at = std::partition_point(ordered.begin(), ordered.end(),
                                      [&](std::uint32_t v) { return soup.vertices[v].x() < low; });
       at != ordered.end() && soup.vertices[*at].x() <= high; ++at) {
    if (*at == edge[0] || *at == edge[1]) continue;
    const Eigen::Vector3d offset = soup.vertices[*at] - from;
    const double along = offset.dot(way) / length;
    if (along <= distance || along >= length - distance) continue;
    if ((offset - way * (along / length)).norm() <= distance) splits.push_back({along / length, *at});
  }
  std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) {
    return std::tie(a.share, a.vertex) < std::tie(b.share, b.vertex);
  });
  return splits;
}

// Cuts each triangle on one of its open sides at most. Returns the triangles that were cut.
std::vector<std::uint32_t> splitOnce(Soup& soup, const std::vector<SoupEdge>& open, double distance) {
  std::vector<std::uint32_t> ordered = verticesOf(open);
  std::sort(ordered.begin(), ordered.end(), [&soup](std::uint32_t a, std::uint32_t b) {
    return soup.vertices[a].x() < soup.vertices[b].x();
  });
  std::vector<std::uint32_t> cut;
  std::vector<bool> isCut(soup.triangles.size(), false);
  for (const SoupEdge& side : open) {
    const auto triangle = soup.triangles[side.triangle];
    const std::uint32_t a = triangle[side.side];
    const std::uint32_t b = triangle[(side.side + 1) % 3];
    const std::uint32_t c = triangle[(side.side + 2) % 3];
    if (isCut[side.triangle]) continue;
    std::vector<Split> splits = splitsOf(soup, {a, b}, ordered, distance);
    std::erase_if(splits, [c](const Split& split) { return split.vertex == c; });
    if (splits.empty()) continue;
    isCut[side.triangle] = true;
    cut.push_back(soup.sources[side.triangle].triangle);
    splits.push_back({1, b});
    std::uint32_t from = a;
    for (const Split& split : splits) {
      if (from == a) {
        soup.triangles[side.triangle] = {from, split.vertex, c};
      } else {
        soup.triangles.push_back({from, split.vertex, c});
        soup.sources.push_back(soup.sources[side.triangle]);
      }
      from = split.vertex;
    }
  }
  return cut;
}

}  // namespace

Welded weld(Soup& soup, double distance) {
  base::Groups groups(soup.vertices.size());
  joinEqual(soup, verticesOf(openEdges(soup)), groups);
  std::vector<std::array<std::uint32_t, 3>> given = soup.triangles;
  rename(soup, groups);
  const std::vector<SoupEdge> open = openEdges(soup);
  if (!open.empty() && distance > 0) {
    joinNear(soup, verticesOf(open), distance, groups);
    rename(soup, groups);
  }
  std::vector<bool> isUsed(soup.vertices.size(), false);
  for (const auto& triangle : given)
    for (const std::uint32_t v : triangle) isUsed[v] = true;
  std::vector<std::size_t> members(soup.vertices.size(), 0);
  for (std::uint32_t v = 0; v < soup.vertices.size(); ++v)
    if (isUsed[v]) ++members[groups.of(v)];
  Welded welded;
  for (const std::size_t count : members)
    if (count > 1) {
      welded.before += count;
      ++welded.after;
    }
  return welded;
}

std::size_t splitAtCorners(Soup& soup, double distance) {
  std::vector<SoupEdge> open = openEdges(soup);
  if (open.empty() || open.size() > kMostSplitEdges) return 0;
  const std::size_t openBefore = open.size();
  Soup changed = soup;
  std::vector<std::uint32_t> cut;
  for (int pass = 0; pass < kSplitPasses; ++pass) {
    const std::vector<std::uint32_t> more = splitOnce(changed, open, distance);
    if (more.empty()) break;
    cut.insert(cut.end(), more.begin(), more.end());
    open = openEdges(changed);
  }
  if (cut.empty() || open.size() >= openBefore) return 0;
  soup = std::move(changed);
  std::sort(cut.begin(), cut.end());
  return std::size_t(std::unique(cut.begin(), cut.end()) - cut.begin());
}

}  // namespace rubble::cooking
