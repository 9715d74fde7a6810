// The Voronoi diagram of the sites as plain arrays, sorted so that nothing depends on the order of the
// tetrahedra.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rubble::cooking {

/// Where the cells of sites i < j < k meet; dual of a Delaunay triangle.
struct VoronoiEdge {
  std::array<std::uint32_t, 3> sites;  ///< i < j < k
  /// Voronoi vertices, ordered such that (to - from) . ((s_j - s_i) x (s_k - s_i)) > 0: seen against that
  /// direction, the cells i, j, k stand counter-clockwise.
  std::uint32_t from, to;
};

struct VoronoiDiagram {
  std::uint32_t siteCount = 0;          ///< real sites; points[siteCount...] are far sentinels
  std::vector<Eigen::Vector3d> points;  ///< sites, then sentinels [m]
  /// Dual tetrahedron of each Voronoi vertex, its sites in ascending order.
  std::vector<std::array<std::uint32_t, 4>> vertices;
  std::vector<VoronoiEdge> edges;             ///< between real sites only, sorted by sites
  std::vector<std::uint32_t> neighbourStart;  ///< (siteCount + 1)
  std::vector<std::uint32_t> neighbourList;   ///< real Delaunay neighbours of each site, ascending

  std::span<const std::uint32_t> neighbours(std::uint32_t site) const {
    return std::span(neighbourList)
        .subspan(neighbourStart[site], neighbourStart[site + 1] - neighbourStart[site]);
  }

  /// The circumcentre of the dual tetrahedron [m].
  Eigen::Vector3d vertexPosition(std::uint32_t vertex) const;
  /// Whether a sentinel takes part in the vertex; such vertices lie far outside of the solid.
  bool isFar(std::uint32_t vertex) const { return vertices[vertex][3] >= siteCount; }
  /// The real site nearest to the place: walks over neighbours from `start`, which a Delaunay graph never
  /// leads astray.
  std::uint32_t nearestSite(const Eigen::Vector3d& place, std::uint32_t start) const;
};

/// `centre` and `diagonal` are those of the solid that holds the sites.
VoronoiDiagram voronoiDiagram(std::span<const Eigen::Vector3d> sites, const Eigen::Vector3d& centre,
                              double diagonal);

}  // namespace rubble::cooking
