// One fault of a surface a test: what repair makes of it, and what it says.
#include "rubble/repair.h"

#include <gtest/gtest.h>

#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

using testing::Test;

const Eigen::Vector3d kUnit(1, 1, 1);

SurfaceMesh unwelded(const SurfaceMesh& mesh) {
  SurfaceMesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto first = std::uint32_t(soup.vertices.size());
    for (const std::uint32_t v : triangle) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// Vertices at the same place are one.
SurfaceMesh welded(SurfaceMesh mesh) {
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& v : triangle)
      v = std::uint32_t(std::find(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices[v]) -
                        mesh.vertices.begin());
  return mesh;
}

SurfaceMesh flipped(SurfaceMesh mesh, const std::vector<std::size_t>& triangles) {
  for (const std::size_t t : triangles) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return mesh;
}

// A unit cube about the origin without its side z = 1/2.
SurfaceMesh openBox() {
  SurfaceMesh mesh = boxMesh(kUnit);
  mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);
  return mesh;
}

using Lines = std::vector<std::string>;

// Mended, with these words, into a solid of this volume, which can be cooked to it.
void expectMended(const SurfaceMesh& mesh, const Lines& done, double volume,
                  const RepairOptions& options = {}) {
  const RepairedMesh repaired = repair(mesh, options);
  EXPECT_EQ(repaired.done, done);
  EXPECT_EQ(repaired.left, Lines());
  EXPECT_EQ(repaired.fault, "");
  EXPECT_NEAR(volumeOf(repaired.mesh), volume, 1e-12 * volume);
  ExpectedWarnings warnings;
  const Asset asset = cook(repaired.mesh, optionsFor(60), {}, warnings.log());
  EXPECT_NEAR(asset.volume(), volume, 1e-9 * volume);
  for (const char* text : {"would fill it", "thinner than the elements", "protrudes", "too few elements"})
    warnings.take(text);
}

void expectLeft(const SurfaceMesh& mesh, const std::string& words) {
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.fault.find(words), 0u) << repaired.fault;
  EXPECT_THROW(cook(repaired.mesh, optionsFor(60)), Error);
}

TEST(Repair, LeavesAGoodMeshAsItIs) {
  for (const SurfaceMesh& mesh : {boxMesh(kUnit), ell(), tilted(torus(1, 0.3, 32, 16)), hollowCube(),
                                  joined(boxMesh(kUnit), boxMesh(kUnit, {2, 0, 0}))}) {
    const RepairedMesh repaired = repair(mesh);
    EXPECT_EQ(repaired.done, Lines());
    EXPECT_EQ(repaired.left, Lines());
    EXPECT_EQ(repaired.fault, "");
    EXPECT_EQ(repaired.mesh.vertices, mesh.vertices);
    EXPECT_EQ(repaired.mesh.triangles, mesh.triangles);
  }
}

TEST(Repair, WeldsASoup) {
  expectMended(unwelded(boxMesh(kUnit)), {"welded 36 corners to 8"}, 1);
}

// Each corner is up to 1e-7 m away from where it should be: the diagonal is 1.7 m, and a millionth of it is
// near.
TEST(Repair, WeldsCornersThatAreNearlyAtTheSamePlace) {
  SurfaceMesh soup = unwelded(boxMesh(kUnit));
  for (std::size_t v = 0; v < soup.vertices.size(); ++v) soup.vertices[v].x() += 1e-8 * double(v % 11);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.done, Lines{"welded 36 corners to 8"});
  EXPECT_EQ(repaired.left, Lines());
  EXPECT_NEAR(volumeOf(repaired.mesh), 1, 1e-6);

  RepairOptions exact;
  exact.weldDistance = 0;
  EXPECT_FALSE(repair(soup, exact).fault.empty());
}

TEST(Repair, TurnsTrianglesAsTheOthers) {
  expectMended(flipped(boxMesh(kUnit), {0, 3, 7}), {"turned 3 triangles"}, 1);
  expectMended(flipped(ell(), {5}), {"turned 1 triangle"}, 1.5);
}

TEST(Repair, TurnsAShellOutwards) {
  expectMended(reversed(boxMesh(kUnit)), {"turned 12 triangles"}, 1);
  expectMended(joined(boxMesh(kUnit), reversed(boxMesh(kUnit, {2, 0, 0}))), {"turned 12 triangles"}, 2);
}

TEST(Repair, TurnsAShellInsideAnotherInwards) {
  expectMended(joined(boxMesh(kUnit), boxMesh(kUnit / 2)), {"turned 12 triangles"}, 0.875);
}

TEST(Repair, FillsAHole) {
  expectMended(openBox(), {"filled 1 hole of 4 edges, 1 m^2"}, 1);
  SurfaceMesh oneGone = boxMesh(kUnit);
  oneGone.triangles.pop_back();
  expectMended(oneGone, {"filled 1 hole of 3 edges, 0.5 m^2"}, 1);
}

// The flat top of a ball: a polygon of 64 corners.
TEST(Repair, FillsARoundHole) {
  const SurfaceMesh whole = ball(1, 32);
  SurfaceMesh open = whole;
  const double top = std::cos(3 * std::numbers::pi / 32);  // the third ring
  const double radius = std::sin(3 * std::numbers::pi / 32);
  double cap = 0;  // of cones from the middle of the hole to what is taken away
  std::erase_if(open.triangles, [&](const auto& triangle) {
    for (const std::uint32_t v : triangle)
      if (open.vertices[v].z() < top - 1e-9) return false;
    const Eigen::Vector3d middle(0, 0, top);
    cap += (open.vertices[triangle[0]] - middle)
               .dot((open.vertices[triangle[1]] - middle).cross(open.vertices[triangle[2]] - middle)) /
           6;
    return true;
  });
  const RepairedMesh repaired = repair(open);
  ASSERT_EQ(repaired.done.size(), 1u);
  EXPECT_EQ(repaired.done[0].find("filled 1 hole of 64 edges, "), 0u) << repaired.done[0];
  EXPECT_EQ(repaired.left, Lines());
  EXPECT_NEAR(volumeOf(repaired.mesh), volumeOf(whole) - cap, 1e-9);
  double area = 0;
  for (std::size_t t = open.triangles.size(); t < repaired.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = repaired.mesh.triangles[t];
    const auto& p = repaired.mesh.vertices;
    area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
  }
  // A regular polygon of 64 corners.
  EXPECT_NEAR(area, 32 * radius * radius * std::sin(2 * std::numbers::pi / 64), 1e-9);
}

// Two or three sides of a box are a bent sheet, and what it should hold is a guess.
TEST(Repair, LeavesLargeHolesOpen) {
  SurfaceMesh sheet = boxMesh(kUnit);
  sheet.triangles.resize(6);
  for (const std::size_t first : {0u, 2u}) {  // the second has lost one of three sides
    sheet.triangles.erase(sheet.triangles.begin(), sheet.triangles.begin() + std::ptrdiff_t(first));
    expectLeft(sheet, "mesh: not closed");
    EXPECT_EQ(repair(sheet).left[0].find("left open 1 hole of "), 0u);
  }
  RepairOptions options;
  options.mostHoleEdges = 3;
  EXPECT_EQ(repair(openBox(), options).left[0],
            "left open 1 hole of 4 edges, 1 m^2; too large to be closed by guess");
  options = {};
  options.largestHole = 0.19;  // it is a fifth of the five sides
  EXPECT_EQ(repair(openBox(), options).left.size(), 1u);
  options.largestHole = 0.21;
  EXPECT_EQ(repair(openBox(), options).left.size(), 0u);
}

TEST(Repair, LeavesOutTrianglesThatStandTwice) {
  SurfaceMesh twice = boxMesh(kUnit);
  twice.triangles.push_back(twice.triangles[4]);
  twice.triangles.push_back({twice.triangles[5][2], twice.triangles[5][1], twice.triangles[5][0]});
  twice.triangles.push_back(twice.triangles[5]);
  expectMended(twice, {"left out 3 triangles that stood twice"}, 1);
  SurfaceMesh allTwice = boxMesh(kUnit);
  const auto once = allTwice.triangles;
  allTwice.triangles.insert(allTwice.triangles.end(), once.begin(), once.end());
  expectMended(allTwice, {"left out 12 triangles that stood twice"}, 1);
  const SurfaceMesh bothWays = welded(joined(boxMesh(kUnit), reversed(boxMesh(kUnit))));
  expectMended(bothWays, {"left out 12 triangles that stood twice"}, 1);
}

// Two cubes share a wall of two triangles each.
TEST(Repair, LeavesOutWallsWithinTheSolid) {
  SurfaceMesh right = reversed(boxMesh(kUnit));
  for (Eigen::Vector3d& vertex : right.vertices) vertex.x() = 1 - vertex.x();  // mirrored: the same diagonal
  expectMended(welded(joined(boxMesh(kUnit), right)), {"left out 4 triangles that stood twice"}, 2);
}

TEST(Repair, LeavesOutTrianglesWithoutArea) {
  SurfaceMesh mesh = boxMesh(kUnit);
  mesh.triangles.push_back({0, 0, 3});
  mesh.vertices.push_back((mesh.vertices[0] + mesh.vertices[3]) / 2);
  mesh.triangles.push_back({0, 8, 3});
  expectMended(mesh, {"left out 2 triangles without area"}, 1);
}

// One of the two triangles at an edge is two, with a corner in the middle of the edge.
TEST(Repair, CutsTrianglesAtCornersOnTheirEdges) {
  SurfaceMesh mesh = boxMesh(kUnit);
  mesh.vertices.push_back((mesh.vertices[0] + mesh.vertices[2]) / 2);
  mesh.triangles[0] = {0, 8, 3};
  mesh.triangles.push_back({8, 2, 3});
  expectMended(mesh, {"cut 1 triangle at corners that lie on their edges"}, 1);
}

// Two cubes in file formats without indices share an edge; each keeps its own.
TEST(Repair, PartsCubesThatShareAnEdge) {
  const SurfaceMesh cubes = welded(joined(boxMesh(kUnit), boxMesh(kUnit, {1, 1, 0})));
  EXPECT_THROW(cook(cubes, optionsFor(60)), Error);
  expectMended(cubes, {"parted 1 edge of more than two triangles"}, 2);
}

// 1 + 1 - 0.5 * 0.7 * 0.8 by inclusion and exclusion.
TEST(Repair, UnitesPartsThatOverlap) {
  const SurfaceMesh boxes = joined(boxMesh(kUnit), boxMesh(kUnit, {0.5, 0.3, 0.2}));
  expectMended(boxes, {"united 2 parts that overlap or touch to 1"}, 1.72);
  expectMended(joined(boxMesh(kUnit), reversed(boxMesh(kUnit, {0.5, 0.3, 0.2}))),
               {"united 2 parts that overlap or touch to 1", "turned 12 triangles"}, 1.72);
}

// Bars along the three axes, 3 m long and 1 m wide: 3 * 3 less twice the cube that is in all of them.
TEST(Repair, UnitesBarsThroughEachOther) {
  const SurfaceMesh cross = joined(joined(boxMesh({3, 1, 1}), boxMesh({1, 3, 1})),
                                   joined(boxMesh({1, 1, 3}), boxMesh(kUnit, {5, 0, 0})));
  expectMended(cross, {"united 3 parts that overlap or touch to 1"}, 8);
}

TEST(Repair, UnitesPartsThatShareAFace) {
  expectMended(joined(boxMesh(kUnit), boxMesh(kUnit, {1, 0, 0})),
               {"united 2 parts that overlap or touch to 1"}, 2);
  expectMended(joined(boxMesh({3, 1, 3}), boxMesh(kUnit, {0.25, 1, 0.5})),
               {"united 2 parts that overlap or touch to 1"}, 10);
}

// Its wall is 0.25 m thick; a bar 0.1 m wide goes through the wall and 0.25 m into the cavity and outside.
TEST(Repair, KeepsACavityThatAPartReachesInto) {
  expectMended(joined(hollowCube(), boxMesh({0.75, 0.1, 0.1}, {0.375, 0, 0})),
               {"united 2 parts that overlap or touch to 1"}, 0.875 + 0.5 * 0.01);
}

// A part that only touches stays to the last bit, with its numbers, where others are united.
TEST(Repair, LeavesPartsThatNoneOverlapsToTheLastBit) {
  const SurfaceMesh lone = tilted(torus(0.3, 0.1, 12, 8));
  const SurfaceMesh mesh = joined(joined(lone, boxMesh(kUnit, {5, 0, 0})), boxMesh(kUnit, {5.5, 0.3, 0.2}));
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.done, Lines{"united 2 parts that overlap or touch to 1"});
  for (std::size_t t = 0; t < lone.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(repaired.mesh.vertices[repaired.mesh.triangles[t][k]], lone.vertices[lone.triangles[t][k]]);
}

TEST(Repair, TellsOfPartsThatOverlapWhereTheyAreNotToBeUnited) {
  RepairOptions options;
  options.unite = false;
  const RepairedMesh repaired = repair(joined(boxMesh(kUnit), boxMesh(kUnit, {0.5, 0.3, 0.2})), options);
  EXPECT_EQ(repaired.done, Lines());
  ASSERT_EQ(repaired.left.size(), 1u);
  EXPECT_EQ(repaired.left[0].find("passes through itself: "), 0u) << repaired.left[0];
}

TEST(Repair, LeavesCubesThatTouchAtAnEdge) {
  const SurfaceMesh cubes = joined(boxMesh(kUnit), boxMesh(kUnit, {1, 1, 0}));
  const RepairedMesh repaired = repair(cubes);
  EXPECT_EQ(repaired.done, Lines());
  EXPECT_EQ(repaired.left, Lines());
}

TEST(Repair, MendsSeveralFaultsAtOnce) {
  SurfaceMesh mesh = unwelded(flipped(openBox(), {2, 5}));
  mesh.triangles.push_back(mesh.triangles[1]);
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.done, (Lines{"welded 30 corners to 8", "left out 1 triangle that stood twice",
                                  "filled 1 hole of 4 edges, 1 m^2", "turned 2 triangles"}));
  EXPECT_EQ(repaired.left, Lines());
  EXPECT_NEAR(volumeOf(repaired.mesh), 1, 1e-12);
}

// A Klein bottle has one side: a tube whose ends are joined the wrong way round.
TEST(Repair, CannotTurnASurfaceWithOneSide) {
  constexpr std::uint32_t kAround = 12, kAcross = 8;
  SurfaceMesh bottle = torus(1, 0.3, kAround, kAcross);
  for (std::size_t t = bottle.triangles.size() - 2 * kAcross; t < bottle.triangles.size(); ++t)
    for (std::uint32_t& v : bottle.triangles[t])
      if (v < kAcross) v = (kAcross - v) % kAcross;
  expectLeft(bottle, "mesh: inconsistent orientation");
}

// A sheet stands on the side of a box, open all around.
TEST(Repair, CannotMendAnEdgeOfThreeTriangles) {
  SurfaceMesh mesh = boxMesh(kUnit);
  mesh.vertices.emplace_back(0, 0, 2);
  mesh.triangles.push_back({4, 5, 8});
  expectLeft(mesh, "mesh: not manifold");
}

// A corner of a cube, pushed through the opposite side.
TEST(Repair, TellsOfAPartThatPassesThroughItself) {
  SurfaceMesh mesh = boxMesh(kUnit);
  mesh.vertices[7] = {-0.3, -0.2, -1.5};
  const RepairedMesh repaired = repair(mesh);
  ASSERT_EQ(repaired.left.size(), 1u);
  EXPECT_EQ(repaired.left[0].find("passes through itself: "), 0u) << repaired.left[0];
  expectLeft(mesh, "mesh: passes through itself: ");
}

TEST(Repair, RefusesWhatIsNoSurface) {
  SurfaceMesh mesh = boxMesh(kUnit);
  mesh.vertices[3].x() = std::nan("");
  EXPECT_THROW(repair(mesh), Error);
  mesh = boxMesh(kUnit);
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(repair(mesh), Error);
  EXPECT_THROW(repair({}), Error);
  RepairOptions options;
  options.weldDistance = 0.02;
  EXPECT_THROW(repair(boxMesh(kUnit), options), Error);
}

// Texture coordinates are x and y.
TEST(Repair, KeepsTheLookOfWhatIsKept) {
  SurfaceMesh mesh = joined(boxMesh(kUnit), boxMesh({0.5, 0.5, 0.5}, {0.3, 0.2, 0.5}));
  mesh.materialNames = {"a", "b"};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.materials.push_back(t < 12 ? 0 : 1);
    auto& uvs = mesh.uvs.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) uvs[k] = mesh.vertices[mesh.triangles[t][k]].head<2>().cast<float>();
  }
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.done, Lines{"united 2 parts that overlap or touch to 1"});
  ASSERT_EQ(repaired.mesh.uvs.size(), repaired.mesh.triangles.size());
  ASSERT_EQ(repaired.mesh.materials.size(), repaired.mesh.triangles.size());
  EXPECT_EQ(repaired.mesh.materialNames, mesh.materialNames);
  std::array<double, 2> areas = {0, 0};
  for (std::size_t t = 0; t < repaired.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = repaired.mesh.triangles[t];
    const auto& p = repaired.mesh.vertices;
    areas[repaired.mesh.materials[t]] += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    for (std::size_t k = 0; k < 3; ++k)  // linear all over: also at the corners that are new
      EXPECT_LT((repaired.mesh.uvs[t][k] - p[repaired.mesh.triangles[t][k]].head<2>().cast<float>()).norm(),
                1e-6);
  }
  // The small box reaches 0.45 x 0.5 x 0.25 m into the large one, through its sides x and z = 1/2.
  EXPECT_NEAR(areas[0], 6 - 0.45 * 0.5 - 0.5 * 0.25, 1e-9);
  EXPECT_NEAR(areas[1], 1.5 - 0.45 * 0.5 - 0.5 * 0.25 - 2 * 0.45 * 0.25, 1e-9);
}

TEST(Repair, TurnsGivenNormalsWithTheirTriangles) {
  SurfaceMesh mesh = reversed(boxMesh(kUnit));
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& p = mesh.vertices;
    const Eigen::Vector3f inwards = (p[b] - p[a]).cross(p[c] - p[a]).normalized().cast<float>();
    mesh.normals.push_back({inwards, inwards, inwards});
  }
  const SurfaceMesh turned = repair(mesh).mesh;
  ASSERT_EQ(turned.normals.size(), 12u);
  for (std::size_t t = 0; t < 12; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_GT(turned.normals[t][k].dot(turned.vertices[turned.triangles[t][k]].cast<float>()), 0);
}

TEST(Repair, FillsWithTheMaterialBesideTheHole) {
  SurfaceMesh mesh = openBox();
  mesh.materialNames = {"a", "b"};
  mesh.materials.assign(mesh.triangles.size(), 1);
  mesh.uvs.assign(mesh.triangles.size(),
                  {Eigen::Vector2f(1, 2), Eigen::Vector2f(1, 2), Eigen::Vector2f(1, 2)});
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.done, Lines{"filled 1 hole of 4 edges, 1 m^2, without normals and texture coordinates"});
  EXPECT_EQ(repaired.mesh.materials, std::vector<std::uint16_t>(12, 1));
  EXPECT_EQ(repaired.mesh.uvs.front()[0], Eigen::Vector2f(1, 2));
  EXPECT_EQ(repaired.mesh.uvs.back()[0], Eigen::Vector2f(0, 0));
}

}  // namespace
}  // namespace rubble::test
