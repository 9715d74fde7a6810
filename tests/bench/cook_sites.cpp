// Our packing beside a cubic lattice, a face-centred one and Lloyd's places, all cut by the same code.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "base/hash.h"
#include "bench/asset_counts.h"
#include "bench/asset_hash.h"
#include "bench/crack_path.h"
#include "bench/processor_time.h"
#include "bench/site_sets.h"
#include "bench/topic.h"
#include "cook/cell_meshes.h"
#include "cook/polyhedron.h"
#include "cook/site_pieces.h"
#include "cook/springs.h"
#include "cook/surface_look.h"
#include "unit/cook/packed.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

using cooking::CheckedMesh;

constexpr std::size_t kElements = 2048;
constexpr int kLloyd = 50;
constexpr double kJitter = 1e-6;  // [h]
constexpr double kBand = 3;       // in which a crack may run, to either side [h]
constexpr int kCracks = 12;       // directions in the plane of the solid, 15 degrees apart

Sites packedSites(const CheckedMesh& solid, std::size_t count) {
  return cooking::Packer(solid, optionsFor(count), [](double) {}).fill().centres;
}
Sites lloydSitesOf(const CheckedMesh& solid, std::size_t count) {
  return lloydSites(solid, count, kLloyd);
}

struct Solid {
  const char* name;
  SurfaceMesh (*mesh)();
};
constexpr Solid kSolids[] = {{"wall", wallMesh}, {"ring", [] { return torus(1, 0.3, 64, 32); }}};

struct Way {
  const char* name;
  Sites (*sites)(const CheckedMesh&, std::size_t);
};
constexpr Way kWays[] = {{"ours", packedSites},
                         {"cubic lattice", cubicSites},
                         {"face-centred lattice", faceCentredSites},
                         {"Lloyd", lloydSitesOf}};

// As cook() does after the packing, without moving the elements.
Asset cutAt(const SurfaceMesh& mesh, const CheckedMesh& solid, const Sites& sites) {
  Asset asset;
  asset.positions = sites;
  const double spacing = std::cbrt(solid.volume / double(sites.size()));
  asset.radius = spacing / 2;
  const cooking::RestrictedVoronoi diagram =
      cooking::restrictedVoronoi(solid, sites, kJitter * spacing, 1, {});
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    cooking::PolyhedronIntegrals integrals(diagram.sites[cell]);
    diagram.visitCell(cell, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      integrals.add(diagram.vertices[a], diagram.vertices[b], diagram.vertices[c]);
    });
    asset.volumes.push_back(integrals.volume());
    asset.gyrations.push_back(integrals.gyration());
  }
  asset.springs = cooking::findSprings(diagram, cooking::findSitePieces(diagram),
                                       CookOptions().minFaceArea * spacing * spacing);
  cooking::buildCellMeshes(solid, cooking::SurfaceLook(mesh, solid), diagram, asset);
  return asset;
}

void countPlaces(const Asset& asset, const CheckedMesh& solid, benchmark::UserCounters& counters) {
  const double h = asset.spacing();
  const std::vector<double> nearest = nearestDistances(asset);
  counters["nearest"] = meanOf(nearest) / h;
  counters["nearest least"] = leastOf(nearest) / h;
  countCells(asset, counters);
  counters["one direction"] = 100 * shareOfOneDirection(asset);
  std::vector<double> cracks;
  for (int k = 0; k < kCracks; ++k) {
    const double angle = std::numbers::pi * k / kCracks;
    cracks.push_back(crackRoughness(asset, solid, {std::cos(angle), std::sin(angle), 0}, kBand * h));
  }
  counters["crack least"] = leastOf(cracks);
  counters["crack most"] = *std::max_element(cracks.begin(), cracks.end());
}

void placeAndCut(benchmark::State& state, const Solid& solidDef, const Way& way) {
  const SurfaceMesh mesh = solidDef.mesh();
  const CheckedMesh solid = cooking::checkMesh(mesh);
  double placing = 0, cutting = 0;
  Asset asset;
  for (auto _ : state) {
    static_cast<void>(_);
    Sites sites;
    {
      const ScopeProcessorTime time(placing);
      sites = way.sites(solid, kElements);
    }
    const ScopeProcessorTime time(cutting);
    asset = cutAt(mesh, solid, sites);
  }
  state.counters["placing"] = placing / double(state.iterations());
  state.counters["cutting"] = cutting / double(state.iterations());
  state.counters["elements"] = double(asset.elementCount());
  countPlaces(asset, solid, state.counters);
}

void add() {
  for (const Solid& solid : kSolids)
    for (const Way& way : kWays) {
      const std::string name = std::string("cook_sites/") + solid.name + ", " + way.name;
      benchmark::RegisterBenchmark(name.c_str(), [solid, way](benchmark::State& state) {
        placeAndCut(state, solid, way);
      })->Unit(benchmark::kMillisecond);
    }
}

// Of few elements, and few of Lloyd's iterations, which take seconds in a build without optimisation.
std::uint64_t hash() {
  constexpr std::size_t kFew = 64;
  base::Fnv1a sum;
  for (const std::size_t number : {kElements, std::size_t(kLloyd), std::size_t(kCracks)}) sum.add(number);
  sum.add(kBand);
  const SurfaceMesh mesh = wallMesh();
  const CheckedMesh solid = cooking::checkMesh(mesh);
  for (const Sites& sites : {packedSites(solid, kFew), cubicSites(solid, kFew), faceCentredSites(solid, kFew),
                             lloydSites(solid, kFew, 3)})
    addAsset(sum, cutAt(mesh, solid, sites));
  return sum.value();
}

}  // namespace

BenchTopic cookSitesTopic() {
  using Kind = BenchColumn::Kind;
  return {"cook_sites",
          {{"elements", Kind::Count, "elements"},
           {"time of the places", Kind::Seconds, "placing"},
           {"time of cells and springs", Kind::Seconds, "cutting"},
           {"nearest neighbour / h, mean", Kind::Counter, "nearest"},
           {"nearest neighbour / h, least", Kind::Counter, "nearest least"},
           {"cell volume over its mean: standard deviation", Kind::Counter, "volume deviation"},
           {"the least", Kind::Counter, "volume least"},
           {"the most", Kind::Counter, "volume most"},
           {"springs at an element", Kind::Counter, "springs"},
           {"faces a cell", Kind::Counter, "faces"},
           {"cells at the surface, %", Kind::Counter, "surface cells"},
           {"spring area that faces one direction, %", Kind::Counter, "one direction"},
           {"cheapest crack over a flat one: in the easiest direction", Kind::Counter, "crack least"},
           {"in the hardest", Kind::Counter, "crack most"}},
          true,
          add,
          hash};
}

}  // namespace rubble::test
