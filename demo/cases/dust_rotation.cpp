// A bell of dust, and one of the air's own velocity, are carried once around by air that turns as a solid
// body. The turning is written anew before each step: only what carries is at work.
#include "demo/cases/case_timer.h"
#include "demo/cases/cases.h"
#include "demo/cases/dust_case.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace dust_rotation {
namespace {

using namespace dust_case;
using Eigen::Vector3d;

constexpr double kEdge = 2;      // of the grid [m]
constexpr double kSeconds = 1;   // of a turn, about y
constexpr double kAway = 0.45;   // of the bell's middle from the axis [m]
constexpr double kWidth = 0.15;  // of the bell, to 1 / e [m]
constexpr double kBump = 1e-3;   // of the air's velocity along y [m/s]

double bell(const Vector3d& at) {
  return std::exp(-(at - Vector3d(kAway, 0, 0)).squaredNorm() / (kWidth * kWidth));
}

Vector3d turning(const Vector3d& at) {
  return kTurn / kSeconds * Vector3d::UnitY().cross(at);
}

// The component along its axis of a face: the same all along it.
std::vector<float> turningFaces(const dust::Lattice& lattice) {
  std::vector<float> faces(3 * lattice.facesOfAxis());
  const Vector3d cell = lattice.cell.cast<double>();
  forCells(lattice, [&](std::size_t i, const Vector3d& at) {
    const int x = int(i) % lattice.n, y = int(i) / lattice.n % lattice.n,
              z = int(i) / (lattice.n * lattice.n);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Vector3d middle = at;
        middle[axis] += (side - 0.5) * cell[axis];
        const auto next = [&](int a) { return a == axis ? side : 0; };
        faces[lattice.face(axis, x + next(0), y + next(1), z + next(2))] = float(turning(middle)[axis]);
      }
  });
  return faces;
}

CaseOutcome runDust(int resolution, int rate) {
  const dust::Lattice lattice(cube(resolution, kEdge));
  dust::CpuDust grid(cube(resolution, kEdge));
  std::vector<float> before(lattice.cells()), after;
  forCells(lattice, [&](std::size_t i, const Vector3d& at) { before[i] = float(bell(at)); });
  grid.write(dust::Field::Density, before);
  const std::vector<float> faces = turningFaces(lattice);
  CaseTimer timer;
  for (int tick = 0; tick < int(std::lround(kSeconds * rate)); ++tick) {
    grid.write(dust::Field::Faces, faces);
    timer.time(1.0 / rate, [&] { grid.transportDust(1 / float(rate)); });
  }
  grid.readDensity(after);
  return timer.outcome(relativeError(after, before));
}

CaseOutcome runAir(int resolution, int rate) {
  const dust::Lattice lattice(cube(resolution, kEdge));
  dust::CpuDust grid(cube(resolution, kEdge));
  std::vector<float> before(lattice.cells()), after(lattice.cells()), velocity;
  setVelocity(grid, lattice,
              [](const Vector3d& at) { return Vector3d(turning(at) + Vector3d(0, kBump * bell(at), 0)); });
  grid.read(dust::Field::Velocity, velocity);
  std::vector<float> turned = velocity;
  CaseTimer timer;
  for (int tick = 0; tick < int(std::lround(kSeconds * rate)); ++tick) {
    for (std::size_t i = 0; i < lattice.cells(); ++i) {
      velocity[4 * i] = turned[4 * i];
      velocity[4 * i + 2] = turned[4 * i + 2];
    }
    grid.write(dust::Field::Velocity, velocity);
    timer.time(1.0 / rate, [&] { grid.advectVelocity(1 / float(rate)); });
    grid.read(dust::Field::Velocity, velocity);
  }
  for (std::size_t i = 0; i < lattice.cells(); ++i) {
    before[i] = turned[4 * i + 1];
    after[i] = velocity[4 * i + 1];
  }
  return timer.outcome(relativeError(after, before));
}

}  // namespace
}  // namespace dust_rotation

ReportCase dustRotationCase() {
  using namespace dust_rotation;
  ReportCase c{.name = "dust_rotation",
               .what =
                   "A bell of 0.15 m, 0.45 m from the axis, is carried once around by air that turns as a "
                   "solid body, in a grid of 2 m",
               .closedForm = "the bell as it was",
               .error = "root mean square of the difference / of the bell",
               .runs = {},
               .note =
                   "A turn takes 1 s; dust moves by limited fluxes, the air's own velocity by MacCormack's "
                   "step; of the stage alone"};
  for (const bool isDust : {true, false})
    for (const int rate : {60, 240})
      for (const int resolution : {16, 32, 64})
        c.runs.push_back({(isDust ? "dust, " : "air, ") + std::to_string(rate) + " Hz",
                          std::to_string(resolution) + "^3 cells",
                          rate == 60 && resolution == DustGridDef{}.resolution,
                          resolution <= 32 || rate == 60,
                          [=] { return isDust ? runDust(resolution, rate) : runAir(resolution, rate); }});
  return c;
}

}  // namespace rubble::demo
