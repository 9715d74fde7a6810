// Last part of the restricted Voronoi diagram: the faces between cells, each built once for both.
#pragma once

#include <vector>

#include "cook/surface_pass.h"
#include "cook/voronoi_edges.h"

namespace rubble::cooking {

/// The part of the face between two cells that lies inside the solid.
struct Cap {
  std::uint32_t first;  ///< site, first < second
  std::uint32_t second;
  std::uint32_t firstTriangle;  ///< into Caps::triangles
  std::uint32_t triangleCount;
  bool isFlat = true;  ///< lies on the bisector of the two sites
};

struct Caps {
  std::vector<Cap> caps;  ///< sorted by (first, second)
  /// Pool vertices; their normal points from first to second.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Caps buildCaps(const VoronoiDiagram& diagram, const SurfacePieces& pieces,
               const std::vector<InsideStretch>& stretches, const VertexPool& pool);

}  // namespace rubble::cooking
