// Second part of the restricted Voronoi diagram: which stretches of the Voronoi edges lie inside the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "cook/surface_pass.h"

namespace rubble::cooking {

/// A stretch of a Voronoi edge, in the direction of VoronoiEdge::from to ::to.
struct InsideStretch {
  std::uint32_t edge;  ///< into VoronoiDiagram::edges
  std::uint32_t from;  ///< into the pool
  std::uint32_t to;
};

/// No inside test and no tolerance: each hit says whether the edge enters or leaves there, and vertices
/// without hit edges get their state from their neighbours. Throws Contradiction.
std::vector<InsideStretch> insideStretches(const VoronoiDiagram& diagram, const SurfacePieces& pieces,
                                           VertexPool& pool);

}  // namespace rubble::cooking
