#include "cook/site_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "cook/polyhedron.h"

namespace rubble::cooking {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Connected components of one cell's mesh after the other, by shared vertices.
class Components {
 public:
  explicit Components(std::size_t vertices) : m_parent(vertices), m_cell(vertices, kNoElement) {}

  // Those of these triangles; returns how many.
  std::size_t join(std::uint32_t cell, const std::vector<Triangle>& triangles) {
    std::size_t count = 0;
    for (const Triangle& triangle : triangles)
      for (const std::uint32_t v : triangle) {
        if (m_cell[v] == cell) continue;
        m_cell[v] = cell;
        m_parent[v] = v;
        ++count;
      }
    for (const Triangle& triangle : triangles)
      for (const std::uint32_t v : triangle) {
        const std::uint32_t from = of(v);
        const std::uint32_t to = of(triangle[0]);
        if (from == to) continue;
        m_parent[from] = to;
        --count;
      }
    return count;
  }

  // The vertex that stands for the component.
  std::uint32_t of(std::uint32_t v) {
    while (m_parent[v] != v) v = m_parent[v] = m_parent[m_parent[v]];
    return v;
  }

 private:
  std::vector<std::uint32_t> m_parent;
  std::vector<std::uint32_t> m_cell;  // the last cell of each vertex
};

// Signed solid angle of a triangle [van Oosterom and Strackee 1983]: 4 pi summed over a shell around the eye.
double solidAngle(const Eigen::Vector3d& eye, const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                  const Eigen::Vector3d& r) {
  const Eigen::Vector3d a = (p - eye).normalized();
  const Eigen::Vector3d b = (q - eye).normalized();
  const Eigen::Vector3d c = (r - eye).normalized();
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

// The pieces of one cell after the other.
class CellPieces {
 public:
  explicit CellPieces(const RestrictedVoronoi& diagram)
      : m_diagram(diagram), m_components(diagram.vertices.size()) {}

  // Of the pieces but the site's, from 1 on.
  std::size_t count(std::uint32_t cell) {
    m_triangles.clear();
    m_foreign.clear();
    m_diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      m_triangles.push_back({a, b, c});
    });
    if (m_components.join(cell, m_triangles) > 1) listForeign(m_diagram.sites[cell]);
    return m_foreign.size();
  }

  // 0: the piece of the site; others from 1.
  std::uint32_t pieceOf(const Triangle& triangle) {
    const auto found = std::find(m_foreign.begin(), m_foreign.end(), m_components.of(triangle[0]));
    return found == m_foreign.end() ? 0 : std::uint32_t(found - m_foreign.begin()) + 1;
  }

 private:
  void listForeign(const Eigen::Vector3d& site) {
    struct Shell {
      double angle = 0;
      PolyhedronIntegrals integrals;
    };
    std::map<std::uint32_t, Shell> shells;
    for (const Triangle& t : m_triangles) {
      Shell& shell =
          shells.try_emplace(m_components.of(t[0]), Shell{0, PolyhedronIntegrals(site)}).first->second;
      const auto& [p, q, r] =
          std::tie(m_diagram.vertices[t[0]], m_diagram.vertices[t[1]], m_diagram.vertices[t[2]]);
      shell.angle += solidAngle(site, p, q, r);
      shell.integrals.add(p, q, r);
    }
    const auto largest = std::max_element(shells.begin(), shells.end(), [](const auto& a, const auto& b) {
      return a.second.angle < b.second.angle;
    });
    // A shell with negative volume bounds a cavity, not a piece.
    for (const auto& [component, shell] : shells)
      if (component != largest->first && shell.integrals.volume() > 0) m_foreign.push_back(component);
  }

  const RestrictedVoronoi& m_diagram;
  std::vector<Triangle> m_triangles;
  Components m_components;
  std::vector<std::uint32_t> m_foreign;  // components
};

}  // namespace

SitePieces findSitePieces(const RestrictedVoronoi& diagram) {
  const std::size_t triangles = diagram.caps.triangles.size();
  SitePieces pieces{std::vector<std::uint32_t>(diagram.surface.polygons.size(), 0),
                    std::vector<std::uint32_t>(triangles, 0),
                    std::vector<std::uint32_t>(triangles, 0),
                    {}};
  CellPieces cellPieces(diagram);
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    if (diagram.polygonsOf.of(cell).empty()) continue;  // whole convex cells are of one piece
    const std::size_t count = cellPieces.count(cell);
    if (count == 0) continue;
    const auto before = std::uint32_t(pieces.foreign.size());
    const auto pieceOf = [&cellPieces, before](const Triangle& triangle) {
      const std::uint32_t piece = cellPieces.pieceOf(triangle);
      return piece == 0 ? 0 : piece + before;
    };
    pieces.foreign.insert(pieces.foreign.end(), count, cell);
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
