// The pressure of the dust grid's air: what is left of the right-hand side after each V(1,1) cycle.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/hash.h"
#include "bench/topic.h"
#include "dust/cpu/multigrid.h"
#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

constexpr int kResolution = 64;
constexpr int kMostCycles = 6;
constexpr int kTimedCycles = 3;  // the default of DustGridDef
constexpr double kBall = 0.2;    // radius of the solid, of the cube's edge
const Eigen::Vector3d kBallCentre(0.05, 0.5, -0.1);

// A right-hand side and the air around it.
struct Problem {
  explicit Problem(int resolution)
      : lattice(cube(resolution, 1)), air(lattice.cells(), 1.0f), rhs(lattice.cells()) {}

  Lattice lattice;
  std::vector<float> air, rhs;
  bool anySolid = false;
};

// The Laplacian of sin(pi X) cos(pi Y / 2) sin(pi Z), which is 0 on the open sides and level at the floor.
Problem smoothField(int resolution) {
  Problem problem(resolution);
  constexpr double kPi = std::numbers::pi;
  forCells(problem.lattice, [&](int i, const Eigen::Vector3d& at) {
    problem.rhs[i] = float(-2.25 * kPi * kPi * std::sin(kPi * (at.x() + 0.5)) * std::cos(kPi / 2 * at.y()) *
                           std::sin(kPi * (at.z() + 0.5)));
  });
  return problem;
}

Problem sourceInOneCell(int resolution) {
  Problem problem(resolution);
  problem.rhs[problem.lattice.index(resolution * 2 / 5, resolution / 3, resolution * 3 / 5)] = 1;
  return problem;
}

Problem noise(int resolution) {
  Problem problem(resolution);
  Sequence random;
  for (float& value : problem.rhs) value = random.next();
  return problem;
}

Problem noiseAroundBall(int resolution) {
  Problem problem = noise(resolution);
  problem.anySolid = true;
  forCells(problem.lattice, [&](int i, const Eigen::Vector3d& at) {
    if ((at - kBallCentre).norm() < kBall) problem.air[i] = problem.rhs[i] = 0;
  });
  return problem;
}

std::vector<double> residuals(const Problem& problem) {
  base::ThreadPool pool(1);
  Multigrid solver(problem.lattice);
  solver.setAir(problem.air, problem.anySolid, pool);
  std::vector<double> left;
  for (int cycles = 1; cycles <= kMostCycles; ++cycles) {
    solver.solve(problem.rhs, cycles, pool);
    left.push_back(solver.relativeResidual(problem.rhs));
  }
  return left;
}

struct Row {
  const char* name;
  Problem (*problem)(int resolution);
};
constexpr Row kRows[] = {{"pressure/smooth field", smoothField},
                         {"pressure/source in one cell", sourceInOneCell},
                         {"pressure/noise", noise},
                         {"pressure/noise around a ball", noiseAroundBall}};

void solve(benchmark::State& state, const Problem& problem) {
  base::ThreadPool pool(1);
  Multigrid solver(problem.lattice);
  solver.setAir(problem.air, problem.anySolid, pool);
  for (auto _ : state) {
    static_cast<void>(_);
    solver.solve(problem.rhs, kTimedCycles, pool);
  }
  const std::vector<double> left = residuals(problem);
  for (std::size_t cycle = 0; cycle < left.size(); ++cycle)
    state.counters[std::to_string(cycle + 1)] = left[cycle];
}

void add() {
  for (const Row& row : kRows) {
    benchmark::RegisterBenchmark(row.name, [row](benchmark::State& state) {
      solve(state, row.problem(kResolution));
    })->Unit(benchmark::kMillisecond);
  }
}

// On a smaller grid; that of noise alone, whose right-hand side no library function rounds.
std::uint64_t hash() {
  base::Fnv1a sum;
  for (const int number : {kResolution, kMostCycles, kTimedCycles}) sum.add(number);
  sum.addAll(kBallCentre);
  sum.add(kBall);
  for (const double left : residuals(noiseAroundBall(16))) sum.add(left);
  return sum.value();
}

}  // namespace

BenchTopic pressureTopic() {
  using Kind = BenchColumn::Kind;
  BenchTopic topic{"pressure", {{"three cycles take", Kind::Time, ""}}, false, add, hash};
  for (int cycle = 1; cycle <= kMostCycles; ++cycle)
    topic.columns.push_back({"after " + std::to_string(cycle), Kind::Counter, std::to_string(cycle)});
  return topic;
}

}  // namespace rubble::test
