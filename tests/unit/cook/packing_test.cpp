// Packing and the signed distances it runs on.
#include <gtest/gtest.h>

#include <random>

#include "cook/grid_distance.h"
#include "cook/spread.h"
#include "cook/triangle_tree.h"
#include "support/strict_cook.h"
#include "unit/cook/packed.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

double deepestOverlap(const Asset& asset) {
  double deepest = 0;
  for (std::size_t i = 0; i < asset.elementCount(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(deepest, 2 * asset.radius - (asset.positions[i] - asset.positions[j]).norm());
  return deepest / (2 * asset.radius);
}

TEST(Packing, OfTheWallIsExactAndInsideAndHardlyOverlaps) {
  const Asset wall = cookStrictly(wallMesh(), wallOptions());
  ASSERT_EQ(wall.elementCount(), 2048u);
  EXPECT_EQ(wall.radius, 0.016);
  const Eigen::Vector3d half(0.5, 0.5, 0.04);
  for (const Eigen::Vector3d& p : pack(wallMesh(), wallOptions()).centres)
    EXPECT_GE((half - p.cwiseAbs()).minCoeff(), wall.radius * (1 - 1e-9));
  EXPECT_LE(deepestOverlap(wall), wallOptions().maxOverlap);
}

// The distance is exact at the end, so the spheres are inside to the tolerance of the last push.
TEST(Packing, StaysInsideATorus) {
  const Asset asset = cookStrictly(torus(1, 0.3, 64, 32), optionsFor(500));
  const cooking::Elements packed = pack(torus(1, 0.3, 64, 32), optionsFor(500));
  for (const Eigen::Vector3d& p : packed.centres) {
    const double fromRing = std::hypot(std::hypot(p.x(), p.y()) - 1, p.z());
    EXPECT_LE(fromRing + packed.radius,
              0.3 + 1e-3 * packed.radius);  // the mesh lies inside of the true torus
  }
  EXPECT_LE(deepestOverlap(asset), 0.05);
}

TEST(Packing, KeepsOutOfACavity) {
  const cooking::Elements packed = pack(hollowCube(), optionsFor(300));
  for (const Eigen::Vector3d& p : packed.centres) {
    EXPECT_LE(p.cwiseAbs().maxCoeff(), 0.5 - 0.99 * packed.radius);
    const Eigen::Vector3d outside = (p.cwiseAbs() - Eigen::Vector3d::Constant(0.25)).cwiseMax(0.0);
    EXPECT_GE(outside.norm(), 0.99 * packed.radius);
  }
}

TEST(Packing, TakesTheRadiusFromTheFill) {
  CookOptions options = optionsFor(500);
  options.fill = 0.45;
  const Asset asset = cookStrictly(boxMesh({1, 1, 1}), options);
  EXPECT_NEAR(500 * 4.0 / 3.0 * std::numbers::pi * std::pow(asset.radius, 3), 0.45, 1e-12);
}

// Two spheres in a unit cube: centres on the diagonal of the cube of edge 1 - 2 r are 2 r apart at r = 0.317,
// so the radius for the default fill, 0.386, has to shrink.
TEST(Packing, ShrinksAChosenRadiusThatDoesNotFit) {
  ExpectedWarnings warnings;
  const Asset asset = cook(boxMesh({1, 1, 1}), optionsFor(2), {}, warnings.log());
  EXPECT_EQ(asset.elementCount(), 2u);
  EXPECT_LE(deepestOverlap(asset), 0.2);
  EXPECT_EQ(warnings.take("do not fit; radius"), 1);
}

TEST(Packing, FitsASingleLayerExactlyAsThickAsTheElements) {
  CookOptions options = optionsFor(30);
  options.radius = 0.05;
  const Asset asset = cookStrictly(boxMesh({1, 1, 0.1}), options);
  for (const Eigen::Vector3d& p : asset.positions) EXPECT_NEAR(p.z(), 0, 1e-6);
}

TEST(Packing, FillsBothOfTwoShells) {
  const Asset asset =
      cookStrictly(joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {3, 0, 0})), optionsFor(200));
  int left = 0;
  for (const Eigen::Vector3d& p : asset.positions) left += p.x() < 1.5 ? 1 : 0;
  EXPECT_NEAR(left, 100, 40);  // random, standard deviation 7
}

TEST(GridDistance, AgreesWithTheTorus) {
  const cooking::CheckedMesh mesh = cooking::checkMesh(torus(1, 0.3, 96, 48));
  cooking::GridDistance distance(mesh);
  distance.fitTo(0.06);
  EXPECT_EQ(distance.spacing(), 0.03);
  const double facets =
      0.3 * (1 - std::cos(std::numbers::pi / 48)) + 1.3 * (1 - std::cos(std::numbers::pi / 96));
  std::mt19937_64 generator(3);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector3d p(2.8 * uniform() - 1.4, 2.8 * uniform() - 1.4, 0.8 * uniform() - 0.4);
    const double expected = std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - 0.3;
    EXPECT_NEAR(distance.exact(p).value, expected, facets + 1e-12);
    // Trilinear between exact samples of a function of slope 1: never off by more than half a cell's
    // diagonal, and that only at the ridge of the distance. Beyond reach as the header says.
    const double error = facets + std::sqrt(3.0) / 2 * distance.spacing();
    const double fast = distance.fast(p).value;
    EXPECT_GE(fast, std::max(expected, -distance.reach()) - error);
    EXPECT_LE(fast, (expected > distance.reach() - error ? 1.5 : 1) * std::max(expected, -distance.reach()) +
                        error);
  }
}

TEST(TriangleTree, FindsWhatASearchThroughAllTrianglesFinds) {
  const cooking::CheckedMesh mesh = cooking::checkMesh(torus(1, 0.3, 20, 10));
  const cooking::TriangleTree tree(mesh);
  std::mt19937_64 generator(5);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector3d p(4 * uniform() - 2, 4 * uniform() - 2, 2 * uniform() - 1);
    double best = 1e9;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d q =
          cooking::closestOnTriangle(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
      best = std::min(best, (q - p).squaredNorm());
    }
    EXPECT_DOUBLE_EQ(tree.closest(p).squaredDistance, best);
  }
}

// Oracle: the least of many points of the triangle.
TEST(TriangleTree, ClosestPointOfATriangleIsCloserThanItsOtherPoints) {
  const Eigen::Vector3d a(0, 0, 0);
  const Eigen::Vector3d b(2, 0.1, 0);
  const Eigen::Vector3d c(0.3, 1, 0.2);
  std::mt19937_64 generator(9);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d p(6 * uniform() - 2, 4 * uniform() - 2, 4 * uniform() - 2);
    const double found = (cooking::closestOnTriangle(p, a, b, c) - p).norm();
    double sampled = 1e9;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j)
        sampled = std::min(sampled, (a + (b - a) * (i / 40.0) + (c - a) * (j / 40.0) - p).norm());
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GE(found, sampled - 0.05);  // the samples are 2 / 40 apart
  }
}

// Two boxes in the same place leave hardly a place inside: an error, where it looked for one without end.
TEST(Packing, SpreadingEndsWhereNoPlacesAreLeft) {
  const cooking::CheckedMesh solid =
      cooking::checkMesh(joined(boxMesh(Eigen::Vector3d::Ones()), boxMesh(Eigen::Vector3d::Ones())));
  const auto distance = cooking::signedDistance(solid);
  distance->fitTo(0.1);
  EXPECT_THROW(cooking::spread(*distance, solid, {60, 0.1, 0.3, 1}, [](double) {}), Error);
}

}  // namespace
}  // namespace rubble::test
