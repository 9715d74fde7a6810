// The air carries the dust and itself: over the right distance, without loss, never below zero.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

// A bell of `width` metres around `at`, in units of 1.
float bell(const Eigen::Vector3d& offset, double width) {
  return float(std::exp(-offset.squaredNorm() / (width * width)));
}

std::vector<float> blob(const Lattice& lattice, const Eigen::Vector3d& at, double width) {
  std::vector<float> density(lattice.cells());
  test::forCells(lattice, [&](int i, const Eigen::Vector3d& place) { density[i] = bell(place - at, width); });
  return density;
}

// The same velocity through every face.
std::vector<float> uniformFaces(const Lattice& lattice, const Eigen::Vector3f& velocity) {
  std::vector<float> faces(3 * lattice.facesOfAxis());
  for (int a = 0; a < 3; ++a) {
    std::fill_n(faces.begin() + long(lattice.facesOfAxis()) * a, lattice.facesOfAxis(), velocity[a]);
  }
  return faces;
}

DustGridDef weightless(int n, float side) {
  DustGridDef def = test::cube(n, side);
  def.gravity = 0;
  return def;
}

// Each flux moves the centre of mass by its share of a cell; the limiter's clipping of the bell is symmetric
// but for the upwind side. 1 % of the way covers it.
TEST(Transport, UniformWindMovesABlobByVelocityTimesTime) {
  const DustGridDef def = weightless(32, 2);
  const Lattice lattice(def);
  const Eigen::Vector3f wind(1.0f, 0.5f, -0.7f);
  const std::vector<float> start = blob(lattice, {-0.3, 0.8, 0.2}, 0.2), faces = uniformFaces(lattice, wind);
  CpuDust grid(def);
  grid.write(Field::Density, start);
  for (int i = 0; i < 25; ++i) {
    grid.write(Field::Faces, faces);
    grid.transportDust(0.02f);
  }
  std::vector<float> end;
  grid.readDensity(end);
  const Eigen::Vector3d way = test::centroid(lattice, end) - test::centroid(lattice, start);
  const Eigen::Vector3d expected = 0.5 * wind.cast<double>();
  EXPECT_LT((way - expected).norm(), 0.01 * expected.norm()) << way.transpose();
  // Second order keeps most of a bell three cells wide over eight cells' way; first order keeps under half.
  EXPECT_GT(*std::max_element(end.begin(), end.end()), 0.6f);
}

// The bump of w is carried along by a wind in x and y; MacCormack's error is one of dispersion, of third
// order.
TEST(Transport, UniformWindMovesAnEddyOfTheAirByVelocityTimesTime) {
  const DustGridDef def = weightless(32, 2);
  const Lattice lattice(def);
  const Eigen::Vector3d start(-0.3, 0.8, 0);
  CpuDust grid(def);
  test::setVelocity(grid, lattice, [&](const Eigen::Vector3d& at) {
    return Eigen::Vector3f(1.0f, 0.5f, 1e-3f * bell(at - start, 0.25));
  });
  for (int i = 0; i < 20; ++i) grid.advectVelocity(0.025f);
  std::vector<Eigen::Vector3f> velocity;
  grid.readVelocity(velocity);
  std::vector<float> bump(lattice.cells());
  std::transform(velocity.begin(), velocity.end(), bump.begin(),
                 [](const Eigen::Vector3f& u) { return u.z(); });
  const Eigen::Vector3d way = test::centroid(lattice, bump) - start;
  EXPECT_LT((way - Eigen::Vector3d(0.5, 0.25, 0)).norm(), 0.01 * 0.56) << way.transpose();
  EXPECT_GT(*std::max_element(bump.begin(), bump.end()), 0.8e-3f);
}

// Dust of density d that fills the grid leaves through a side of area A at speed u with d u A kg/s.
TEST(Transport, DustThroughAnOpenSideIsDensityTimesSpeedTimesArea) {
  const DustGridDef def = weightless(16, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  grid.write(Field::Density, std::vector<float>(lattice.cells(), 0.25f));
  grid.write(Field::Faces, uniformFaces(lattice, {0, 0, 1.5f}));
  grid.transportDust(0.04f);
  grid.sumTotals();
  EXPECT_NEAR(grid.totals().left, 0.25 * 1.5 * 4 * 0.04, 1e-6);
  EXPECT_EQ(grid.totals().settled, 0);
  EXPECT_NEAR(grid.totals().air, 0.25 * 8 - 0.25 * 1.5 * 4 * 0.04, 1e-6);
}

// Noise with Courant numbers up to 8 and empty cells beside full ones: nothing below zero, nothing lost.
TEST(Transport, NoDensityFallsBelowZeroInNoise) {
  const DustGridDef def = weightless(16, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  test::Sequence random;
  std::vector<float> density(lattice.cells()), faces(3 * lattice.facesOfAxis());
  for (float& d : density) d = std::max(random.next(), 0.0f);
  grid.write(Field::Density, density);
  const double before = std::accumulate(density.begin(), density.end(), 0.0) * lattice.volume();
  for (int i = 0; i < 5; ++i) {
    for (float& f : faces) f = 50 * random.next();
    grid.write(Field::Faces, faces);
    grid.transportDust(0.02f);
    grid.readDensity(density);
    EXPECT_GE(*std::min_element(density.begin(), density.end()), 0.0f);
  }
  grid.sumTotals();
  const DustTotals t = grid.totals();
  // Float rounding of some 100 sweeps; a bug of a flux shows at 1e-2.
  EXPECT_NEAR(t.air + t.left + t.settled, before, 1e-4 * before);
}

// Grains of 30 micrometres: v = 2/9 (2400 - 1.2) 9.81 (30e-6)^2 / 1.8e-5 = 0.26147 m/s [Stokes]. A cloud of
// 1e-6 kg/m^3 adds a millionth to the weight of the air, so its centre falls with exactly that.
TEST(Settling, GrainsOfThirtyMicrometresFallAtStokesSpeed) {
  DustGridDef def = test::cube(32, 2);
  def.grainRadius = 30e-6f;
  const Lattice lattice(def);
  CpuDust grid(def);
  std::vector<float> start = blob(lattice, {0, 1.3, 0}, 0.2), end;
  for (float& d : start) d *= 1e-6f;
  grid.write(Field::Density, start);
  for (int i = 0; i < 60; ++i) grid.step(1.0f / 30, {}, {});
  grid.readDensity(end);
  const Eigen::Vector3d way = test::centroid(lattice, end) - test::centroid(lattice, start);
  const double expected = -0.26147 * 2;
  EXPECT_NEAR(way.y(), expected, 0.01 * -expected);
  EXPECT_NEAR(way.x(), 0, 1e-3);
  EXPECT_NEAR(way.z(), 0, 1e-3);
}

// A puff of one cell 0.5 m up is on the ground after 1.9 s in the mean. Four cells of 1/8 m spread it by
// about a second: of a cell at Courant numbers below 1 the rest decays with v / h = 2.1 /s. After 6 s 1 % may
// float.
TEST(Settling, AllOfItReachesTheGround) {
  DustGridDef def = test::cube(16, 2);
  def.grainRadius = 30e-6f;
  CpuDust grid(def);
  const DustSource puff{Eigen::Vector3f(0.01f, 0.5f, 0.01f), Eigen::Vector3f::Zero(), 1e-9f, 30e-6f};
  grid.step(0.02f, {&puff, 1}, {});
  EXPECT_LT(grid.totals().settled, 1e-3 * grid.totals().emitted);
  for (int i = 0; i < 300; ++i) grid.step(0.02f, {}, {});
  EXPECT_GT(grid.totals().settled, 0.99 * grid.totals().emitted);
  EXPECT_LT(grid.totals().left, 1e-6 * grid.totals().emitted);
}

}  // namespace
}  // namespace rubble::test
