// Solids that made the cook slow: what they cook to, and how much work their distances are. Work is counted,
// not timed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "cook/corner_normals.h"
#include "cook/ear_clipping.h"
#include "cook/grid_distance.h"
#include "cook/packing.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

struct Work {
  std::size_t nodes, triangles;
};

Work workOfPacking(const SurfaceMesh& mesh, double radius) {
  const cooking::CheckedMesh solid = cooking::checkMesh(mesh);
  cooking::GridDistance distance(solid);
  distance.fitTo(radius);
  const CookOptions options;
  const cooking::PackingDef def{2048, radius, 1, options.maxOverlap, options.maxIterations};
  const cooking::Packing packing = cooking::pack(distance, solid.bounds, def, [](double) {});
  EXPECT_EQ(packing.centres.size(), 2048u);
  return {distance.nodesMeasured(), distance.tree().trianglesTried()};
}

// At most the eight nodes around each of the 65 places where an element looks for room at first: on average
// it then moves through no more cells than that. A grid over the bounds has 5e9 nodes.
TEST(CookWork, NodesAreMeasuredOnlyWhereElementsGo) {
  const double radius = 0.00229;
  const Work work = workOfPacking(tilted(shell()), radius);
  EXPECT_LT(work.nodes, 8u * 65u * 2048u);
}

// With boxes along the world's axes it was 905 triangles a node, half of all.
TEST(CookWork, LongTrianglesThatLieAslantAreTriedOnlyNearby) {
  const Work work = workOfPacking(tilted(plateOfStrips(512)), 0.02);
  EXPECT_LT(work.triangles, 200 * work.nodes);
  EXPECT_LT(work.triangles, 100'000'000u);
}

// The outline of a face on a surface of slivers: half a disc whose straight side has many corners, off the
// line by little.
cooking::FlatLoop outlineOnSlivers(std::uint32_t corners) {
  std::mt19937_64 generator(5);
  cooking::FlatLoop loop;
  const auto add = [&loop](double x, double y) { loop.push_back({{x, y}, std::uint32_t(loop.size())}); };
  for (std::uint32_t k = 0; k <= corners; ++k)
    add(-1 + 2.0 * k / corners, 1e-13 * (double(generator() >> 11) * 0x1p-53 - 0.5));
  for (const double angle : {0.5, 1.0, 1.5, 2.0, 2.5}) add(std::cos(angle), std::sin(angle));
  return loop;
}

// Compared with all corners each ear takes half of them on average, 8e6 in all.
TEST(CookWork, AnEarIsComparedWithTheCornersBesideItAlone) {
  constexpr std::uint32_t kCorners = 4000;
  const cooking::FlatLoop loop = outlineOnSlivers(kCorners);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  EXPECT_LT(cooking::clipEars(loop, triangles), 50u * kCorners);
  ASSERT_EQ(triangles.size(), loop.size() - 2);
  double area = 0;
  double expected = 0;  // shoelace formula
  for (const auto& [a, b, c] : triangles) area += cooking::turn(loop[a], loop[b], loop[c]) / 2;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2d& p = loop[k].place;
    const Eigen::Vector2d& q = loop[(k + 1) % loop.size()].place;
    expected += (p.x() * q.y() - p.y() * q.x()) / 2;
  }
  EXPECT_NEAR(area, expected, 1e-12);
}

// Bit by bit, since it is found once: a sum that starts at each of them in turn, as it was, is rounded
// otherwise and takes the square of their count. A cone's apex, on the axis by symmetry.
TEST(CookWork, AHubOfManyTrianglesHasOneNormal) {
  constexpr std::uint32_t kSides = 3000;
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, 0.2}};
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    const std::uint32_t next = 2 + (k + 1) % kSides;
    mesh.triangles.push_back({0, next, 2 + k});
    mesh.triangles.push_back({1, 2 + k, next});
  }
  const cooking::CheckedMesh cone = cooking::checkMesh(mesh);
  const auto normals = cooking::cornerNormals(cone);
  std::vector<Eigen::Vector3d> atApex;
  for (std::size_t t = 0; t < normals.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (cone.vertices[cone.triangles[t][corner]].z() > 0.1) atApex.push_back(normals[t][corner]);
  ASSERT_EQ(atApex.size(), kSides);
  for (const Eigen::Vector3d& normal : atApex) ASSERT_EQ(normal, atApex[0]);
  EXPECT_NEAR((atApex[0] - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-12);
}

// Large triangles are in the tree in many parts: 24 triangles, a few of which are near a place, in 1536
// parts.
TEST(TriangleTree, TriesATriangleOnceOrLittleMore) {
  const cooking::CheckedMesh mesh = cooking::checkMesh(tilted(hollowCube()));
  const cooking::TriangleTree tree(mesh);
  std::mt19937_64 generator(3);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  constexpr int kTried = 2000;
  for (int k = 0; k < kTried; ++k) {
    const Eigen::Vector3d place(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles)
      nearest = std::min(
          nearest,
          (cooking::closestOnTriangle(place, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) - place)
              .squaredNorm());
    EXPECT_EQ(tree.closest(place).squaredDistance, nearest);
  }
  EXPECT_LT(tree.trianglesTried(), 24u * kTried);
}

TEST(CookWork, NeedlesCook) {
  ExpectedWarnings warnings;
  const Asset asset = cook(needle(), optionsFor(10), {}, warnings.log());
  EXPECT_EQ(warnings.take("do not fit; radius"), 1);
  EXPECT_EQ(warnings.take("thinner than the elements"), 1);
  EXPECT_EQ(warnings.take("protrudes"), 1);
  EXPECT_EQ(warnings.take("too few elements for the thin parts"), 1);
  EXPECT_NEAR(asset.volume(), 1.0 / 6, 1e-9);
  EXPECT_LT(asset.radius, 0.0056);  // half the height over its longest face at the thick end, 1 / 90
}

TEST(CookWork, PlatesOfAslantStripsCook) {
  ExpectedWarnings warnings;
  const Asset asset = cook(tilted(plateOfStrips(512)), optionsFor(512), {}, warnings.log());
  EXPECT_EQ(warnings.take("do not fit; radius"), 1);
  EXPECT_NEAR(asset.volume(), 0.2, 1e-9);
  EXPECT_LT(asset.radius, 0.025);
}

TEST(CookWork, BallsOfFourHundredThousandTrianglesCook) {
  const SurfaceMesh mesh = ball(1, 317);
  ASSERT_GT(mesh.triangles.size(), 400'000u);
  const Asset asset = cookStrictly(mesh, optionsFor(256));
  EXPECT_NEAR(asset.volume(), volumeOf(mesh), 1e-9);
}

// Elements as thick as the walls, not larger ones that would all sit in the edges, where a ball tangent to
// two faces and the inner edge has a radius of 5 mm * sqrt(2) / (1 + sqrt(2)) = 2.9 mm.
TEST(CookWork, ShellsOfThinWallsCookWithElementsThatFitTheWalls) {
  for (const SurfaceMesh& mesh : {shell(), tilted(shell())}) {
    ExpectedWarnings warnings;
    const Asset asset = cook(mesh, optionsFor(2048), {}, warnings.log());
    EXPECT_EQ(warnings.take("do not fit; radius"), 1);
    EXPECT_EQ(warnings.take("are thinner than the elements"), 1);
    EXPECT_NEAR(asset.volume(), 8 - 1.99 * 1.99 * 1.99, 1e-9);
    EXPECT_LE(asset.radius, 0.0025);
    EXPECT_GE(asset.radius, 0.9 * 0.9 * 0.0025);
  }
}

TEST(CookWork, WhatDoesNotFitIntoANeedleIsNamed) {
  CookOptions options = optionsFor(10);
  options.radius = 0.02;
  try {
    cook(needle(), options);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no sphere of radius 0.02 m fits into the mesh: the deepest"),
              std::string::npos)
        << error.what();
  }
}

// The side is taken over from the place asked for before where a ball without surface holds both, so the
// order of the questions must not matter; steps of all sizes, across the walls of a shell too.
TEST(GridDistance, SaysTheSameInAnyOrder) {
  const cooking::CheckedMesh mesh = cooking::checkMesh(tilted(hollowCube()));
  cooking::GridDistance walked(mesh);
  walked.fitTo(0.05);
  std::mt19937_64 generator(5);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int k = 0; k < 5000; ++k) {
    const double step = std::pow(10, -4 * uniform());
    place += step * (Eigen::Vector3d(uniform(), uniform(), uniform()) - Eigen::Vector3d::Constant(0.5));
    if (place.norm() > 1) place = Eigen::Vector3d::Zero();
    const cooking::Distance here = walked.exact(place);
    EXPECT_EQ(here.value < 0, walked.tree().holds(place)) << place.transpose();
    EXPECT_EQ(std::abs(here.value), std::sqrt(walked.tree().closest(place).squaredDistance));
  }
}

// Around the edge of a wedge of 20 degrees, the nearest triangle's plane has the wrong side for the places
// that are nearest to the edge itself.
TEST(GridDistance, KnowsTheSideAroundSharpEdges) {
  const double slope = std::tan(10 * std::numbers::pi / 180);
  const cooking::CheckedMesh mesh =
      cooking::checkMesh(extrude({{0, 0}, {1, -slope}, {1, slope}}, {{0, 1, 2}}, 1));
  const cooking::GridDistance distance(mesh);
  std::mt19937_64 generator(11);
  const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
  for (int k = 0; k < 5000; ++k) {
    const Eigen::Vector3d p(0.2 * uniform() - 0.1, 0.2 * uniform() - 0.1, uniform());
    EXPECT_EQ(distance.exact(p).value < 0, std::abs(p.y()) < slope * p.x()) << p.transpose();
  }
}

}  // namespace
}  // namespace rubble::test
