// The cook: what becomes of the wall of the paper's figure 6 at three sizes of elements, and how long the
// stages take for other solids.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "base/hash.h"
#include "bench/asset_counts.h"
#include "bench/asset_hash.h"
#include "bench/processor_time.h"
#include "bench/topic.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

struct Row {
  const char* name;
  SurfaceMesh (*mesh)();
  double radius;  // of the elements [m]; 0: by `fill`
};

constexpr double kFill = 0.48;
constexpr Row kWalls[] = {{"wall, r = 0.016", wallMesh, 0.016},
                          {"wall, r = 0.017", wallMesh, 0.017},
                          {"wall, fill 0.48", wallMesh, 0}};
constexpr Row kSolids[] = {{"wall", wallMesh, 0},
                           {"L of three cubes", ell, 0},
                           {"ring", [] { return torus(1, 0.3, 64, 32); }, 0},
                           {"fine ring", [] { return torus(1, 0.3, 256, 128); }, 0},
                           {"fine ball", [] { return ball(1, 128); }, 0},
                           {"tilted plate of strips", [] { return tilted(plateOfStrips(128)); }, 0},
                           {"tilted thin shell", [] { return tilted(shell()); }, 0}};

CookOptions optionsOf(const Row& row) {
  CookOptions options = wallOptions();
  options.radius = row.radius;
  options.fill = kFill;
  options.anchorDirection.reset();
  return options;
}

// Of a list that hardly ever is empty: 0 then.
double meanOrNone(const std::vector<double>& values) {
  return values.empty() ? 0 : meanOf(values);
}

void countPacking(const Asset& asset, benchmark::UserCounters& counters) {
  const double diameter = 2 * asset.radius;
  const double ball = std::numbers::pi / 6 * diameter * diameter * diameter;
  counters["filled"] = double(asset.elementCount()) * ball / asset.volume();
  counters["spacing"] = asset.spacing() / diameter;
  std::vector<double> nearest(asset.elementCount(), HUGE_VAL), overlaps;
  for (std::size_t a = 0; a < asset.elementCount(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double distance = (asset.positions[a] - asset.positions[b]).norm() / diameter;
      nearest[a] = std::min(nearest[a], distance);
      nearest[b] = std::min(nearest[b], distance);
      if (distance < 1) overlaps.push_back(100 * (1 - distance));
    }
  }
  counters["nearest"] = meanOf(nearest);
  counters["nearest least"] = leastOf(nearest);
  counters["overlap"] = meanOrNone(overlaps);
}

// The stages are those that the cook names to its progress function.
class StageClock {
 public:
  void enter(const char* stage) {
    const double now = processorTime();
    if (!m_stage.empty()) m_seconds[m_stage] += now - m_since;
    m_stage = stage;
    m_since = now;
  }
  void count(benchmark::State& state) const {
    for (const auto& [stage, seconds] : m_seconds)
      state.counters[stage] = seconds / double(state.iterations());
  }

 private:
  std::map<std::string, double> m_seconds;
  std::string m_stage;
  double m_since = 0;
};

void cookOne(benchmark::State& state, const Row& row) {
  const SurfaceMesh mesh = row.mesh();
  StageClock clock;
  Asset asset;
  for (auto _ : state) {
    static_cast<void>(_);
    asset = cook(mesh, optionsOf(row), [&clock](double, const char* stage) { clock.enter(stage); });
  }
  clock.count(state);
  state.counters["mesh"] = double(mesh.triangles.size());
  countPacking(asset, state.counters);
  countCells(asset, state.counters);
}

void addRows(const std::string& topic, std::span<const Row> rows) {
  for (const Row& row : rows) {
    benchmark::RegisterBenchmark((topic + "/" + row.name).c_str(), [row](benchmark::State& state) {
      cookOne(state, row);
    })->Unit(benchmark::kMillisecond);
  }
}

void addWalls() {
  addRows("cook", kWalls);
}

void addSolids() {
  addRows("cook_stages", kSolids);
}

void addInput(base::Fnv1a& sum, const Row& row) {
  const std::string name = row.name;
  sum.add(std::as_bytes(std::span(name)));
  sum.add(row.radius);
}

std::uint64_t hashWalls() {
  base::Fnv1a sum;
  sum.add(kFill);
  for (const Row& row : kWalls) {
    addInput(sum, row);
    addAsset(sum, cook(row.mesh(), optionsOf(row)));
  }
  return sum.value();
}

// Vertices on a grid of a micrometre: what library functions round, the last bit, does not show.
SurfaceMesh onGrid(SurfaceMesh mesh) {
  constexpr double kSteps = 1 << 20;  // a metre
  for (Eigen::Vector3d& vertex : mesh.vertices)
    for (double& x : vertex) x = std::round(x * kSteps) / kSteps;
  return mesh;
}

// The solids, and what they are cooked to; to fewer elements, and the fine ones not, as they take seconds in
// a build without optimisation.
std::uint64_t hashSolids() {
  constexpr std::size_t kFew = 64, kFine = 10000;
  base::Fnv1a sum;
  sum.add(kFill);
  for (const Row& row : kSolids) {
    addInput(sum, row);
    const SurfaceMesh mesh = onGrid(row.mesh());
    for (const Eigen::Vector3d& vertex : mesh.vertices) sum.addAll(vertex);
    sum.add(std::as_bytes(std::span(mesh.triangles)));
    CookOptions options = optionsOf(row);
    sum.add(options.elements);
    options.elements = kFew;
    if (mesh.triangles.size() < kFine) addAsset(sum, cook(mesh, options));
  }
  return sum.value();
}

}  // namespace

BenchTopic cookTopic() {
  using Kind = BenchColumn::Kind;
  return {"cook",
          {{"time of the whole cook", Kind::Time, ""},
           {"share of the solid that the spheres fill", Kind::Counter, "filled"},
           {"mean spacing h / 2r", Kind::Counter, "spacing"},
           {"nearest neighbour / 2r, mean", Kind::Counter, "nearest"},
           {"nearest neighbour / 2r, least", Kind::Counter, "nearest least"},
           {"overlap of the pairs that overlap, mean, %", Kind::Counter, "overlap"},
           {"cells at the surface, %", Kind::Counter, "surface cells"},
           {"cell volume over its mean: standard deviation", Kind::Counter, "volume deviation"},
           {"the least", Kind::Counter, "volume least"},
           {"the most", Kind::Counter, "volume most"},
           {"springs at an element", Kind::Counter, "springs"},
           {"faces a cell", Kind::Counter, "faces"},
           {"triangles a cell", Kind::Counter, "triangles"}},
          true,
          addWalls,
          hashWalls};
}

BenchTopic cookStagesTopic() {
  using Kind = BenchColumn::Kind;
  return {"cook_stages",
          {{"triangles of the mesh", Kind::Count, "mesh"},
           {"checking the mesh", Kind::Seconds, "checking the mesh"},
           {"packing", Kind::Seconds, "packing"},
           {"cutting cells", Kind::Seconds, "cutting cells"},
           {"building meshes", Kind::Seconds, "building meshes"},
           {"springs at an element", Kind::Counter, "springs"},
           {"triangles a cell", Kind::Counter, "triangles"}},
          false,
          addSolids,
          hashSolids};
}

}  // namespace rubble::test
