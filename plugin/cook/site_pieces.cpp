#include "cook/site_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cook/polyhedron.h"

namespace rubble::cooking {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Connected components of a cell's mesh, by shared vertices.
class Components {
 public:
  explicit Components(const std::vector<Triangle>& triangles) {
    for (const Triangle& triangle : triangles)
      m_vertices.insert(m_vertices.end(), triangle.begin(), triangle.end());
    std::sort(m_vertices.begin(), m_vertices.end());
    m_vertices.erase(std::unique(m_vertices.begin(), m_vertices.end()), m_vertices.end());
    m_parent.assign(m_vertices.size(), 0);
    std::iota(m_parent.begin(), m_parent.end(), std::size_t{0});
    for (const Triangle& triangle : triangles)
      for (const std::uint32_t v : triangle) m_parent[root(local(v))] = root(local(triangle[0]));
  }

  std::size_t of(const Triangle& triangle) { return root(local(triangle[0])); }

 private:
  std::size_t local(std::uint32_t vertex) const {
    return std::size_t(std::lower_bound(m_vertices.begin(), m_vertices.end(), vertex) - m_vertices.begin());
  }
  std::size_t root(std::size_t v) {
    while (m_parent[v] != v) v = m_parent[v] = m_parent[m_parent[v]];
    return v;
  }

  std::vector<std::uint32_t> m_vertices;
  std::vector<std::size_t> m_parent;
};

// Signed solid angle of a triangle [van Oosterom and Strackee 1983]: 4 pi summed over a shell around the eye.
double solidAngle(const Eigen::Vector3d& eye, const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                  const Eigen::Vector3d& r) {
  const Eigen::Vector3d a = (p - eye).normalized();
  const Eigen::Vector3d b = (q - eye).normalized();
  const Eigen::Vector3d c = (r - eye).normalized();
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

class CellPieces {
 public:
  CellPieces(const RestrictedVoronoi& diagram, std::uint32_t cell)
      : m_triangles(collect(diagram, cell)), m_components(m_triangles) {
    struct Shell {
      double angle = 0;
      PolyhedronIntegrals integrals;
    };
    const Eigen::Vector3d& site = diagram.sites[cell];
    std::map<std::size_t, Shell> shells;
    for (const Triangle& t : m_triangles) {
      Shell& shell =
          shells.try_emplace(m_components.of(t), Shell{0, PolyhedronIntegrals(site)}).first->second;
      const auto& [p, q, r] =
          std::tie(diagram.vertices[t[0]], diagram.vertices[t[1]], diagram.vertices[t[2]]);
      shell.angle += solidAngle(site, p, q, r);
      shell.integrals.add(p, q, r);
    }
    const auto largest = std::max_element(shells.begin(), shells.end(), [](const auto& a, const auto& b) {
      return a.second.angle < b.second.angle;
    });
    m_site = largest->first;
    // A shell with negative volume bounds a cavity, not a piece.
    for (const auto& [component, shell] : shells)
      if (component != m_site && shell.integrals.volume() > 0) m_foreign.push_back(std::uint32_t(component));
  }

  // 0: the piece of the site; others from 1.
  std::uint32_t pieceOf(const Triangle& triangle) {
    const auto found =
        std::find(m_foreign.begin(), m_foreign.end(), std::uint32_t(m_components.of(triangle)));
    return found == m_foreign.end() ? 0 : std::uint32_t(found - m_foreign.begin()) + 1;
  }
  std::size_t foreignCount() const { return m_foreign.size(); }

 private:
  static std::vector<Triangle> collect(const RestrictedVoronoi& diagram, std::uint32_t cell) {
    std::vector<Triangle> triangles;
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      triangles.push_back({a, b, c});
    });
    return triangles;
  }

  std::vector<Triangle> m_triangles;
  Components m_components;
  std::size_t m_site = 0;
  std::vector<std::uint32_t> m_foreign;  // components
};

}  // namespace

SitePieces findSitePieces(const RestrictedVoronoi& diagram) {
  const std::size_t triangles = diagram.caps.triangles.size();
  SitePieces pieces{std::vector<std::uint32_t>(diagram.surface.polygons.size(), 0),
                    std::vector<std::uint32_t>(triangles, 0),
                    std::vector<std::uint32_t>(triangles, 0),
                    {}};
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    if (diagram.polygonsOf.of(cell).empty()) continue;  // whole convex cells are of one piece
    CellPieces cellPieces(diagram, cell);
    if (cellPieces.foreignCount() == 0) continue;
    const auto before = std::uint32_t(pieces.foreign.size());
    const auto pieceOf = [&cellPieces, before](const Triangle& triangle) {
      const std::uint32_t piece = cellPieces.pieceOf(triangle);
      return piece == 0 ? 0 : piece + before;
    };
    pieces.foreign.insert(pieces.foreign.end(), cellPieces.foreignCount(), cell);
    for (const std::uint32_t p : diagram.polygonsOf.of(cell)) {
      const std::uint32_t* v = diagram.surface.vertices.data() + diagram.surface.polygons[p].first;
      pieces.polygons[p] = pieceOf({v[0], v[1], v[2]});
    }
    for (const std::uint32_t c : diagram.capsOf.of(cell)) {
      const Cap& cap = diagram.caps.caps[c];
      std::vector<std::uint32_t>& flags = cap.first == cell ? pieces.trianglesFirst : pieces.trianglesSecond;
      for (std::uint32_t t = cap.firstTriangle; t < cap.firstTriangle + cap.triangleCount; ++t)
        flags[t] = pieceOf(diagram.caps.triangles[t]);
    }
  }
  return pieces;
}

}  // namespace rubble::cooking
