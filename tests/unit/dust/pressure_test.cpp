// The pressure solver and the projection: what is left of the divergence.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dust/cpu/multigrid.h"
#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

constexpr double kPi = std::numbers::pi;

// On the unit cube p = sin(pi X) cos(pi Y / 2) sin(pi Z) is 0 on the five open sides and level at the floor;
// its Laplacian is -(2 + 1/4) pi^2 p.
struct Manufactured {
  Lattice lattice;
  std::vector<float> pressure, laplacian;

  explicit Manufactured(int n)
      : lattice(test::cube(n, 1)), pressure(lattice.cells()), laplacian(lattice.cells()) {
    test::forCells(lattice, [&](int i, const Eigen::Vector3d& at) {
      const double p =
          std::sin(kPi * (at.x() + 0.5)) * std::cos(kPi / 2 * at.y()) * std::sin(kPi * (at.z() + 0.5));
      pressure[i] = float(p);
      laplacian[i] = float(-2.25 * kPi * kPi * p);
    });
  }
};

// Root mean square of the difference to the exact pressure.
double errorOf(int n) {
  const Manufactured m(n);
  base::ThreadPool pool(1);
  Multigrid solver(m.lattice);
  solver.setAir(std::vector<float>(m.lattice.cells(), 1.0f), false, pool);
  solver.solve(m.laplacian, 12, pool);
  std::vector<float> difference(m.lattice.cells());
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      const float* row = solver.pressure().row(y, z);
      for (int x = 0; x < n; ++x) {
        const int i = m.lattice.index(x, y, z);
        difference[i] = row[x] - m.pressure[i];
      }
    }
  }
  return test::rms(difference);
}

// Faces of random air at the cells; returns how much of the divergence the step's cycles leave.
double divergenceLeft(CpuDust& grid, const Lattice& lattice) {
  test::Sequence random;
  test::setVelocity(grid, lattice, [&](const Eigen::Vector3d&) {
    return Eigen::Vector3f(random.next(), random.next(), random.next());
  });
  std::vector<float> before, faces;
  grid.computeDivergence();
  grid.read(Field::Divergence, before);
  grid.solvePressure();
  grid.project();
  grid.read(Field::Faces, faces);
  std::vector<float> air, after(lattice.cells());
  grid.read(Field::Air, air);
  for (int z = 0; z < lattice.n; ++z) {
    for (int y = 0; y < lattice.n; ++y) {
      for (int x = 0; x < lattice.n; ++x) {
        const auto net = [&](int axis, int dx, int dy, int dz) {
          return (faces[lattice.face(axis, x + dx, y + dy, z + dz)] - faces[lattice.face(axis, x, y, z)]) /
                 lattice.cell[axis];
        };
        const int i = lattice.index(x, y, z);
        after[i] = air[i] * (net(0, 1, 0, 0) + net(1, 0, 1, 0) + net(2, 0, 0, 1));
      }
    }
  }
  return test::rms(after) / test::rms(before);
}

// A V(1,1) cycle of red-black Gauss-Seidel on this field shrinks the residual by 6 to 8 on any grid; 5 leaves
// room. For comparison, 40 sweeps of Jacobi leave 0.7.
TEST(Pressure, ResidualFallsByFiveACycle) {
  for (const int n : {16, 32, 64}) {
    const Manufactured m(n);
    base::ThreadPool pool(1);
    Multigrid solver(m.lattice);
    solver.setAir(std::vector<float>(m.lattice.cells(), 1.0f), false, pool);
    double last = 1;
    for (int cycles = 1; cycles <= 4; ++cycles) {
      solver.solve(m.laplacian, cycles, pool);
      const double residual = solver.relativeResidual(m.laplacian);
      EXPECT_LT(residual, last / 5) << "n " << n << ", cycle " << cycles;
      last = residual;
    }
  }
}

// A source in one cell has every wavelength in it; the bound is three times the factor of five.
TEST(Pressure, ThreeCyclesLeaveUnderOnePercentOfAPointSource) {
  const Lattice lattice(test::cube(32, 1));
  std::vector<float> source(lattice.cells());
  source[lattice.index(13, 10, 20)] = 1;
  base::ThreadPool pool(1);
  Multigrid solver(lattice);
  solver.setAir(std::vector<float>(lattice.cells(), 1.0f), false, pool);
  solver.solve(source, 3, pool);
  EXPECT_LT(solver.relativeResidual(source), 1.0 / 125);
}

// The seven-point Laplacian is of second order: half the cell, a quarter of the error. The ghosts of the
// open sides keep the order; 3.6 leaves room for the terms of fourth order on 16 cells.
TEST(Pressure, ErrorFallsAsTheSquareOfTheCell) {
  const double coarse = errorOf(16), fine = errorOf(32);
  EXPECT_GT(coarse / fine, 3.6);
  EXPECT_LT(coarse / fine, 4.4);
  EXPECT_LT(fine, 1e-3);
}

// White noise has every wavelength too. Three cycles, three times a factor of five.
TEST(Projection, LeavesUnderOnePercentOfTheDivergenceOfNoise) {
  const DustGridDef def = test::cube(32, 2);
  CpuDust grid(def);
  EXPECT_LT(divergenceLeft(grid, Lattice(def)), 1.0 / 125);
}

// The divergence of the faces is the residual of the solver, but for rounding.
TEST(Projection, LeavesWhatTheSolverLeaves) {
  const DustGridDef def = test::cube(32, 2);
  CpuDust grid(def);
  const double left = divergenceLeft(grid, Lattice(def));
  std::vector<float> divergence;
  grid.read(Field::Divergence, divergence);
  EXPECT_NEAR(left, grid.pressure().relativeResidual(divergence), 1e-5);
}

// A cell that is not a cube (x 2, y 1, z 1) smooths worse along its long side: 10 cycles, the same end.
TEST(Projection, FlatCellsConvergeToo) {
  DustGridDef def = test::cube(32, 2);
  def.max.x() = 3;
  def.pressureCycles = 10;
  CpuDust grid(def);
  EXPECT_LT(divergenceLeft(grid, Lattice(def)), 1e-3);
}

// The coarse levels see solids blurred; with averaged coefficients the rate is to stay.
TEST(Projection, LeavesUnderOnePercentAroundASolid) {
  const DustGridDef def = test::cube(32, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  DustObstacle ball;
  ball.position = Eigen::Vector3f(0.1f, 1, -0.2f);
  ball.halfExtents.x() = 0.4f;
  std::vector<SolidCells> solids;
  gatherSolids(lattice, {&ball, 1}, solids);
  grid.placeObstacles(solids);
  EXPECT_LT(divergenceLeft(grid, lattice), 0.01);
}

}  // namespace
}  // namespace rubble::test
