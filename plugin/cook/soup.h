// Triangles on their way to a closed surface, each with the one it comes from.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rubble/asset.h"

namespace rubble::cooking {

struct Source {
  std::uint32_t triangle = kNoElement;  ///< of the mesh given; of what closes a hole, one beside it
  bool isPatch = false;                 ///< closes a hole
};

struct Soup {
  std::vector<Eigen::Vector3d> vertices;  ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Source> sources;  ///< one a triangle
};

/// A side of a triangle, from corner `side` to the next.
struct SoupEdge {
  std::uint32_t low, high;  ///< vertices
  std::uint32_t triangle, side;
  bool upward;  ///< runs from low to high
};

/// Sides at the same edge together, in the order of the triangles.
std::vector<SoupEdge> sortedEdges(const Soup& soup);

/// Calls visit(std::span<const SoupEdge>) for each edge with its sides.
template <class Visit>
void forEachEdge(const std::vector<SoupEdge>& edges, Visit&& visit) {
  for (std::size_t at = 0; at < edges.size();) {
    std::size_t end = at + 1;
    while (end < edges.size() && edges[end].low == edges[at].low && edges[end].high == edges[at].high) ++end;
    visit(std::span(edges).subspan(at, end - at));
    at = end;
  }
}

/// Those that have one triangle only.
std::vector<SoupEdge> openEdges(const Soup& soup);

/// Leaves out the triangles for which isSpare[t].
void dropTriangles(Soup& soup, const std::vector<bool>& isSpare);

}  // namespace rubble::cooking
