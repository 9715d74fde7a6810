// A ball of laden air, let go. At first it takes as much air along as half of it weighs: the added mass of a
// sphere.
#include "demo/cases/case_timer.h"
#include "demo/cases/cases.h"
#include "demo/cases/dust_case.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace dust_plume {
namespace {

using namespace dust_case;
using Eigen::Vector3d;

constexpr double kEdge = 2, kRadius = 0.2;  // of the grid, of the ball [m]
constexpr double kLoad = 0.05;              // dust / air
constexpr double kGravity = 9.81;           // [m/s^2]
constexpr double kRate = 60;                // as which the step is counted [Hz]
constexpr float kStep = 1e-3f;              // it sinks by a fraction of a millimetre [s]

// Share of a cell in the ball; of 8^3 points where its surface passes.
double shareOf(const Vector3d& centre, const Vector3d& cell) {
  constexpr int kPoints = 8;
  const double depth = kRadius - centre.norm();
  if (std::abs(depth) > cell.norm() / 2) return depth > 0 ? 1 : 0;
  int inside = 0;
  for (int z = 0; z < kPoints; ++z)
    for (int y = 0; y < kPoints; ++y)
      for (int x = 0; x < kPoints; ++x) {
        const Vector3d part =
            (Vector3d(x, y, z) + Vector3d::Constant(0.5)) / kPoints - Vector3d::Constant(0.5);
        inside += (centre + part.cwiseProduct(cell)).norm() < kRadius;
      }
  return double(inside) / (kPoints * kPoints * kPoints);
}

CaseOutcome run(int resolution, int cycles) {
  DustGridDef def = cube(resolution, kEdge);
  def.gravity = float(kGravity);
  def.pressureCycles = cycles;
  const dust::Lattice lattice(def);
  dust::CpuDust grid(def);
  std::vector<float> density(lattice.cells());
  forCells(lattice, [&](std::size_t i, const Vector3d& at) {
    density[i] = float(kLoad * double(def.airDensity) * shareOf(at, lattice.cell.cast<double>()));
  });
  grid.write(dust::Field::Density, density);
  CaseTimer timer;
  timer.time(1 / kRate, [&] { grid.step(kStep, {}, {}); });
  std::vector<Eigen::Vector3f> velocity;
  grid.readVelocity(velocity);
  double momentum = 0, mass = 0;
  for (std::size_t i = 0; i < lattice.cells(); ++i) {
    momentum -= double(density[i]) * double(velocity[i].y());
    mass += double(density[i]);
  }
  const double found = momentum / mass / double(kStep);
  return timer.outcome(std::abs(found / ladenBallAcceleration(kLoad, kGravity) - 1));
}

}  // namespace
}  // namespace dust_plume

double ladenBallAcceleration(double load, double gravity) {
  return load * gravity / 1.5;
}

ReportCase dustPlumeCase() {
  using namespace dust_plume;
  ReportCase c{
      .name = "dust_plume",
      .what = "A ball of 0.2 m of air with 5 % of its weight in dust is let go in a grid of 2 m",
      .closedForm =
          "its first acceleration, 2 / 3 of the load times g: weight over the mass and the added mass of "
          "a sphere, half of the air that it displaces (Lamb, Hydrodynamics, 92)",
      .error = "relative error of the acceleration",
      .runs = {},
      .note = "After a step of 1 ms, counted as one of 60 Hz"};
  const DustGridDef standard;
  for (const int cycles : {1, standard.pressureCycles, 8})
    for (const int resolution : {16, 32, 64, 128})
      c.runs.push_back({std::to_string(cycles) + (cycles == 1 ? " cycle" : " cycles"),
                        std::to_string(resolution) + "^3 cells",
                        resolution == standard.resolution && cycles == standard.pressureCycles,
                        resolution <= 64, [=] { return run(resolution, cycles); }});
  return c;
}

}  // namespace rubble::demo
