// Triangle meshes, and how an element sees one.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "edem/mesh_side.h"

namespace rubble::test {
namespace {

using edem::TriangleMesh;
using Eigen::Vector3d;

// n x n squares of two triangles each in y = height(x, z), from -1 to 1.
template <class Height>
TriangleMesh terrain(int n, Height&& height) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Triangle> triangles;
  for (int z = 0; z <= n; ++z)
    for (int x = 0; x <= n; ++x) {
      const double at = 2.0 * x / n - 1, beside = 2.0 * z / n - 1;
      vertices.emplace_back(at, height(at, beside), beside);
    }
  for (int z = 0; z < n; ++z)
    for (int x = 0; x < n; ++x) {
      const auto a = std::uint32_t(z * (n + 1) + x), b = a + 1, c = a + std::uint32_t(n) + 1, d = c + 1;
      triangles.push_back({a, c, d});
      triangles.push_back({a, d, b});
    }
  return {vertices, triangles};
}

TriangleMesh flatGround() {
  return terrain(8, [](double, double) { return 0.0; });
}

TEST(TriangleMesh, NearestIsThatOfAllTriangles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto place = [&] { return Vector3d(number(random), number(random), number(random)); };
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t t = 0; t < 200; ++t) {
    const Vector3d at = place();
    for (int c = 0; c < 3; ++c) vertices.push_back(at + 0.2 * place());
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleMesh mesh(vertices, triangles);
  ASSERT_EQ(mesh.triangles().size(), 200u);
  std::vector<std::uint32_t> found;
  for (int n = 0; n < 500; ++n) {
    const Vector3d p = 1.5 * place();
    double least = 1e9;
    std::vector<std::uint32_t> within;
    for (std::uint32_t t = 0; t < 200; ++t) {
      const double distance = mesh.nearest(t, p).distance;
      least = std::min(least, distance);
      if (distance <= 0.3) within.push_back(t);
    }
    EXPECT_DOUBLE_EQ(mesh.nearest(p).distance, least);
    mesh.gather(p, 0.3, found);
    EXPECT_EQ(found, within);
  }
}

TEST(TriangleMesh, IsOneTriangleToo) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  ASSERT_EQ(mesh.triangles().size(), 1u) << "the other has no area";
  EXPECT_DOUBLE_EQ(mesh.nearest({0.2, -0.5, 0.2}).distance, 0.5);
  std::vector<std::uint32_t> found;
  mesh.gather({0.2, 0.5, 0.2}, 0.6, found);
  EXPECT_EQ(found.size(), 1u);
}

TEST(TriangleMesh, TurnsNeighboursAlike) {
  std::mt19937 random(1);
  TriangleMesh ground = flatGround();
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Triangle> triangles(ground.triangles().begin(), ground.triangles().end());
  for (int z = 0; z <= 8; ++z)
    for (int x = 0; x <= 8; ++x) vertices.emplace_back(0.25 * x - 1, 0, 0.25 * z - 1);
  for (TriangleMesh::Triangle& t : triangles)
    if (random() % 2) std::swap(t[0], t[1]);
  const TriangleMesh mesh(vertices, triangles);
  for (std::uint32_t t = 1; t < mesh.triangles().size(); ++t)
    EXPECT_DOUBLE_EQ(mesh.normal(t).dot(mesh.normal(0)), 1) << t;
}

// Points straight under vertices, edges and diagonals, with the centre above others: the way there passes
// through exactly one triangle.
TEST(MeshSide, LeavesNoGapBetweenTriangles) {
  const TriangleMesh mesh = flatGround();
  edem::MeshSide side;
  for (int x = -4; x <= 4; ++x) {
    for (int z = -4; z <= 4; ++z) {
      for (const Vector3d& centre :
           {Vector3d(0, 0.1, 0), Vector3d(0.125, 0.1, 0.125), Vector3d(0.03, 0.1, 0.2)}) {
        side.look(mesh, centre, 0.9);
        const Vector3d p(0.125 * x, -0.01, 0.125 * z);
        const edem::SurfacePoint s = side.nearest(p);
        EXPECT_NEAR(s.distance, -0.01, 1e-12) << p.transpose() << " from " << centre.transpose();
        EXPECT_NEAR(s.normal.y(), 1, 1e-9);
        const edem::SurfacePoint above = side.nearest(p + Vector3d(0, 0.03, 0));
        EXPECT_NEAR(above.distance, 0.02, 1e-12);
      }
    }
  }
}

TEST(MeshSide, IsThatOfTheCentre) {
  const TriangleMesh mesh = flatGround();
  edem::MeshSide side;
  side.look(mesh, {0.02, -0.1, 0.03}, 0.5);
  const edem::SurfacePoint s = side.nearest({0.1, 0.05, 0.1});
  EXPECT_NEAR(s.distance, -0.05, 1e-12);
  EXPECT_NEAR(s.normal.y(), -1, 1e-9);
  EXPECT_NEAR(side.facing({0.1, 0.05, 0.1}, Vector3d(0, 0.3, 0)).weight, 0.3, 1e-12);
}

// Beyond a plate of two layers is outside again.
TEST(MeshSide, SeesThroughAPlate) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const double y : {0.0, -0.02}) {
    const auto first = std::uint32_t(vertices.size());
    for (const auto& [x, z] :
         {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0), std::pair(-1.0, 1.0)})
      vertices.emplace_back(x, y, z);
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  const TriangleMesh mesh(vertices, triangles);
  edem::MeshSide side;
  side.look(mesh, {0, 0.1, 0.1}, 0.5);
  EXPECT_NEAR(side.nearest({0, -0.005, 0.1}).distance, -0.005, 1e-12);
  EXPECT_GT(side.nearest({0, -0.05, 0.1}).distance, 0);
}

// On a roof with a ridge along z: the weight's slope is its derivative, by differences.
TEST(MeshSide, SlopeIsTheDerivativeOfTheWeight) {
  const TriangleMesh mesh = terrain(2, [](double x, double) { return -0.5 * std::abs(x); });
  edem::MeshSide side;
  side.look(mesh, {0.1, 0.3, 0.05}, 0.9);
  const Vector3d area(0.2, -0.7, 0.1);
  constexpr double kStep = 1e-6;
  for (const Vector3d& p :
       {Vector3d(0.03, -0.1, 0.02), Vector3d(-0.05, -0.2, 0.3), Vector3d(0.2, -0.3, -0.1)}) {
    ASSERT_LT(side.nearest(p).distance, 0);
    const edem::Facing f = side.facing(p, area);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d by = kStep * Vector3d::Unit(axis);
      const double slope =
          (side.facing(p + by, area).weight - side.facing(p - by, area).weight) / (2 * kStep);
      EXPECT_NEAR(f.slope[axis], slope, 1e-6) << p.transpose() << ", " << axis;
    }
  }
}

}  // namespace
}  // namespace rubble::test
