// Repair of closed parts that overlap and touch in all ways, at random and where roundings are in the way.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "rubble/repair.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

using UniteHeaps = testing::Test;

#ifdef RUBBLE_SANITIZED
constexpr int kHeaps = 20;
#else
constexpr int kHeaps = 200;
#endif

struct BoxHeap {
  SurfaceMesh mesh;
  double cells = 0;
};

// Boxes of one or two cells a side in a grid of 4 x 4 x 4: they overlap, share faces, pieces of faces, edges
// and corners, or all of each other. The solid is the cells that any of them fills.
BoxHeap heapOf(int boxes, double edge, std::mt19937& random) {
  const auto upTo = [&random](std::uint32_t most) { return std::uint32_t(random() % (most + 1)); };
  BoxHeap heap;
  std::set<std::array<std::uint32_t, 3>> cells;
  for (int box = 0; box < boxes; ++box) {
    std::array<std::uint32_t, 3> low{}, size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size[axis] = 1 + upTo(1);
      low[axis] = upTo(4 - size[axis]);
    }
    for (std::uint32_t c = 0; c < size[0] * size[1] * size[2]; ++c)
      cells.insert({low[0] + c % size[0], low[1] + c / size[0] % size[1], low[2] + c / size[0] / size[1]});
    const Eigen::Vector3d edges = edge * Eigen::Vector3d(size[0], size[1], size[2]);
    heap.mesh = joined(heap.mesh, boxMesh(edges, edge * Eigen::Vector3d(low[0], low[1], low[2]) + edges / 2));
  }
  heap.cells = double(cells.size());
  return heap;
}

void expectUnited(const SurfaceMesh& mesh, double volume, int heap) {
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.left, std::vector<std::string>()) << heap;
  EXPECT_EQ(repaired.fault, "") << heap;
  EXPECT_NEAR(volumeOf(repaired.mesh), volume, 1e-9 * volume) << heap;
}

TEST(UniteHeaps, OfBoxesOnAGrid) {
  std::mt19937 random(7);
  for (int heap = 0; heap < kHeaps; ++heap) {
    const auto [mesh, cells] = heapOf(2 + heap % 7, 1, random);
    expectUnited(mesh, cells, heap);
  }
}

// 0.1 is no double: what should lie in a plane misses it by a rounding, as in every file of decimals.
TEST(UniteHeaps, OfBoxesOnAGridOfDecimals) {
  std::mt19937 random(8);
  for (int heap = 0; heap < kHeaps; ++heap) {
    const auto [mesh, cells] = heapOf(2 + heap % 7, 0.1, random);
    expectUnited(mesh, cells * 0.001, heap);
  }
}

TEST(UniteHeaps, OfBoxesOnATurnedGrid) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> upTo1(-1, 1);
  for (int heap = 0; heap < kHeaps; ++heap) {
    auto [mesh, cells] = heapOf(2 + heap % 7, 0.7, random);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(upTo1(random), upTo1(random), upTo1(random), upTo1(random)).normalized();
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = turn * vertex;
    expectUnited(mesh, cells * 0.343, heap);
  }
}

// 2 + 2 - 1 + 2 + 1 cells.
TEST(UniteHeaps, OfPartsThatNearlyShareFaces) {
  SurfaceMesh mesh;
  const std::array<std::array<Eigen::Vector3d, 2>, 4> boxes = {{
      {Eigen::Vector3d(2, 1, 1), Eigen::Vector3d(0, 0, 0)},
      {Eigen::Vector3d(1, 2, 1), Eigen::Vector3d(1, 0, 0)},
      {Eigen::Vector3d(1, 1, 2), Eigen::Vector3d(0, 0, 1)},
      {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 1, 1)},
  }};
  for (const auto& [size, low] : boxes) mesh = joined(mesh, boxMesh(size, low + size / 2));
  expectUnited(mesh, 6, 0);
  expectUnited(tilted(mesh), 6, 1);
}

// It reaches up to one rounding below the other's top, and so lies inside of it all over: no cavity.
TEST(UniteHeaps, OfAPartThatMissesTheOthersSideByARounding) {
  SurfaceMesh inner = boxMesh({1, 1, 1}, {0, 0, 1});
  for (Eigen::Vector3d& vertex : inner.vertices)
    if (vertex.z() > 1) vertex.z() = std::nextafter(1.5, 0);
  expectUnited(joined(boxMesh({3, 3, 3}), inner), 27, 0);
  expectUnited(joined(boxMesh({3, 3, 3}), boxMesh({1, 1, 1}, {0, 0, 0.5})), 26, 1);  // 1/2 below: one
}

// Two columns touch along an edge of three pieces; blocks above and below join them. The ends of the middle
// piece have one fan of triangles each, so its two pairs of triangles would have the same edge: it is cut.
TEST(UniteHeaps, AlongAnEdgeWithinAFan) {
  SurfaceMesh mesh = joined(boxMesh({1, 1, 3}, {0.5, 0.5, 0.5}), boxMesh({1, 1, 3}, {1.5, 1.5, 0.5}));
  for (const double z : {1.5, -0.5}) mesh = joined(mesh, boxMesh({1, 1, 1}, {1.5, 0.5, z}));
  expectUnited(mesh, 8, 0);
  const auto united = repair(mesh).mesh.vertices;
  EXPECT_NE(std::find(united.begin(), united.end(), Eigen::Vector3d(1, 1, 0.5)), united.end());
}

// A heap in a room of another part: what was a wall of the heap's own room stays one.
TEST(UniteHeaps, WithinAnotherPartAsACavity) {
  const SurfaceMesh heap = joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {0.5, 0, 0}));
  expectUnited(joined(boxMesh({4, 4, 4}), heap), 64 - 1.5, 0);
  // Six plates about a room of 1 x 1 x 1, all within the box.
  SurfaceMesh room;
  for (const double side : {-1.0, 1.0}) {
    room = joined(room, boxMesh({1, 3, 3}, {side, 0, 0}));
    room = joined(room, boxMesh({3, 1, 3}, {0, side, 0}));
    room = joined(room, boxMesh({3, 3, 1}, {0, 0, side}));
  }
  expectUnited(room, 26, 1);
  expectUnited(joined(boxMesh({4, 4, 4}), room), 64 - 26, 2);
}

}  // namespace
}  // namespace rubble::test
