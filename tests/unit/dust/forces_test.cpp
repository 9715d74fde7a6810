// What moves the air: confinement, the weight of the dust, drag.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

// Velocities after the forces of one step on `flow`.
std::vector<float> afterForces(float vorticity, auto&& flow) {
  DustGridDef def = test::cube(16, 2);
  def.vorticity = vorticity;
  CpuDust grid(def);
  test::setVelocity(grid, Lattice(def), flow);
  grid.addForces(0.02f);
  std::vector<float> velocity;
  grid.read(Field::Velocity, velocity);
  return velocity;
}

// Wind, and a stagnation flow: no derivative of one component along another axis, so the discrete curl is
// exactly 0 and the bits must agree.
TEST(Confinement, AddsNothingToAFieldWithoutVorticity) {
  const auto wind = [](const Eigen::Vector3d&) { return Eigen::Vector3f(3, -1, 2); };
  const auto stagnation = [](const Eigen::Vector3d& at) {
    return Eigen::Vector3d(2 * at.x(), -3 * at.y(), at.z()).cast<float>().eval();
  };
  EXPECT_EQ(afterForces(0.5f, wind), afterForces(0, wind));
  EXPECT_EQ(afterForces(0.5f, stagnation), afterForces(0, stagnation));
}

// The control: an eddy spins the faster for it.
TEST(Confinement, FeedsAnEddy) {
  const auto eddy = [](const Eigen::Vector3d& at) {
    const double s = std::exp(-8 * (at.x() * at.x() + at.z() * at.z()));
    return Eigen::Vector3d(-at.z() * s, 0, at.x() * s).cast<float>().eval();
  };
  EXPECT_GT(test::rms(afterForces(0.5f, eddy)), 1.001 * test::rms(afterForces(0, eddy)));
}

// 0.06 kg/m^3 in air of 1.2 weighs 1/20 of it: g / 20. Far more dust falls freely, not faster.
TEST(Weight, LadenAirSinksByItsLoadAtMostFreely) {
  DustGridDef def = test::cube(16, 2);
  const Lattice lattice(def);
  const int middle = lattice.index(8, 8, 8), heavy = lattice.index(6, 6, 6);
  CpuDust grid(def);
  std::vector<float> density(lattice.cells()), velocity;
  density[middle] = 0.06f;
  density[heavy] = 500;
  grid.write(Field::Density, density);
  grid.addForces(0.02f);
  grid.read(Field::Velocity, velocity);
  EXPECT_NEAR(double{velocity[4 * middle + 1]}, -9.81 / 20 * 0.02, 1e-6);
  EXPECT_NEAR(double{velocity[4 * heavy + 1]}, -9.81 * 0.02, 1e-6);
}

// exp(-drag dt), exact for any dt.
TEST(Drag, DecaysTheAirExponentially) {
  DustGridDef def = test::cube(16, 2);
  def.drag = 5;
  const Lattice lattice(def);
  CpuDust grid(def);
  test::setVelocity(grid, lattice, [](const Eigen::Vector3d&) { return Eigen::Vector3f(1, 0, 0); });
  for (int i = 0; i < 10; ++i) grid.addForces(0.02f);
  std::vector<float> velocity;
  grid.read(Field::Velocity, velocity);
  EXPECT_NEAR(double{velocity[4 * lattice.index(8, 8, 8)]}, std::exp(-1), 1e-5);
}

}  // namespace
}  // namespace rubble::test
