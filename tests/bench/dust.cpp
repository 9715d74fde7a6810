// The dust grid on one thread of the CPU: a step of a calm plume and of a violent one, stage by stage.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "base/hash.h"
#include "bench/processor_time.h"
#include "bench/topic.h"
#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

constexpr float kSide = 3;           // of the grid's cube [m]
constexpr float kFrame = 1.0f / 60;  // [s]
constexpr int kFramesBefore = 20;    // until the plume is there
constexpr float kCalm = 1.0f / 20;   // of the burst's speeds, so up to 1 m/s along an axis
constexpr float kViolent = 1;        // up to 20 m/s along an axis

struct StageTimes {  // [s]
  double forces = 0, divergence = 0, pressure = 0, project = 0, advect = 0, transport = 0, totals = 0;
};

// The CPU back end with a stopwatch at each stage.
class TimedDust final : public Stages {
 public:
  explicit TimedDust(const DustGridDef& def) : Stages(def), m_grid(def) {}

  void addSources(std::span<const shared::DustSourceCell> sources) override { m_grid.addSources(sources); }
  void addForces(float dt) override {
    const ScopeProcessorTime timer(times.forces);
    m_grid.addForces(dt);
  }
  void placeObstacles(std::span<const SolidCells> solids) override { m_grid.placeObstacles(solids); }
  void computeDivergence() override {
    const ScopeProcessorTime timer(times.divergence);
    m_grid.computeDivergence();
  }
  void solvePressure() override {
    const ScopeProcessorTime timer(times.pressure);
    m_grid.solvePressure();
  }
  void project() override {
    const ScopeProcessorTime timer(times.project);
    m_grid.project();
  }
  void advectVelocity(float dt) override {
    const ScopeProcessorTime timer(times.advect);
    m_grid.advectVelocity(dt);
  }
  void transportDust(float dt) override {
    const ScopeProcessorTime timer(times.transport);
    m_grid.transportDust(dt);
  }
  void sumTotals() override {
    const ScopeProcessorTime timer(times.totals);
    m_grid.sumTotals();
  }
  void read(Field field, std::vector<float>& values) const override { m_grid.read(field, values); }
  void write(Field field, std::span<const float> values) override { m_grid.write(field, values); }
  DustTotals totals() const override { return m_grid.totals(); }
  const char* backend() const override { return m_grid.backend(); }

  StageTimes times;

 private:
  CpuDust m_grid;
};

// What breaks in a frame, at a share of the burst's speeds.
std::vector<DustSource> broken(Sequence& random, float share) {
  std::vector<DustSource> sources = burst(random);
  for (DustSource& source : sources) source.velocity *= share;
  return sources;
}

void step(benchmark::State& state, int resolution, float share) {
  TimedDust grid(cube(resolution, kSide));
  Sequence random;
  for (int frame = 0; frame < kFramesBefore; ++frame) grid.step(kFrame, broken(random, share), {});
  grid.times = {};
  for (auto _ : state) {
    static_cast<void>(_);
    grid.step(kFrame, broken(random, share), {});
  }
  const auto count = [&](const char* name, double seconds) {
    state.counters[name] = seconds / double(state.iterations());
  };
  count("forces", grid.times.forces);
  count("divergence", grid.times.divergence);
  count("pressure", grid.times.pressure);
  count("project", grid.times.project);
  count("advect", grid.times.advect);
  count("transport", grid.times.transport);
  count("totals", grid.times.totals);
}

void addPlume(int resolution, const char* name, float share) {
  const std::string row = "dust/" + std::to_string(resolution) + "^3, " + name;
  benchmark::RegisterBenchmark(row.c_str(), [resolution, share](benchmark::State& state) {
    step(state, resolution, share);
  })->Unit(benchmark::kMillisecond);
}

void add() {
  for (const int resolution : {32, 64}) {
    addPlume(resolution, "calm", kCalm);
    addPlume(resolution, "violent", kViolent);
  }
  addPlume(128, "calm", kCalm);
}

std::uint64_t hash() {
  base::Fnv1a sum;
  for (const float number : {kSide, kFrame, kCalm, kViolent, float(kFramesBefore)}) sum.add(number);
  CpuDust grid(cube(16, kSide));
  Sequence random;
  for (int frame = 0; frame < kFramesBefore; ++frame) grid.step(kFrame, broken(random, kViolent), {});
  std::vector<float> density, velocity;
  grid.read(Field::Density, density);
  grid.read(Field::Velocity, velocity);
  sum.add(std::as_bytes(std::span(density)));
  sum.add(std::as_bytes(std::span(velocity)));
  return sum.value();
}

}  // namespace

BenchTopic dustTopic() {
  using Kind = BenchColumn::Kind;
  BenchTopic topic{"dust", {{"a step", Kind::Time, ""}}, false, add, hash};
  for (const char* stage : {"forces", "divergence", "pressure", "project", "advect", "transport", "totals"})
    topic.columns.push_back({stage, Kind::Seconds, stage});
  return topic;
}

}  // namespace rubble::test
