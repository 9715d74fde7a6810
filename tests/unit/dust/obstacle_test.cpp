// Solids stand in the way of the air and its dust, and push both.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "dust/solids.h"
#include "unit/dust/grids.h"

namespace rubble::test {
using namespace dust;
namespace {

// A wall at x in [0.25, 0.5], from side to side of a grid of 2 m.
DustObstacle wall() {
  DustObstacle o;
  o.kind = DustObstacle::Kind::Box;
  o.position = Eigen::Vector3f(0.375f, 1, 0);
  o.halfExtents = Eigen::Vector3f(0.126f, 1.5f, 1.5f);
  return o;
}

// A jet of 10 m/s from a block of 6 x 6 x 6 cells (one layer alone would be stopped by the pressure), with
// too little dust to sink: 216 mg a frame.
std::vector<DustSource> jet(const Lattice& lattice) {
  std::vector<DustSource> sources;
  for (int i = 0; i < 6 * 6 * 6; ++i) {
    const Eigen::Vector3d at = test::centre(lattice, 8 + i % 6, 13 + i / 6 % 6, 13 + i / 36);
    sources.push_back({at.cast<float>(), Eigen::Vector3f(10, 0, 0), 1e-6f, 1e-6f});
  }
  return sources;
}

// The most dust that was beyond x = 0.5 in half a second of the jet, as a share of the emitted.
double behind(std::span<const DustObstacle> obstacles) {
  const DustGridDef def = test::cube(32, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  double most = 0;
  for (int i = 0; i < 30; ++i) {
    grid.step(1.0f / 60, jet(lattice), obstacles);
    std::vector<float> density;
    grid.readDensity(density);
    double sum = 0;
    test::forCells(lattice, [&](int c, const Eigen::Vector3d& at) {
      if (at.x() > 0.5) sum += double{density[c]} * lattice.volume();
    });
    most = std::max(most, sum / grid.totals().emitted);
  }
  return most;
}

// No face of a wall without a gap lets dust through, whatever the pressure's residual: exactly nothing.
TEST(Obstacle, BlocksAJetOfDust) {
  const DustObstacle obstacle = wall();
  EXPECT_EQ(behind({&obstacle, 1}), 0);
  EXPECT_GT(behind({}), 0.1);
}

// Air and body share the velocity through each face between them: 2 m/s for a box moving so.
TEST(Obstacle, FacesOfAMovingBoxMoveWithIt) {
  const DustGridDef def = test::cube(32, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  DustObstacle box;
  box.kind = DustObstacle::Kind::Box;
  box.position = Eigen::Vector3f(0, 1, 0);
  box.halfExtents.setConstant(0.25f);
  box.velocity = Eigen::Vector3f(2, 0, 0);
  std::vector<SolidCells> solids;
  gatherSolids(lattice, {&box, 1}, solids);
  grid.placeObstacles(solids);
  grid.computeDivergence();
  grid.solvePressure();
  grid.project();
  std::vector<float> faces, air;
  grid.read(Field::Faces, faces);
  grid.read(Field::Air, air);
  // 0.25 m are four cells: cells 12 to 19 of 32 are solid.
  EXPECT_EQ(air[lattice.index(11, 15, 15)], 1.0f);
  EXPECT_EQ(air[lattice.index(12, 15, 15)], 0.0f);
  EXPECT_EQ(air[lattice.index(19, 15, 15)], 0.0f);
  EXPECT_EQ(air[lattice.index(20, 15, 15)], 1.0f);
  for (int y = 12; y < 20; ++y) {
    EXPECT_EQ(faces[lattice.face(0, 20, y, 15)], 2.0f);
    EXPECT_EQ(faces[lattice.face(0, 12, y, 15)], 2.0f);
    EXPECT_EQ(faces[lattice.face(2, 15, y, 20)], 0.0f);
  }
  // It drives the air before it and draws the air behind it along.
  EXPECT_GT(faces[lattice.face(0, 22, 15, 15)], 0.2f);
  EXPECT_GT(faces[lattice.face(0, 10, 15, 15)], 0.2f);
}

// A ball of 0.4 m in cells of 1/16 m: its volume to a few per cent, and v + spin x r inside.
TEST(Obstacle, BallCoversItsVolumeAndTurns) {
  const DustGridDef def = test::cube(32, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  DustObstacle ball;
  ball.position = Eigen::Vector3f(0, 1, 0);
  ball.halfExtents.x() = 0.4f;
  ball.spin = Eigen::Vector3f(0, 0, 5);
  std::vector<SolidCells> solids;
  gatherSolids(lattice, {&ball, 1}, solids);
  grid.placeObstacles(solids);
  std::vector<float> air;
  std::vector<Eigen::Vector3f> velocity;
  grid.read(Field::Air, air);
  grid.readVelocity(velocity);
  double volume = 0;
  test::forCells(lattice, [&](int i, const Eigen::Vector3d& at) {
    if (air[i] == 1) return;
    volume += lattice.volume();
    const Eigen::Vector3d offset = at - Eigen::Vector3d(0, 1, 0);
    const Eigen::Vector3d expected(-5 * offset.y(), 5 * offset.x(), 0);
    EXPECT_LT((velocity[i].cast<double>() - expected).norm(), 1e-5);
  });
  EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi * 0.064, 0.05 * 0.268);
}

// Dust that a body comes upon is pushed out of it, not kept inside: each open face of a cell takes at least
// a tenth a step, so 1 % is left after 60 steps even where two cells lie one behind the other.
TEST(Obstacle, DustCaughtInsideComesOut) {
  const DustGridDef def = test::cube(32, 2);
  const Lattice lattice(def);
  CpuDust grid(def);
  const DustSource puff{Eigen::Vector3f(0.01f, 1.01f, 0.01f), Eigen::Vector3f::Zero(), 1e-6f, 1e-6f};
  DustObstacle ball;
  ball.position = puff.position;
  ball.halfExtents.x() = 0.05f;  // the few cells around the puff
  grid.step(0.02f, {&puff, 1}, {});
  for (int i = 0; i < 60; ++i) grid.step(0.02f, {}, {&ball, 1});
  std::vector<float> density, air;
  grid.readDensity(density);
  grid.read(Field::Air, air);
  double inside = 0;
  for (std::size_t i = 0; i < air.size(); ++i) {
    inside += (1 - double{air[i]}) * double{density[i]} * lattice.volume();
  }
  EXPECT_LT(inside, 0.01e-6);
  EXPECT_LT(grid.totals().error(), 1e-5);
}

}  // namespace
}  // namespace rubble::test
