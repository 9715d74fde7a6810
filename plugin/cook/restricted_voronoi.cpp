#include "cook/restricted_voronoi.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "cook/adoption.h"
#include "cook/contradiction.h"
#include "cook/polyhedron.h"
#include "cook/random.h"
#include "cook/voronoi_diagram.h"
#include "cook/voronoi_edges.h"

namespace rubble::cooking {
namespace {

constexpr int kAttempts = 6;
constexpr double kVolumeTolerance = 1e-9;  // relative; measured errors are below 1e-13

std::vector<Eigen::Vector3d> jittered(std::span<const Eigen::Vector3d> sites, double jitter,
                                      std::uint64_t seed) {
  std::vector<Eigen::Vector3d> moved(sites.begin(), sites.end());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    Random random(mix(seed) ^ i);
    for (int axis = 0; axis < 3; ++axis) moved[i][axis] += jitter * (2 * random.uniform() - 1);
  }
  return moved;
}

// visitItems calls its argument with (cell, item), always in the same order.
template <class VisitItems>
CellLists cellLists(std::size_t cells, VisitItems&& visitItems) {
  CellLists lists;
  lists.start.assign(cells + 1, 0);
  visitItems([&](std::uint32_t cell, std::uint32_t) { ++lists.start[cell + 1]; });
  for (std::size_t i = 0; i < cells; ++i) lists.start[i + 1] += lists.start[i];
  lists.items.resize(lists.start.back());
  std::vector<std::uint32_t> at(lists.start.begin(), lists.start.end() - 1);
  visitItems([&](std::uint32_t cell, std::uint32_t item) { lists.items[at[cell]++] = item; });
  return lists;
}

RestrictedVoronoi cut(const CheckedMesh& mesh, std::vector<Eigen::Vector3d> sites) {
  const VoronoiDiagram diagram = voronoiDiagram(sites, mesh.bounds.center(), mesh.diagonal());
  RestrictedVoronoi result;
  VertexPool pool(mesh, diagram);
  result.surface = cutSurface(mesh, diagram, pool);
  const std::vector<InsideStretch> stretches = insideStretches(diagram, result.surface, pool);
  result.surface.hits = std::vector<SurfacePieces::Hit>();  // `= {}` would keep the memory
  result.caps = buildCaps(diagram, result.surface, stretches, pool);
  result.surface.cuts = std::vector<SurfacePieces::Cut>();
  result.sites = std::move(sites);
  result.vertices = pool.takePositions();
  result.vertexSites = pool.takeSites();
  result.listItems();
  return result;
}

// Every directed edge of every cell must have exactly one opposite.
void checkClosed(const RestrictedVoronoi& diagram) {
  // Smaller vertex, larger vertex, then direction, in one number (vertices count to
  // less than 2^31): opposites end up side by side.
  std::vector<std::uint64_t> edges;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    edges.clear();
    const auto add = [&edges](std::uint64_t a, std::uint64_t b) {
      edges.push_back((std::min(a, b) << 33) | (std::max(a, b) << 1) | (a < b ? 0u : 1u));
    };
    diagram.visitCell(cell, [&add](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      add(a, b);
      add(b, c);
      add(c, a);
    });
    std::sort(edges.begin(), edges.end());
    if (edges.empty()) throw Contradiction("a cell is empty");
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const bool isSecond = e % 2 != 0;
      if ((edges[e] % 2 != 0) != isSecond) throw Contradiction("a cell is not closed");
      if (isSecond && edges[e] / 2 != edges[e - 1] / 2) throw Contradiction("a cell is not closed");
    }
    if (edges.size() % 2 != 0) throw Contradiction("a cell is not closed");
  }
}

void checkVolume(const RestrictedVoronoi& diagram, double expected) {
  double sum = 0;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    PolyhedronIntegrals integrals(diagram.sites[cell]);
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      integrals.add(diagram.vertices[a], diagram.vertices[b], diagram.vertices[c]);
    });
    if (!(integrals.volume() > 0)) throw Contradiction("a cell has no volume");
    sum += integrals.volume();
  }
  if (!(std::abs(sum - expected) <= kVolumeTolerance * expected))
    throw Contradiction("the volumes of the cells do not add up to the solid's");
}

}  // namespace

void RestrictedVoronoi::listItems() {
  polygonsOf = cellLists(cellCount(), [&](auto&& add) {
    for (std::uint32_t p = 0; p < surface.polygons.size(); ++p) add(surface.polygons[p].site, p);
  });
  capsOf = cellLists(cellCount(), [&](auto&& add) {
    for (std::uint32_t c = 0; c < caps.caps.size(); ++c) {
      add(caps.caps[c].first, c);
      add(caps.caps[c].second, c);
    }
  });
}

RestrictedVoronoi restrictedVoronoi(const CheckedMesh& mesh, std::span<const Eigen::Vector3d> sites,
                                    double jitter, std::uint64_t seed, const LogFunction& log) {
  assert(!sites.empty() && jitter > 0);
  std::string reason;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      RestrictedVoronoi result = cut(mesh, jittered(sites, jitter, seed + std::uint64_t(attempt)));
      checkClosed(result);
      checkVolume(result, mesh.volume);
      if (adoptPieces(result)) checkClosed(result);
      return result;
    } catch (const Contradiction& contradiction) {
      reason = contradiction.what();
      if (log) log(LogLevel::Info, "cook: cutting the cells again, with another jitter: " + reason);
    }
  }
  throw NotCut("mesh: cannot be cut into cells (" + reason + "): it probably passes through itself; " +
               "allowed are closed surfaces that do not");
}

}  // namespace rubble::cooking
