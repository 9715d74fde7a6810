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

double areaOf(const Asset& asset) {
  double area = 0;
  for (const AssetAnchor& anchor : asset.anchors) area += anchor.area;
  return area;
}

// All of the side x = 1, whatever cells it is cut into: half of its 1 m^2 for the centroids above the middle.
TEST(Anchors, AreInARegion) {
  CookOptions options = optionsFor(200);
  options.anchorRegions = {{Eigen::Vector3d(0.999, -2, -2), Eigen::Vector3d(1.001, 2, 2)}};
  const SurfaceMesh cube = boxMesh({1, 1, 1}, {0.5, 0, 0});
  const Asset side = cookStrictly(cube, options);
  EXPECT_NEAR(areaOf(side), 1, 1e-12);
  for (const AssetAnchor& anchor : side.anchors) EXPECT_NEAR(anchor.point.x(), 1, 1e-12);

  options.anchorRegions[0].min().y() = 0;
  const Asset half = cookStrictly(cube, options);
  EXPECT_NEAR(areaOf(half), 0.5, 0.1);
  for (const AssetAnchor& anchor : half.anchors) EXPECT_GE(anchor.point.y(), 0);
}

// A box about the whole cube ties each of its six sides, edges and corners by two and three anchors a cell.
TEST(Anchors, OfARegionHaveOneForEachSideOfACell) {
  CookOptions options = optionsFor(64);
  options.anchorRegions = {{Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)}};
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}), options);
  EXPECT_NEAR(areaOf(asset), 6, 1e-12);
  for (const AssetAnchor& anchor : asset.anchors)
    EXPECT_NEAR(anchor.point.cwiseAbs().maxCoeff(), 0.5, 1e-12) << anchor.point.transpose();
}

TEST(Anchors, ByDirectionAndByRegionAreTheirUnionOnce) {
  CookOptions options = optionsFor(100);
  options.anchorDirection = Eigen::Vector3d(0, -1, 0);
  const Asset down = cookStrictly(boxMesh({1, 1, 1}), options);
  options.anchorRegions = {{Eigen::Vector3d(-1, -0.501, -1), Eigen::Vector3d(1, -0.499, 1)}};
  const Asset twice = cookStrictly(boxMesh({1, 1, 1}), options);
  ASSERT_EQ(twice.anchors.size(), down.anchors.size());
  for (std::size_t a = 0; a < down.anchors.size(); ++a) {
    EXPECT_EQ(twice.anchors[a].element, down.anchors[a].element);
    EXPECT_EQ(twice.anchors[a].area, down.anchors[a].area);
    EXPECT_EQ(twice.anchors[a].point, down.anchors[a].point);
  }
  options.anchorRegions.push_back({Eigen::Vector3d(-1, 0.499, -1), Eigen::Vector3d(1, 0.501, 1)});
  EXPECT_NEAR(areaOf(cookStrictly(boxMesh({1, 1, 1}), options)), 2, 1e-12);
}

// The region is the mesh's, where the asset has an origin of its own, too.
TEST(Anchors, OfARegionAreFoundFarFromTheOrigin) {
  const Eigen::Vector3d far(500'000, 0, 6'000'000);
  CookOptions options = optionsFor(60);
  options.anchorRegions = {{far + Eigen::Vector3d(-1, -0.6, -1), far + Eigen::Vector3d(1, -0.4, 1)}};
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}, far), options);
  ASSERT_GT(asset.origin.norm(), 1e6);
  EXPECT_GE(areaOf(asset), 1 - 1e-9);
  options.anchorRegions = {{Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)}};
  EXPECT_THROW(cookStrictly(boxMesh({1, 1, 1}, far), options), Error);
}

TEST(Anchors, OfEachRegionMustBeFound) {
  CookOptions options = optionsFor(20);
  options.anchorDirection = Eigen::Vector3d(0, -1, 0);
  options.anchorRegions = {{Eigen::Vector3d(2, 2, 2), Eigen::Vector3d(3, 3, 3)}};
  try {
    cookStrictly(boxMesh({1, 1, 1}), options);
    ADD_FAILURE() << "was cooked";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "no outer face has its centroid in the anchor box (2, 2, 2) to (3, 3, 3) m; the mesh is from "
        "(-0.5, -0.5, -0.5) to (0.5, 0.5, 0.5) m");
  }
  options.anchorRegions = {Eigen::AlignedBox3d()};
  EXPECT_THROW(cookStrictly(boxMesh({1, 1, 1}), options), Error);
}

}  // namespace
}  // namespace rubble::test
