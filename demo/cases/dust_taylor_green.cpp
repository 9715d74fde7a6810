// A vortex in a closed box of solids: Taylor and Green's in a plane, which stands still in air without
// friction and decays as exp(-2 nu k^2 t) with it. The grid's air has none of its own, so what it loses is
// the scheme's.
#include "demo/cases/case_timer.h"
#include "demo/cases/cases.h"
#include "demo/cases/dust_case.h"
#include "demo/markdown_table.h"

namespace rubble::demo {
namespace dust_taylor_green {
namespace {

using namespace dust_case;
using Eigen::Vector3d;

constexpr double kEdge = 2, kInner = 1;  // of the grid and of the box in it [m]
constexpr double kSpeed = 1;             // greatest [m/s]
constexpr double kSeconds = 0.5;         // a quarter of a turn in the middle of the eddy

const double kWave = kTurn / 2 / kInner;  // one eddy fills the box [1/m]

bool isInside(const Vector3d& at) {
  return at.cwiseAbs().maxCoeff() < kInner / 2;
}

Vector3d vortex(const Vector3d& at) {
  const double x = kWave * at.x(), z = kWave * at.z();
  return kSpeed * Vector3d(-std::cos(x) * std::sin(z), 0, std::sin(x) * std::cos(z));
}

// A slab beyond each side of the box: what is nearer to the grid's sides has a sponge.
std::vector<DustObstacle> walls() {
  std::vector<DustObstacle> boxes;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      DustObstacle box;
      box.kind = DustObstacle::Kind::Box;
      box.halfExtents.setConstant(float(kEdge));
      box.halfExtents[axis] = float(kEdge - kInner) / 2;
      box.position[axis] = side * float(kInner / 2 + (kEdge - kInner) / 2);
      boxes.push_back(box);
    }
  return boxes;
}

enum class Quantity { Velocity, Energy };

struct Stepping {
  int rate;  // [Hz]
  float vorticity;
};

CaseOutcome run(int resolution, const Stepping& stepping, Quantity quantity) {
  DustGridDef def = cube(resolution, kEdge);
  def.vorticity = stepping.vorticity;
  const dust::Lattice lattice(def);
  dust::CpuDust grid(def);
  const std::vector<DustObstacle> boxes = walls();
  setVelocity(grid, lattice,
              [](const Vector3d& at) { return isInside(at) ? vortex(at) : Vector3d(0, 0, 0); });
  const float step = 1 / float(stepping.rate);
  CaseTimer timer;
  for (int tick = 0; tick < int(std::lround(kSeconds * stepping.rate)); ++tick)
    timer.time(double(step), [&] { grid.step(step, {}, boxes); });
  // A step ends with what carries, the next one begins with what takes the divergence out.
  grid.computeDivergence();
  grid.solvePressure();
  grid.project();
  std::vector<Eigen::Vector3f> velocity;
  grid.readVelocity(velocity);
  const double viscosity = double(def.airViscosity) / double(def.airDensity);
  const double decay = taylorGreenDecay(viscosity, kWave, kSeconds);
  double difference = 0, found = 0, expected = 0;
  forCells(lattice, [&](std::size_t i, const Vector3d& at) {
    if (!isInside(at)) return;
    const Vector3d asked = decay * vortex(at), is = velocity[i].cast<double>();
    difference += (is - asked).squaredNorm();
    found += is.squaredNorm();
    expected += asked.squaredNorm();
  });
  return timer.outcome(quantity == Quantity::Energy ? std::abs(found / expected - 1)
                                                    : std::sqrt(difference / expected));
}

}  // namespace
}  // namespace dust_taylor_green

double taylorGreenDecay(double viscosity, double wave, double seconds) {
  return std::exp(-2 * viscosity * wave * wave * seconds);
}

ReportCase dustTaylorGreenCase() {
  using namespace dust_taylor_green;
  ReportCase c{
      .name = "dust_taylor_green",
      .what = "A vortex of 1 m/s fills a closed box of 1 m in a grid of 2 m, for 0.5 s",
      .closedForm =
          "Taylor and Green's vortex in a plane, which decays as exp(-2 nu k^2 t): by 0.01 % "
          "(Proc. R. Soc. A 158, 1937)",
      .error = "velocity: root mean square of the difference / of the velocity; energy: relative error",
      .runs = {},
      .note =
          "Energy is lost as the step is long, at every resolution; velocities are off most in the cells "
          "beside the walls. The default feeds eddies by a confinement of 0.3, for looks"};
  const DustGridDef standard;
  for (const Quantity quantity : {Quantity::Velocity, Quantity::Energy})
    for (const Stepping& stepping : {Stepping{60, standard.vorticity}, Stepping{60, 0}, Stepping{240, 0}})
      for (const int resolution : {16, 32, 64})
        c.runs.push_back(
            {std::string(quantity == Quantity::Energy ? "energy" : "velocity") + ", confinement " +
                 rounded(double(stepping.vorticity)) + ", " + std::to_string(stepping.rate) + " Hz",
             std::to_string(resolution) + "^3 cells",
             stepping.vorticity > 0 && resolution == standard.resolution,
             resolution <= 32 || stepping.rate == 60, [=] { return run(resolution, stepping, quantity); }});
  return c;
}

}  // namespace rubble::demo
