#include "cook/surface_pass.h"

#include <algorithm>

namespace rubble::cooking {
namespace {

// A polygon under the knife. The label belongs to the edge that leaves the vertex.
struct Corner {
  Eigen::Vector3d place;
  std::uint32_t label;
};
using Polygon = std::vector<Corner>;

// The site nearest to each mesh vertex, found along the mesh so that every walk starts next door.
std::vector<std::uint32_t> nearestSites(const CheckedMesh& mesh, const VoronoiDiagram& diagram) {
  std::vector<std::uint32_t> site(mesh.vertices.size(), kNoElement);
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = true;
    queue.assign(1, seed);
    std::uint32_t hint = 0;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      const auto& corners = mesh.triangles[queue[at]];
      for (const std::uint32_t v : corners)
        if (site[v] != kNoElement) hint = site[v];
      for (const std::uint32_t v : corners)
        if (site[v] == kNoElement) hint = site[v] = diagram.nearestSite(mesh.vertices[v], hint);
      for (const std::uint32_t neighbour : mesh.neighbours[queue[at]]) {
        if (seen[neighbour]) continue;
        seen[neighbour] = true;
        queue.push_back(neighbour);
      }
    }
  }
  return site;
}

class TriangleCutter {
 public:
  TriangleCutter(const CheckedMesh& mesh, const VoronoiDiagram& diagram, VertexPool& pool,
                 SurfacePieces& pieces)
      : m_mesh(mesh),
        m_diagram(diagram),
        m_pool(pool),
        m_pieces(pieces),
        m_visitor(diagram.siteCount, kNoElement) {}

  // Cuts the triangle by the cell of `start`, which holds one of its corners, then by every cell found behind
  // a cut.
  void cut(std::uint32_t triangle, std::uint32_t start) {
    m_pool.enter(triangle);
    m_queue.assign(1, start);
    m_visitor[start] = triangle;
    for (std::size_t at = 0; at < m_queue.size(); ++at) {
      const std::uint32_t site = m_queue[at];
      clipToCell(triangle, site);
      if (m_polygon.size() < 3) continue;
      store(triangle, site);
      for (const Corner& corner : m_polygon) {
        if (corner.label >= kSideLabel || m_visitor[corner.label] == triangle) continue;
        m_visitor[corner.label] = triangle;
        m_queue.push_back(corner.label);
      }
    }
  }

 private:
  void clipToCell(std::uint32_t triangle, std::uint32_t site) {
    m_polygon.clear();
    for (std::uint32_t side = 0; side < 3; ++side)
      m_polygon.push_back({m_mesh.vertices[m_mesh.triangles[triangle][side]], kSideLabel + side});
    for (const std::uint32_t neighbour : m_diagram.neighbours(site)) {
      clipToBisector(site, neighbour);
      if (m_polygon.size() < 3) return;
    }
  }

  // Keeps what is nearer to `site` than to `other` [Sutherland-Hodgman].
  void clipToBisector(std::uint32_t site, std::uint32_t other) {
    const Eigen::Vector3d across = m_diagram.points[other] - m_diagram.points[site];
    const Eigen::Vector3d middle = (m_diagram.points[other] + m_diagram.points[site]) / 2;
    const std::size_t count = m_polygon.size();
    m_heights.resize(count);
    bool cuts = false;
    for (std::size_t c = 0; c < count; ++c) {
      m_heights[c] = across.dot(m_polygon[c].place - middle);
      cuts = cuts || m_heights[c] > 0;
    }
    if (!cuts) return;
    m_clipped.clear();
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t next = c + 1 == count ? 0 : c + 1;
      const bool inside = m_heights[c] <= 0;
      if (inside) m_clipped.push_back(m_polygon[c]);
      if (inside == (m_heights[next] <= 0)) continue;
      const double share = m_heights[c] / (m_heights[c] - m_heights[next]);
      const Eigen::Vector3d place = m_polygon[c].place + share * (m_polygon[next].place - m_polygon[c].place);
      // Going out, the cut follows; coming in, the rest of this edge.
      m_clipped.push_back({place, inside ? other : m_polygon[c].label});
    }
    std::swap(m_polygon, m_clipped);
  }

  void store(std::uint32_t triangle, std::uint32_t site) {
    const auto first = std::uint32_t(m_pieces.vertices.size());
    const std::size_t count = m_polygon.size();
    for (std::size_t c = 0; c < count; ++c) {
      const std::uint32_t before = m_polygon[c == 0 ? count - 1 : c - 1].label;
      m_pieces.vertices.push_back(vertexBetween(triangle, site, before, m_polygon[c]));
      const std::uint32_t label = m_polygon[c].label;
      m_pieces.sides.push_back(label < kSideLabel ? kCutEdge : std::uint8_t(label - kSideLabel));
    }
    for (std::size_t c = 0; c < count; ++c) {
      const std::uint32_t other = m_polygon[c].label;
      if (other >= kSideLabel || other < site) continue;
      const std::uint32_t* vertices = m_pieces.vertices.data() + first;
      m_pieces.cuts.push_back({site, other, vertices[c], vertices[c + 1 == count ? 0 : c + 1]});
    }
    m_pieces.polygons.push_back({triangle, site, first, std::uint32_t(count)});
  }

  // The pool's vertex at a corner of the polygon, known by the labels of the two edges that meet there.
  std::uint32_t vertexBetween(std::uint32_t triangle, std::uint32_t site, std::uint32_t before,
                              const Corner& corner) {
    const std::uint32_t after = corner.label;
    if (before >= kSideLabel && after >= kSideLabel) {
      return m_pool.meshVertex(m_mesh.triangles[triangle][after - kSideLabel], site);
    }
    if (before >= kSideLabel || after >= kSideLabel) {
      const std::uint32_t side = std::max(before, after) - kSideLabel;
      return m_pool.onSide(side, site, std::min(before, after));
    }
    const std::uint32_t vertex = m_pool.onTriangle({site, before, after}, corner.place);
    // Three polygons share the vertex; the one of the smallest site reports it. Seen from outside the cells
    // stand counter-clockwise as (site, before, after), so the triangle's normal and the Voronoi edge's
    // direction agree, and the edge leaves, iff `before` is the smaller of the other two.
    if (site < before && site < after)
      m_pieces.hits.push_back(
          {{site, std::min(before, after), std::max(before, after)}, vertex, before < after});
    return vertex;
  }

  const CheckedMesh& m_mesh;
  const VoronoiDiagram& m_diagram;
  VertexPool& m_pool;
  SurfacePieces& m_pieces;
  std::vector<std::uint32_t> m_visitor;  // the last triangle whose cut reached each site
  std::vector<std::uint32_t> m_queue;
  Polygon m_polygon, m_clipped;
  std::vector<double> m_heights;
};

}  // namespace

SurfacePieces cutSurface(const CheckedMesh& mesh, const VoronoiDiagram& diagram, VertexPool& pool) {
  const std::vector<std::uint32_t> nearest = nearestSites(mesh, diagram);
  SurfacePieces pieces;
  TriangleCutter cutter(mesh, diagram, pool, pieces);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) cutter.cut(t, nearest[mesh.triangles[t][0]]);
  return pieces;
}

}  // namespace rubble::cooking
