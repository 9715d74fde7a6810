// Peak memory and time of cooks of the wall, from a thousand elements to a hundred thousand.
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "base/hash.h"
#include "bench/asset_hash.h"
#include "bench/topic.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

constexpr std::size_t kCounts[] = {1000, 2000, 5000, 10000, 20000, 50000, 100000};

// What a process of its own took: the peak of this one never falls.
struct Taken {
  double seconds = 0;    // of processor
  double megabytes = 0;  // at the peak, beyond what it began with
};

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024 / 1e6;  // told in KiB
}

double secondsSoFar() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

Taken cookHere(std::size_t count) {
  const double megabytes = peakMegabytes(), seconds = secondsSoFar();
  const Asset asset = cook(wallMesh(), optionsFor(count));
  return {secondsSoFar() - seconds, peakMegabytes() - megabytes};
}

Taken cookInAChild(std::size_t count) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    const Taken taken = cookHere(count);
    const bool isTold = write(ends[1], &taken, sizeof taken) == ssize_t(sizeof taken);
    _exit(isTold ? 0 : 1);
  }
  close(ends[1]);
  Taken taken;
  const bool isTold = read(ends[0], &taken, sizeof taken) == ssize_t(sizeof taken);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!isTold || status != 0) throw std::runtime_error("the cook in a process of its own failed");
  return taken;
}

void measure(benchmark::State& state, std::size_t count) {
  Taken taken;
  for (auto _ : state) {
    static_cast<void>(_);
    taken = cookInAChild(count);
  }
  state.counters["seconds"] = taken.seconds;
  state.counters["each"] = taken.seconds / double(count);
  state.counters["megabytes"] = taken.megabytes;
  state.counters["kilobytes each"] = 1000 * taken.megabytes / double(count);
}

void add() {
  for (const std::size_t count : kCounts)
    benchmark::RegisterBenchmark(("cook_memory/" + std::to_string(count)).c_str(),
                                 [count](benchmark::State& state) { measure(state, count); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
}

// The cook of few: the memory of many follows from the same code.
std::uint64_t hash() {
  constexpr std::size_t kFew = 256;
  base::Fnv1a sum;
  for (const std::size_t count : kCounts) sum.add(count);
  addAsset(sum, cook(wallMesh(), optionsFor(kFew)));
  return sum.value();
}

}  // namespace

BenchTopic cookMemoryTopic() {
  using Kind = BenchColumn::Kind;
  return {"cook_memory",
          {{"time", Kind::Seconds, "seconds"},
           {"time an element", Kind::Seconds, "each"},
           {"peak memory, MB", Kind::Counter, "megabytes"},
           {"peak memory an element, kB", Kind::Counter, "kilobytes each"}},
          false,
          add,
          hash};
}

}  // namespace rubble::test
