// The restricted Voronoi diagram on sites we choose, and its tools.
#include <gtest/gtest.h>

#include <random>

#include "cook/hilbert.h"
#include "cook/restricted_voronoi.h"
#include "cook/site_pieces.h"
#include "cook/springs.h"
#include "cook/triangulation.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
using namespace cooking;
namespace {

std::vector<Eigen::Vector3d> lattice(int n) {
  std::vector<Eigen::Vector3d> sites;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) sites.push_back((Eigen::Vector3d(x, y, z).array() + 0.5) / n - 0.5);
  return sites;
}

// The worst input there is: every Voronoi vertex belongs to eight cells, and every bisector is parallel to
// the surface.
TEST(RestrictedVoronoi, CutsALatticeIntoCubes) {
  constexpr int n = 4;
  const CheckedMesh cube = checkMesh(boxMesh({1, 1, 1}));
  const RestrictedVoronoi diagram = restrictedVoronoi(cube, lattice(n), 1e-7, 1, {});
  const SitePieces pieces = findSitePieces(diagram);
  const double face = 1.0 / (n * n);
  const std::vector<AssetSpring> springs = findSprings(diagram, pieces, 0.02 * face);
  EXPECT_EQ(springs.size(), 3u * n * n * (n - 1));  // the slivers that the jitter makes are no springs
  for (const AssetSpring& spring : springs) EXPECT_NEAR(spring.area, face, 1e-5);
}

// Site 0 is at the left of the slot, and its cell reaches through the slot into the other leg.
TEST(RestrictedVoronoi, FindsThePieceThatHoldsTheSite) {
  const CheckedMesh mesh = checkMesh(test::you(0.01));
  const std::vector<Eigen::Vector3d> sites = {
      {0.9, 1.8, 0.25}, {1.7, 1.8, 0.25}, {0.5, 0.5, 0.25}, {1.5, 0.5, 0.25}};
  const RestrictedVoronoi diagram = restrictedVoronoi(mesh, sites, 1e-6, 1, {});
  const SitePieces pieces = findSitePieces(diagram);
  for (const AssetSpring& spring : findSprings(diagram, pieces, 0))
    EXPECT_FALSE(spring.first == 0 && spring.second == 1) << "a spring across the slot";
  bool hasForeignPiece = false;
  for (const std::uint32_t p : diagram.polygonsOf.of(0))
    hasForeignPiece = hasForeignPiece || !pieces.polygons[p];
  EXPECT_TRUE(hasForeignPiece);
}

TEST(RestrictedVoronoi, StaysClosedForManySeeds) {
  const CheckedMesh mesh = checkMesh(test::torus(1, 0.3, 24, 12));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::mt19937_64 generator(seed);
    const auto uniform = [&generator] { return double(generator() >> 11) * 0x1p-53; };
    std::vector<Eigen::Vector3d> sites;
    while (sites.size() < 150) {
      const Eigen::Vector3d p(2.6 * uniform() - 1.3, 2.6 * uniform() - 1.3, 0.6 * uniform() - 0.3);
      if (std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) < 0.28) sites.push_back(p);
    }
    int retries =
        0;  // restrictedVoronoi checks closedness and volume itself, and logs when it has to try again
    EXPECT_NO_THROW(
        restrictedVoronoi(mesh, sites, 1e-7, seed, [&](LogLevel, const std::string&) { ++retries; }));
    EXPECT_EQ(retries, 0) << "seed " << seed;
  }
}

TEST(RestrictedVoronoi, RefusesASurfaceThatPassesThroughItself) {
  const SurfaceMesh crossed = test::joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {0.37, 0.21, 0.13}));
  try {
    restrictedVoronoi(checkMesh(crossed), lattice(4), 1e-7, 1, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("passes through itself"), std::string::npos) << error.what();
  }
}

double areaOf(const std::vector<std::array<std::uint32_t, 3>>& triangles,
              const std::vector<Eigen::Vector3d>& places) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double area = (places[b] - places[a]).cross(places[c] - places[a]).z() / 2;
    EXPECT_GE(area, 0.0) << "a triangle lies upside down";
    sum += area;
  }
  return sum;
}

TEST(Triangulation, OfASquareWithTwoHolesKeepsItsArea) {
  const std::vector<Eigen::Vector3d> places = {{0, 0, 0}, {4, 0, 0},   {4, 4, 0},  {0, 4, 0},
                                               {1, 1, 0}, {1, 2, 0},   {2, 2, 0},  {2, 1, 0},
                                               {3, 3, 0}, {3, 3.5, 0}, {3.5, 3, 0}};
  const std::vector<Loop> loops = {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangulate(loops, places, Eigen::Vector3d::UnitZ(), triangles);
  EXPECT_NEAR(areaOf(triangles, places), 16 - 1 - 0.125, 1e-12);
  EXPECT_EQ(triangles.size(), 11u + 2 * 2 - 2);  // n + 2 holes - 2
}

TEST(Triangulation, OfACombKeepsItsArea) {
  std::vector<Eigen::Vector3d> places;
  Loop loop;
  for (int tooth = 0; tooth < 10; ++tooth) {  // teeth 1 wide and 3 high, gaps 1 wide and 2 deep
    const int x = 2 * tooth;
    for (const auto& [px, py] : {std::pair(x, 3), {x + 1, 3}, {x + 1, 1}, {x + 2, 1}})
      places.emplace_back(px, py, 0);
  }
  places.emplace_back(20, 0, 0);
  places.emplace_back(0, 0, 0);
  for (std::size_t k = places.size(); k-- > 0;) loop.push_back(std::uint32_t(k));
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangulate(std::span(&loop, 1), places, Eigen::Vector3d::UnitZ(), triangles);
  EXPECT_NEAR(areaOf(triangles, places), 20 * 1 + 10 * 2, 1e-12);
}

TEST(Triangulation, OfTwoSeparateSquaresFillsBoth) {
  const std::vector<Eigen::Vector3d> places = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                               {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}};
  const std::vector<Loop> loops = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangulate(loops, places, Eigen::Vector3d::UnitZ(), triangles);
  EXPECT_NEAR(areaOf(triangles, places), 2, 1e-12);
}

// The defining property of the curve: on a full lattice of 2^k places every step goes to a neighbour.
TEST(HilbertOrder, StepsToANeighbourOnALattice) {
  const std::vector<Eigen::Vector3d> places = lattice(8);
  const std::vector<std::uint32_t> order = hilbertOrder(places);
  ASSERT_EQ(order.size(), places.size());
  for (std::size_t k = 1; k < order.size(); ++k)
    EXPECT_NEAR((places[order[k]] - places[order[k - 1]]).norm(), 1.0 / 8, 1e-12);
}

}  // namespace
}  // namespace rubble::test
