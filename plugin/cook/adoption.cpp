#include "cook/adoption.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/groups.h"
#include "cook/site_pieces.h"

namespace rubble::cooking {
namespace {

constexpr std::uint32_t kOwn = 0;  // the piece that holds the site; others count from 1

class Adoption {
 public:
  explicit Adoption(RestrictedVoronoi& diagram) : m_diagram(diagram), m_pieces(findSitePieces(diagram)) {}

  bool run() {
    if (m_pieces.foreign.empty()) return false;
    measureContacts();
    choose();
    listEmptyParts();
    const std::size_t orphans = keepOrphans();
    if (orphans == m_pieces.foreign.size()) return false;
    rebuild();
    return true;
  }

 private:
  struct Contact {
    std::uint32_t piece;   // foreign
    std::uint32_t cell;    // on the other side, as it was cut,
    std::uint32_t ofThat;  // and which of its pieces
    double area;           // [m^2]
  };

  std::uint32_t ownerOf(std::uint32_t cell, std::uint32_t piece) const {
    return piece == kOwn ? cell : m_owner[piece - 1];
  }

  void measureContacts() {
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, double> areas;
    const auto add = [&areas](std::uint32_t piece, std::uint32_t cell, std::uint32_t ofThat, double area) {
      if (piece != kOwn) areas[{piece, cell, ofThat}] += area;
    };
    for (const Cap& cap : m_diagram.caps.caps)
      for (std::uint32_t t = cap.firstTriangle; t < cap.firstTriangle + cap.triangleCount; ++t) {
        const auto& [a, b, c] = m_diagram.caps.triangles[t];
        const Eigen::Vector3d& origin = m_diagram.vertices[a];
        const double area = (m_diagram.vertices[b] - origin).cross(m_diagram.vertices[c] - origin).norm() / 2;
        add(m_pieces.trianglesFirst[t], cap.second, m_pieces.trianglesSecond[t], area);
        add(m_pieces.trianglesSecond[t], cap.first, m_pieces.trianglesFirst[t], area);
      }
    for (const auto& [key, area] : areas)
      m_contacts.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), area});
  }

  // The largest common face first, in rounds: a piece that touches only pieces without a home waits for
  // theirs.
  void choose() {
    m_owner.assign(m_pieces.foreign.size(), kNoElement);
    for (bool hasChanged = true; hasChanged;) {
      hasChanged = false;
      std::map<std::pair<std::uint32_t, std::uint32_t>, double> offers;  // (piece, cell) -> area
      for (const Contact& contact : m_contacts) {
        const std::uint32_t cell = ownerOf(contact.cell, contact.ofThat);
        if (m_owner[contact.piece - 1] == kNoElement && cell != kNoElement)
          offers[{contact.piece, cell}] += contact.area;
      }
      std::map<std::uint32_t, std::pair<double, std::uint32_t>> best;
      for (const auto& [pair, area] : offers)
        if (std::pair<double, std::uint32_t>& most = best[pair.first]; area > most.first)
          most = {area, pair.second};
      for (const auto& [piece, most] : best) {
        if (!(most.first > 0)) continue;
        m_owner[piece - 1] = most.second;
        hasChanged = true;
      }
    }
  }

  // Pieces without a home that touch are one part of the solid.
  void listEmptyParts() {
    base::Groups parts(m_owner.size());
    for (const Contact& contact : m_contacts)
      if (contact.ofThat != kOwn) parts.join(contact.piece - 1, contact.ofThat - 1);
    std::map<std::uint32_t, std::vector<SurfacePlace>> places;
    for (std::size_t p = 0; p < m_diagram.surface.polygons.size(); ++p) {
      const std::uint32_t piece = m_pieces.polygons[p];
      if (piece == kOwn || m_owner[piece - 1] != kNoElement) continue;
      const SurfacePolygon& polygon = m_diagram.surface.polygons[p];
      m_diagram.visitPolygon(polygon, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        places[parts.of(piece - 1)].push_back(
            {(m_diagram.vertices[a] + m_diagram.vertices[b] + m_diagram.vertices[c]) / 3, polygon.triangle});
      });
    }
    for (auto& [part, list] : places) m_diagram.emptyParts.push_back(std::move(list));
  }

  std::size_t keepOrphans() {
    std::size_t orphans = 0;
    for (std::size_t f = 0; f < m_owner.size(); ++f) {
      if (m_owner[f] != kNoElement) continue;
      m_owner[f] = m_pieces.foreign[f];
      ++orphans;
    }
    return orphans;
  }

  void rebuild() {
    SurfacePieces& surface = m_diagram.surface;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
      SurfacePolygon& polygon = surface.polygons[p];
      if (m_pieces.polygons[p] == kOwn) continue;
      for (std::uint32_t k = 0; k < polygon.count; ++k)
        note(surface.vertices[polygon.first + k], polygon.site, m_pieces.polygons[p]);
      polygon.site = m_owner[m_pieces.polygons[p] - 1];
    }
    rebuildCaps();
    renameVertices();
    dropUnusedVertices();
    m_diagram.listItems();
  }

  // That at this vertex the cell gave its piece away.
  void note(std::uint32_t vertex, std::uint32_t cell, std::uint32_t piece) {
    if (piece != kOwn) m_renamed[{vertex, cell}] = m_owner[piece - 1];
  }

  void rebuildCaps() {
    struct Side {
      std::uint32_t first, second, cap;
      std::array<std::uint32_t, 3> triangle;
      bool isMoved;
    };
    std::vector<Side> sides;
    const std::vector<Cap>& caps = m_diagram.caps.caps;
    for (std::uint32_t c = 0; c < caps.size(); ++c)
      for (std::uint32_t t = caps[c].firstTriangle; t < caps[c].firstTriangle + caps[c].triangleCount; ++t) {
        auto triangle = m_diagram.caps.triangles[t];
        for (const std::uint32_t v : triangle) {
          note(v, caps[c].first, m_pieces.trianglesFirst[t]);
          note(v, caps[c].second, m_pieces.trianglesSecond[t]);
        }
        std::uint32_t first = ownerOf(caps[c].first, m_pieces.trianglesFirst[t]);
        std::uint32_t second = ownerOf(caps[c].second, m_pieces.trianglesSecond[t]);
        if (first == second) continue;
        const bool isMoved = first != caps[c].first || second != caps[c].second;
        if (first > second) {
          std::swap(first, second);
          std::swap(triangle[1], triangle[2]);
        }
        sides.push_back({first, second, c, triangle, isMoved});
      }
    std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
    Caps result;
    for (const Side& side : sides) {
      if (result.caps.empty() || result.caps.back().first != side.first ||
          result.caps.back().second != side.second)
        result.caps.push_back({side.first, side.second, std::uint32_t(result.triangles.size()), 0, true});
      result.triangles.push_back(side.triangle);
      ++result.caps.back().triangleCount;
      result.caps.back().isFlat = result.caps.back().isFlat && !side.isMoved;
    }
    m_diagram.caps = std::move(result);
  }

  void renameVertices() {
    for (const auto& [key, owner] : m_renamed) {
      auto& sites = m_diagram.vertexSites[key.first];
      std::replace(sites.begin(), sites.end(), key.second, owner | kMark);
    }
    for (auto& sites : m_diagram.vertexSites) {
      for (std::uint32_t& site : sites)
        if (site != kNoElement) site &= ~kMark;
      std::sort(sites.begin(), sites.end());
      std::fill(std::unique(sites.begin(), sites.end()), sites.end(), kNoElement);
    }
  }

  // Those that lay on vanished faces alone.
  void dropUnusedVertices() {
    std::vector<std::uint32_t> number(m_diagram.vertices.size(), 0);
    for (const std::uint32_t v : m_diagram.surface.vertices) number[v] = 1;
    for (const auto& triangle : m_diagram.caps.triangles)
      for (const std::uint32_t v : triangle) number[v] = 1;
    std::uint32_t used = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] == 0) continue;
      m_diagram.vertices[used] = m_diagram.vertices[v];
      m_diagram.vertexSites[used] = m_diagram.vertexSites[v];
      number[v] = used++;
    }
    m_diagram.vertices.resize(used);
    m_diagram.vertexSites.resize(used);
    for (std::uint32_t& v : m_diagram.surface.vertices) v = number[v];
    for (auto& triangle : m_diagram.caps.triangles)
      for (std::uint32_t& v : triangle) v = number[v];
  }

  // Of names that were just given, lest they are taken for old ones. Sites count to 1e7.
  static constexpr std::uint32_t kMark = 0x40000000u;

  RestrictedVoronoi& m_diagram;
  const SitePieces m_pieces;
  std::vector<Contact> m_contacts;
  std::vector<std::uint32_t> m_owner;                                          // of each foreign piece
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> m_renamed;  // (vertex, cell) -> cell
};

}  // namespace

bool adoptPieces(RestrictedVoronoi& diagram) {
  return Adoption(diagram).run();
}

}  // namespace rubble::cooking
