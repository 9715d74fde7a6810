// Random air in every cell, of every wavelength: what the pressure's cycles leave of its divergence, with and
// without a ball in the middle.
#include <random>

#include "demo/cases/case_timer.h"
#include "demo/cases/cases.h"
#include "demo/cases/dust_case.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace dust_divergence {
namespace {

using namespace dust_case;

constexpr double kEdge = 2, kBall = 0.4;  // of the grid, radius of the ball [m]
constexpr double kRate = 60;              // of the steps [Hz]
constexpr int kSteps = 3;

double rootMeanSquare(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v) * double(v);
  return std::sqrt(sum / double(values.size()));
}

// Of the faces, in cells of air [1/s].
std::vector<float> divergenceOf(const dust::CpuDust& grid, const dust::Lattice& lattice) {
  std::vector<float> faces, air, divergence(lattice.cells());
  grid.read(dust::Field::Faces, faces);
  grid.read(dust::Field::Air, air);
  for (int z = 0; z < lattice.n; ++z)
    for (int y = 0; y < lattice.n; ++y)
      for (int x = 0; x < lattice.n; ++x) {
        const auto net = [&](int axis, int dx, int dy, int dz) {
          return (faces[lattice.face(axis, x + dx, y + dy, z + dz)] - faces[lattice.face(axis, x, y, z)]) /
                 lattice.cell[axis];
        };
        const std::size_t i = std::size_t(lattice.index(x, y, z));
        divergence[i] = air[i] * (net(0, 1, 0, 0) + net(1, 0, 1, 0) + net(2, 0, 0, 1));
      }
  return divergence;
}

CaseOutcome run(int resolution, int cycles, bool ball) {
  DustGridDef def = cube(resolution, kEdge);
  def.pressureCycles = cycles;
  const dust::Lattice lattice(def);
  dust::CpuDust grid(def);
  if (ball) {
    DustObstacle obstacle;
    obstacle.halfExtents.x() = float(kBall);
    std::vector<dust::SolidCells> solids;
    dust::gatherSolids(lattice, {&obstacle, 1}, solids);
    grid.placeObstacles(solids);
  }
  std::mt19937 random(kCaseSeed);
  const auto next = [&] { return double(random()) / double(std::mt19937::max()) * 2 - 1; };
  CaseTimer timer;
  double left = 0;
  for (int step = 0; step < kSteps; ++step) {
    setVelocity(grid, lattice, [&](const Eigen::Vector3d&) {
      const double x = next(), y = next(), z = next();
      return Eigen::Vector3d(x, y, z);
    });
    std::vector<float> before;
    timer.time(1 / kRate, [&] {
      grid.computeDivergence();
      grid.solvePressure();
      grid.project();
    });
    grid.read(dust::Field::Divergence, before);
    left += rootMeanSquare(divergenceOf(grid, lattice)) / rootMeanSquare(before) / kSteps;
  }
  return timer.outcome(left);
}

}  // namespace
}  // namespace dust_divergence

ReportCase dustDivergenceCase() {
  using namespace dust_divergence;
  ReportCase c{
      .name = "dust_divergence",
      .what = "Air with a random velocity in every cell of a grid of 2 m, alone and around a ball of 0.4 m",
      .closedForm = "no divergence",
      .error = "root mean square of the divergence left / at first",
      .runs = {},
      .note = "Steps of 60 Hz, of the projection alone; the default is 3 cycles"};
  const DustGridDef standard;
  for (const bool ball : {false, true})
    for (const int resolution : {32, 64, 128}) {
      if (resolution == 128 && ball) continue;  // long, and tells the same
      for (const int cycles : {1, 2, 3, 4, 6, 8})
        c.runs.push_back({std::to_string(resolution) + "^3 cells" + (ball ? ", ball" : ""),
                          std::to_string(cycles) + (cycles == 1 ? " cycle" : " cycles"),
                          resolution == standard.resolution && cycles == standard.pressureCycles,
                          resolution < 128, [=] { return run(resolution, cycles, ball); }});
    }
  return c;
}

}  // namespace rubble::demo
