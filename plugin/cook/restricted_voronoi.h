// A solid cut into the Voronoi cells of its sites, as closed triangle meshes that share their vertices.
//
// Method: restricted Voronoi diagram of the surface by symbolic clipping, then caps inside [Yan09, Levy10 for
// the idea]: the surface pass cuts every triangle, the cuts tell where Voronoi edges enter and leave the
// solid, and each face between two cells is chained together from what lies inside. Every vertex is known by
// what meets there, so there is no tolerance and no T-junction. Cutting each cell with exact mesh booleans
// was 15 to 400 times slower, and neighbours shared no vertices.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cook/caps.h"
#include "cook/checked_mesh.h"
#include "cook/surface_pass.h"
#include "cook/surface_samples.h"
#include "rubble/error.h"

namespace rubble::cooking {

/// Items of each cell: those of cell i are items[start[i]] to items[start[i + 1]].
struct CellLists {
  std::vector<std::uint32_t> start;
  std::vector<std::uint32_t> items;

  std::span<const std::uint32_t> of(std::uint32_t cell) const {
    return std::span(items).subspan(start[cell], start[cell + 1] - start[cell]);
  }
};

struct RestrictedVoronoi {
  std::vector<Eigen::Vector3d> sites;     ///< jittered [m]
  std::vector<Eigen::Vector3d> vertices;  ///< [m]
  /// Of the cells that meet there; kNoElement behind them.
  std::vector<std::array<std::uint32_t, 4>> vertexSites;
  SurfacePieces surface;
  Caps caps;
  CellLists polygonsOf;  ///< into surface.polygons
  CellLists capsOf;      ///< into caps.caps
  /// Places all over the surface of each connected part of the solid that holds no site.
  std::vector<std::vector<SurfacePlace>> emptyParts;

  std::size_t cellCount() const { return sites.size(); }

  /// Calls visit(a, b, c) for the triangles of a polygon, counter-clockwise seen from outside.
  template <class Visit>
  void visitPolygon(const SurfacePolygon& polygon, Visit&& visit) const {
    const std::uint32_t* v = surface.vertices.data() + polygon.first;
    for (std::uint32_t k = 2; k < polygon.count; ++k) visit(v[0], v[k - 1], v[k]);
  }
  /// The same for a cap, seen from outside of `cell`, one of its two.
  template <class Visit>
  void visitCap(const Cap& cap, std::uint32_t cell, Visit&& visit) const {
    for (std::uint32_t t = cap.firstTriangle; t < cap.firstTriangle + cap.triangleCount; ++t) {
      const auto& [a, b, c] = caps.triangles[t];
      if (cell == cap.first) {
        visit(a, b, c);
      } else {
        visit(a, c, b);
      }
    }
  }
  /// Makes the lists of the cells' items anew.
  void listItems();

  template <class Visit>
  void visitCell(std::uint32_t cell, Visit&& visit) const {
    for (const std::uint32_t p : polygonsOf.of(cell)) visitPolygon(surface.polygons[p], visit);
    for (const std::uint32_t c : capsOf.of(cell)) visitCap(caps.caps[c], cell, visit);
  }
};

/// Cuts the solid. The sites are moved by about `jitter` metres first, by a hash of `seed` and their index:
/// lattices and other symmetric places have cells that meet in more than four, which symbols cannot tell
/// apart. Checks that every cell is closed and that their volumes add up to the solid's; tries other jitters,
/// and throws rubble::Error when none helps.
RestrictedVoronoi restrictedVoronoi(const CheckedMesh& mesh, std::span<const Eigen::Vector3d> sites,
                                    double jitter, std::uint64_t seed, const LogFunction& log);

}  // namespace rubble::cooking
