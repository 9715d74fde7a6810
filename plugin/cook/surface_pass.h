// First half of the restricted Voronoi diagram: every triangle of the surface cut along the cells' borders.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cook/checked_mesh.h"
#include "cook/scratch_map.h"
#include "cook/voronoi_diagram.h"

namespace rubble::cooking {

/// Every vertex of every cell, once. A vertex is known by what meets there and not by where it is, so two
/// cells can never disagree about it:
///   a mesh vertex;  mesh edge x bisector {edge, i, j};  triangle x Voronoi edge {triangle, i, j, k}; Voronoi
///   vertex.
class VertexPool {
 public:
  explicit VertexPool(const CheckedMesh& mesh, const VoronoiDiagram& diagram);

  std::uint32_t meshVertex(std::uint32_t vertex, std::uint32_t site);
  /// Goes on to a triangle, for the vertices on its sides and inside of it; to each triangle once.
  void enter(std::uint32_t triangle);
  std::uint32_t onSide(std::uint32_t side, std::uint32_t siteA, std::uint32_t siteB);
  /// `place` is taken where the vertex is new.
  std::uint32_t onTriangle(std::array<std::uint32_t, 3> sites, const Eigen::Vector3d& place);
  std::uint32_t voronoiVertex(std::uint32_t vertex);

  const std::vector<Eigen::Vector3d>& positions() const { return m_positions; }
  std::vector<Eigen::Vector3d> takePositions() { return std::move(m_positions); }
  /// The sites whose cells meet at each vertex, ascending; kNoElement behind them.
  std::vector<std::array<std::uint32_t, 4>> takeSites() { return std::move(m_sites); }

 private:
  std::uint32_t add(const Eigen::Vector3d& place, const std::array<std::uint32_t, 4>& sites);

  const CheckedMesh& m_mesh;
  const VoronoiDiagram& m_diagram;
  std::vector<Eigen::Vector3d> m_positions;
  std::vector<std::array<std::uint32_t, 4>> m_sites;
  std::vector<std::uint32_t> m_ofMeshVertex;
  std::vector<std::uint32_t> m_ofVoronoiVertex;
  // Only two triangles ask for the vertices of an edge, so those are in a list, and only what may meet on the
  // triangle at hand is in a map, by sites and side.
  std::vector<std::uint32_t> m_lastOnEdge;  // kNoElement: none
  std::vector<std::uint32_t> m_before;      // on the same edge, of each vertex up to the last on any
  std::uint32_t m_triangle = kNoElement;    // at hand
  ScratchMap<3> m_ofSites;
};

/// The part of one triangle that lies in one cell: convex, counter-clockwise seen from outside.
struct SurfacePolygon {
  std::uint32_t triangle;
  std::uint32_t site;
  std::uint32_t first;  ///< into SurfacePieces::vertices and ::sides
  std::uint32_t count;
};

/// What labels an edge of a piece of a triangle: from here on "side s of the triangle"; smaller ones name the
/// site behind the edge.
inline constexpr std::uint32_t kSideLabel = 0xfffffff0u;

/// In SurfacePieces::sides: an edge that is no part of a side of the triangle.
inline constexpr std::uint8_t kCutEdge = 3;

struct SurfacePieces {
  std::vector<SurfacePolygon> polygons;  ///< grouped by triangle
  std::vector<std::uint32_t> vertices;   ///< into the pool
  /// The side of the triangle on which the edge that leaves the vertex lies, or kCutEdge.
  std::vector<std::uint8_t> sides;
  /// Where a Voronoi edge passes the surface.
  struct Hit {
    std::array<std::uint32_t, 3> sites;  ///< ascending
    std::uint32_t vertex;
    bool leaving;  ///< the edge leaves the solid here, followed from VoronoiEdge::from to ::to
  };
  std::vector<Hit> hits;
  /// Where the face between two cells meets the surface: the edge of the first one's polygon.
  struct Cut {
    std::uint32_t first, second;  ///< sites, ascending
    std::uint32_t from, to;       ///< into the pool
  };
  std::vector<Cut> cuts;
};

SurfacePieces cutSurface(const CheckedMesh& mesh, const VoronoiDiagram& diagram, VertexPool& pool);

}  // namespace rubble::cooking
