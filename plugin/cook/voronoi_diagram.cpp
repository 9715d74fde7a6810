#include "cook/voronoi_diagram.h"

#include <algorithm>
#include <utility>

#include "cook/delaunay.h"
#include "rubble/asset.h"

namespace rubble::cooking {
namespace {

// Sentinels close every real cell. At three diagonals no point of the solid is nearer to one than to a site:
// it has a site within one diagonal, and the sentinels are farther than two and a half.
constexpr double kSentinelRadius = 3.0;  // [diagonals of the solid]

// The 12 corners of an icosahedron and the midpoints of its 30 edges: 42 directions.
std::vector<Eigen::Vector3d> sentinelDirections() {
  constexpr double kGolden = 1.6180339887498949;
  std::vector<Eigen::Vector3d> corners;
  for (const double one : {-1.0, 1.0})
    for (const double golden : {-kGolden, kGolden})
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3d corner = Eigen::Vector3d::Zero();
        corner[(axis + 1) % 3] = one;
        corner[(axis + 2) % 3] = golden;
        corners.push_back(corner);
      }
  constexpr double kEdgeLength = 2.0;  // of this icosahedron; its next distance is 2 x golden
  std::vector<Eigen::Vector3d> directions = corners;
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = a + 1; b < corners.size(); ++b)
      if ((corners[a] - corners[b]).norm() < 1.1 * kEdgeLength)
        directions.push_back((corners[a] + corners[b]) / 2);
  for (Eigen::Vector3d& direction : directions) direction.normalize();
  return directions;
}

// Sign of the permutation that sorts the tetrahedron's corners.
bool isOddPermutation(const std::array<std::uint32_t, 4>& p) {
  int inversions = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) inversions += p[a] > p[b] ? 1 : 0;
  return inversions % 2 != 0;
}

// The Voronoi edge of the facet opposite to `corner` of tetrahedron `t`.
VoronoiEdge dualEdge(const Tetrahedra& tetrahedra, std::uint32_t t, std::size_t corner) {
  const auto& points = tetrahedra.points[t];
  const std::uint32_t other = tetrahedra.neighbours[t][corner];
  VoronoiEdge edge{};
  for (std::size_t k = 0, at = 0; k < 4; ++k)
    if (k != corner) edge.sites[at++] = points[k];
  std::sort(edge.sites.begin(), edge.sites.end());
  // (s_j - s_i) x (s_k - s_i) points to the apex, into t, iff (i, j, k, apex) is oriented like t itself. The
  // edge from t to its neighbour leads away from t's apex.
  const bool inward = isOddPermutation({edge.sites[0], edge.sites[1], edge.sites[2], points[corner]}) ==
                      isOddPermutation(points);
  edge.from = inward ? other : t;
  edge.to = inward ? t : other;
  return edge;
}

void collectEdges(const Tetrahedra& tetrahedra, VoronoiDiagram& diagram) {
  for (std::uint32_t t = 0; t < tetrahedra.points.size(); ++t) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t other = tetrahedra.neighbours[t][corner];
      if (other == kNoElement || other < t) continue;
      const VoronoiEdge edge = dualEdge(tetrahedra, t, corner);
      if (edge.sites[2] < diagram.siteCount) diagram.edges.push_back(edge);
    }
  }
  std::sort(diagram.edges.begin(), diagram.edges.end(),
            [](const VoronoiEdge& a, const VoronoiEdge& b) { return a.sites < b.sites; });
}

// From the tetrahedra and not from the edges: where there are few sites, all edges of a face may lie among
// sentinels.
void collectNeighbours(const Tetrahedra& tetrahedra, VoronoiDiagram& diagram) {
  std::vector<std::vector<std::uint32_t>> lists(diagram.siteCount);
  for (const auto& points : tetrahedra.points)
    for (const std::uint32_t a : points)
      for (const std::uint32_t b : points)
        if (a != b && a < diagram.siteCount && b < diagram.siteCount) lists[a].push_back(b);
  diagram.neighbourStart.assign(1, 0);
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    diagram.neighbourList.insert(diagram.neighbourList.end(), list.begin(), list.end());
    diagram.neighbourStart.push_back(std::uint32_t(diagram.neighbourList.size()));
  }
}

}  // namespace

Eigen::Vector3d VoronoiDiagram::vertexPosition(std::uint32_t vertex) const {
  const auto& [p0, p1, p2, p3] = vertices[vertex];
  const Eigen::Vector3d a = points[p1] - points[p0];
  const Eigen::Vector3d b = points[p2] - points[p0];
  const Eigen::Vector3d c = points[p3] - points[p0];
  const Eigen::Vector3d bc = b.cross(c);
  return points[p0] + (a.squaredNorm() * bc + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
                          (2 * a.dot(bc));
}

std::uint32_t VoronoiDiagram::nearestSite(const Eigen::Vector3d& place, std::uint32_t start) const {
  std::uint32_t best = start;
  double distance = (points[best] - place).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    for (const std::uint32_t site : neighbours(best)) {
      const double other = (points[site] - place).squaredNorm();
      if (other >= distance) continue;
      distance = other;
      best = site;
      moved = true;
      break;
    }
  }
  return best;
}

VoronoiDiagram voronoiDiagram(std::span<const Eigen::Vector3d> sites, const Eigen::Vector3d& centre,
                              double diagonal) {
  VoronoiDiagram diagram;
  diagram.siteCount = std::uint32_t(sites.size());
  diagram.points.assign(sites.begin(), sites.end());
  for (const Eigen::Vector3d& direction : sentinelDirections())
    diagram.points.push_back(centre + kSentinelRadius * diagonal * direction);
  Tetrahedra tetrahedra = delaunay(diagram.points);
  collectEdges(tetrahedra, diagram);
  collectNeighbours(tetrahedra, diagram);
  diagram.vertices = std::move(tetrahedra.points);
  for (auto& vertex : diagram.vertices) std::sort(vertex.begin(), vertex.end());
  return diagram;
}

}  // namespace rubble::cooking
