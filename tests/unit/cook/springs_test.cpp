// Springs and anchors of cooked solids.
#include <gtest/gtest.h>

#include <numeric>

#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

std::size_t componentCount(const Asset& asset) {
  std::vector<std::size_t> parent(asset.elementCount());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const AssetSpring& spring : asset.springs) parent[root(spring.first)] = root(spring.second);
  std::size_t count = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) count += root(i) == i ? 1 : 0;
  return count;
}

TEST(Springs, ConnectABox) {
  EXPECT_EQ(componentCount(cookStrictly(wallMesh(), wallOptions())), 1u);
  EXPECT_EQ(componentCount(cookStrictly(boxMesh({1, 1, 1}), optionsFor(200))), 1u);
}

TEST(Springs, LeaveTwoShellsApart) {
  // A millimetre between the boxes: many Delaunay edges cross it.
  const SurfaceMesh mesh = joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {1.001, 0, 0}));
  const Asset asset = cookStrictly(mesh, optionsFor(300));
  EXPECT_EQ(componentCount(asset), 2u);
  for (const AssetSpring& spring : asset.springs)
    EXPECT_EQ(asset.positions[spring.first].x() < 0.5005, asset.positions[spring.second].x() < 0.5005);
}

// Two elements above the foot by more than their cells reach down cannot share a face through the foot.
TEST(Springs, DoNotCrossASlot) {
  const double gap = 0.01;
  const Asset asset = cookStrictly(you(gap), optionsFor(600));
  ASSERT_GT(asset.spacing(), 5 * gap);
  const double high = 1 + asset.spacing();
  int legSprings = 0;
  for (const AssetSpring& spring : asset.springs) {
    const Eigen::Vector3d& a = asset.positions[spring.first];
    const Eigen::Vector3d& b = asset.positions[spring.second];
    if (a.y() < high || b.y() < high) continue;
    ++legSprings;
    EXPECT_EQ(a.x() < 1, b.x() < 1) << "from " << a.transpose() << " to " << b.transpose();
  }
  EXPECT_GT(legSprings, 100);  // or the test would not have looked at anything
}

TEST(Springs, AreSortedPairsWithTheAreaOfTheirFaceOnBothSides) {
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}), optionsFor(200));
  const double least = CookOptions{}.minFaceArea * asset.spacing() * asset.spacing();
  for (std::size_t s = 0; s < asset.springs.size(); ++s) {
    const AssetSpring& spring = asset.springs[s];
    EXPECT_LT(spring.first, spring.second);
    EXPECT_GE(spring.area, least);
    if (s > 0) {
      const AssetSpring& before = asset.springs[s - 1];
      EXPECT_LT(std::pair(before.first, before.second), std::pair(spring.first, spring.second));
    }
    for (const auto& [own, other] :
         {std::pair(spring.first, spring.second), std::pair(spring.second, spring.first)}) {
      int found = 0;
      for (const CellFace& face : asset.cellFaces(own)) {
        if (face.neighbour != other) continue;
        ++found;
        EXPECT_NEAR(double(face.area), spring.area, 1e-6 * spring.area);
      }
      EXPECT_EQ(found, 1);
    }
  }
}

// GEOMETRY of packed elements: 11 to 13 faces a cell before slivers go; a lattice of cubes would have 6.
TEST(Springs, OfAPackedCubeAreAboutElevenAnElement) {
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}), optionsFor(1000));
  const double each = 2.0 * double(asset.springs.size()) / 1000;
  EXPECT_GT(each, 9.5);
  EXPECT_LT(each, 13.5);
}

TEST(Springs, CarryTheWholeCrossSection) {
  // Two elements in a long box meet in one face across it.
  CookOptions options = optionsFor(2);
  options.radius = 0.5;
  options.maxOverlap = 1e-6;
  const Asset asset = cookStrictly(boxMesh({2, 1, 1}), options);
  ASSERT_EQ(asset.springs.size(), 1u);
  EXPECT_NEAR(asset.springs[0].area, 1.0, 1e-5);  // tilted by the jitter of 1e-6 r
  EXPECT_NEAR(asset.volumes[0], 1.0, 1e-5);       // off by the overlap left
}

TEST(Anchors, HoldTheBottomOfTheWall) {
  const Asset wall = cookStrictly(wallMesh(), wallOptions());
  double area = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const AssetAnchor& anchor : wall.anchors) {
    EXPECT_NEAR(anchor.point.y(), -0.5, 1e-12);
    EXPECT_LT(wall.positions[anchor.element].y(), -0.4);
    area += anchor.area;
    moment += anchor.area * anchor.point;
  }
  EXPECT_NEAR(area, 1 * 0.08, 1e-12);
  EXPECT_LT((moment / area - Eigen::Vector3d(0, -0.5, 0)).norm(), 1e-12);
}

TEST(Anchors, AreOnlyWhereAsked) {
  EXPECT_TRUE(cookStrictly(boxMesh({1, 1, 1}), optionsFor(20)).anchors.empty());
}

// The foot of the U looks down all along; its legs' tops are two squares of 1 x 0.5.
TEST(Anchors, TakeTheFurthestSurfaceOfAnyShape) {
  CookOptions options = optionsFor(100);
  options.anchorDirection = Eigen::Vector3d(0, 3, 0);
  double area = 0;
  for (const AssetAnchor& anchor : cookStrictly(you(0.5), options).anchors) area += anchor.area;
  EXPECT_NEAR(area, 1.0, 1e-12);
}

}  // namespace
}  // namespace rubble::test
