// The asset's file: how long the loading of a large one takes, and how much of it is Asset::validate.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/hash.h"
#include "bench/processor_time.h"
#include "bench/topic.h"
#include "support/grid_asset.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

constexpr std::array<int, 3> kCubes = {50, 50, 40};
constexpr std::size_t kElements = 100'000;

Asset cubes() {
  return gridAsset({kCubes, 0.02, Eigen::Vector3d::Zero(), true});
}
Asset cookedCells() {
  CookOptions options = optionsFor(kElements);
  options.anchorDirection = -Eigen::Vector3d::UnitY();
  return cook(boxMesh({1, 1, 1}), options);
}

struct Row {
  const char* name;
  Asset (*make)();
};
constexpr Row kRows[] = {{"asset/100000 cubes", cubes}, {"asset/100000 cooked cells", cookedCells}};

// A file, gone again with it.
class SavedAsset {
 public:
  explicit SavedAsset(const Asset& asset)
      : m_file(std::filesystem::temp_directory_path() /
               ("rubble_bench_asset" + std::to_string(reinterpret_cast<std::uintptr_t>(this)))) {
    save(asset, m_file);
  }
  SavedAsset(const SavedAsset&) = delete;
  SavedAsset& operator=(const SavedAsset&) = delete;
  ~SavedAsset() {
    std::error_code ignored;
    std::filesystem::remove(m_file, ignored);
  }
  const std::filesystem::path& file() const { return m_file; }

 private:
  std::filesystem::path m_file;
};

void loadOne(benchmark::State& state, const Row& row) {
  const Asset made = row.make();
  const SavedAsset saved(made);
  load(saved.file());  // gets memory from a virtual machine's host, which no system at rest pays for
  for (auto _ : state) {
    static_cast<void>(_);
    Asset asset = load(saved.file());
    state.PauseTiming();
    asset = {};
    state.ResumeTiming();
  }
  double validation = 0, all = 0;
  constexpr int kTimes = 5;
  for (int k = 0; k < kTimes; ++k) {
    const ScopeProcessorTime time(validation);
    made.validate();
  }
  for (int k = 0; k < kTimes; ++k) {
    const double start = allProcessorTime();
    const Asset asset = load(saved.file());
    all += allProcessorTime() - start;
  }
  state.counters["validation"] = validation / kTimes;
  state.counters["all"] = all / kTimes;
  state.counters["megabytes"] = 1e-6 * double(std::filesystem::file_size(saved.file()));
  state.counters["triangles"] = double(made.triangles.size()) / double(made.elementCount());
}

void add() {
  for (const Row& row : kRows)
    benchmark::RegisterBenchmark(row.name, [row](benchmark::State& state) {
      loadOne(state, row);
    })->Unit(benchmark::kMillisecond);
}

// The file of a small one, to the last byte.
std::uint64_t hash() {
  base::Fnv1a sum;
  for (const int count : kCubes) sum.add(count);
  sum.add(kElements);
  const SavedAsset saved(gridAsset({{3, 1, 1}, 0.5, Eigen::Vector3d::Zero(), true}));
  const std::string bytes = fileBytes(saved.file());
  sum.add(std::as_bytes(std::span(bytes)));
  return sum.value();
}

}  // namespace

BenchTopic assetTopic() {
  using Kind = BenchColumn::Kind;
  return {"asset",
          {{"loading", Kind::Time, ""},
           {"of it checking the numbers", Kind::Seconds, "validation"},
           {"processor time of all threads", Kind::Seconds, "all"},
           {"file, MB", Kind::Counter, "megabytes"},
           {"triangles a cell", Kind::Counter, "triangles"}},
          false,
          add,
          hash};
}

}  // namespace rubble::test
