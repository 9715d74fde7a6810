// What cook() promises as a whole: determinism, progress, and errors that name the fault.
#include <gtest/gtest.h>

#include <limits>

#include "cook/elements.h"
#include "rubble/repair.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

std::string bytesOf(const Asset& asset) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "rubble_cook_test_bytes.asset";
  save(asset, file);
  const std::string bytes = fileBytes(file);
  std::filesystem::remove(file);
  return bytes;
}

void expectError(const SurfaceMesh& mesh, const CookOptions& options, const std::string& words) {
  try {
    cook(mesh, options);
    FAIL() << "no error; expected: " << words;
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST(Cook, GivesTheSameBytesForTheSameSeed) {
  CookOptions options = optionsFor(200);
  const std::string first = bytesOf(cookStrictly(ell(), options));
  EXPECT_EQ(first, bytesOf(cookStrictly(ell(), options)));
  options.seed = 2;
  EXPECT_NE(first, bytesOf(cookStrictly(ell(), options)));
}

TEST(Cook, ReportsProgressThatOnlyGrows) {
  for (const std::size_t elements : {50u, 2u}) {  // two have to shrink, and packing begins again
    double last = 0;
    const auto progress = [&last](double share, const char* stage) {
      EXPECT_GE(share, last);
      EXPECT_NE(stage, nullptr);
      last = share;
    };
    ExpectedWarnings warnings;
    cook(boxMesh({1, 1, 1}), optionsFor(elements), progress, warnings.log());
    EXPECT_EQ(warnings.take("do not fit; radius"), elements == 2 ? 1 : 0);
    EXPECT_EQ(last, 1.0);
  }
}

// Without holes: what is long, an element's search for room and a candidate's climb, is told of one by one.
void expectFineShares(const std::vector<double>& shares, double until, std::size_t atLeast) {
  ASSERT_FALSE(shares.empty());
  EXPECT_LT(shares.front(), 0.01);
  std::size_t count = 0;
  for (std::size_t k = 1; k < shares.size() && shares[k] < until; ++k, ++count) {
    EXPECT_GE(shares[k], shares[k - 1]);
    EXPECT_LT(shares[k] - shares[k - 1], 0.05);
  }
  EXPECT_GE(count, atLeast);
}

TEST(Cook, TellsOfEachElementThatLooksForAPlace) {
  const cooking::CheckedMesh solid = cooking::checkMesh(ell());
  std::vector<double> random, even;
  cooking::Packer(solid, optionsFor(200), [&random](double share) { random.push_back(share); }).fill();
  expectFineShares(random, 0.5, 199);
  // Of three candidates an element in the volume and four on the surface.
  cooking::Packer(solid, optionsFor(200), [&even](double share) { even.push_back(share); }).fillEvenly();
  expectFineShares(even, 0.5, 7 * 200);
}

TEST(Cook, NamesItsStagesInOrder) {
  std::vector<std::string> stages;
  cook(ell(), optionsFor(50), [&stages](double, const std::string& stage) {
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
  });
  const std::vector<std::string> expected = {"checking the mesh", "measuring the walls", "packing",
                                             "cutting cells",     "building meshes",     "done"};
  EXPECT_EQ(stages, expected);
}

// There is no other way to end a cook early.
TEST(Cook, EndsWithWhatTheProgressThrows) {
  struct Enough {};
  for (const std::string wanted :
       {"checking the mesh", "measuring the walls", "packing", "cutting cells", "building meshes"})
    EXPECT_THROW(cook(table(0.1, 0.06), optionsFor(300),
                      [&wanted](double, const char* stage) {
                        if (wanted == stage) throw Enough();
                      }),
                 Enough);
}

// The wall has 2048 elements in 60 x 60 x 2.4 diameters; along the curve consecutive ones are a few spacings
// apart, in a random order they would be half a metre apart.
TEST(Cook, NumbersElementsAlongACurve) {
  const Asset wall = cookStrictly(wallMesh(), wallOptions());
  double sum = 0;
  for (std::size_t i = 1; i < wall.elementCount(); ++i)
    sum += (wall.positions[i] - wall.positions[i - 1]).norm();
  EXPECT_LT(sum / 2047, 2 * wall.spacing());
}

TEST(Cook, RefusesAnEmptyMesh) {
  expectError({}, {}, "empty");
  expectError({boxMesh({1, 1, 1}).vertices, {}}, {}, "empty");
}

TEST(Cook, RefusesNumbersThatAreNotFinite) {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  expectError(mesh, optionsFor(8), "vertex 3 is not finite");
  mesh.vertices[3].y() = std::numeric_limits<double>::infinity();
  expectError(mesh, optionsFor(8), "vertex 3 is not finite");
}

TEST(Cook, RefusesIndicesOutOfRange) {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  mesh.triangles[5][1] = 8;
  expectError(mesh, optionsFor(8), "index out of range: triangle 5 names vertex 8 of 8");
  mesh.triangles[5] = {1, 1, 2};
  expectError(mesh, optionsFor(8), "triangle 5 names vertex 1 twice");
}

TEST(Cook, RefusesAnOpenMesh) {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  mesh.triangles.pop_back();
  expectError(mesh, optionsFor(8), "not closed: the edge from (");
}

TEST(Cook, RefusesAnEdgeWithFourTriangles) {
  // Two cubes that touch in one edge, whose ends they share.
  SurfaceMesh mesh = joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {1, 1, 0}));
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& v : triangle) {
      if (v == 8) v = 3;   // (+, +, -) of the first is (-, -, -) of the second
      if (v == 12) v = 7;  // and the same above
    }
  expectError(mesh, optionsFor(8), "not manifold");
}

// Two cubes that share one vertex: repair parts it, and they are two parts tied to none.
TEST(Cook, RefusesAVertexOfTwoFans) {
  SurfaceMesh mesh = joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {1, 1, 1}));
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& v : triangle)
      if (v == 8) v = 7;  // (-, -, -) of the second is (+, +, +) of the first
  expectError(mesh, optionsFor(60), "touch in one corner alone, at (0.5, 0.5, 0.5), triangles ");
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.done, std::vector<std::string>{"parted 1 corner in which alone surfaces touched"});
  const Asset asset = cookStrictly(repaired.mesh, optionsFor(60));  // a tie between them would be warned of
  EXPECT_NEAR(asset.volume(), 2, 1e-9);
}

TEST(Cook, RefusesATriangleTurnedRound) {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  expectError(mesh, optionsFor(8), "inconsistent orientation");
}

TEST(Cook, RefusesAMeshInsideOut) {
  expectError(reversed(boxMesh({1, 1, 1})), optionsFor(8), "inward orientation");
}

TEST(Cook, RefusesAMeshWithoutVolume) {
  expectError({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, optionsFor(1), "zero volume");
}

TEST(Cook, IgnoresVerticesThatNoTriangleUses) {
  SurfaceMesh mesh = boxMesh({1, 1, 1});
  mesh.vertices.emplace_back(100, 0, 0);
  EXPECT_NEAR(cookStrictly(mesh, optionsFor(8)).volume(), 1, 1e-12);
}

TEST(Cook, CutsTrianglesWithoutArea) {
  SurfaceMesh mesh =
      boxMesh({1, 1, 1});  // triangles 0 and 1, {0, 2, 3} and {0, 3, 1}, meet in the diagonal 0-3
  const auto middle = std::uint32_t(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, -0.5);
  mesh.triangles[0] = {0, 2, 3};
  mesh.triangles.push_back({0, 3, middle});  // flat: its three corners are on the diagonal
  mesh.triangles[1] = {0, middle, 1};
  mesh.triangles.push_back({middle, 3, 1});
  const Asset asset = cookStrictly(mesh, optionsFor(60));
  EXPECT_NEAR(asset.volume(), 1, 1e-12);
}

TEST(Cook, RefusesImpossibleOptions) {
  const SurfaceMesh mesh = boxMesh({1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expectRefused = [&mesh](const std::string& words, auto change) {
    CookOptions options = optionsFor(8);
    change(options);
    expectError(mesh, options, words);
  };
  expectRefused("elements is 0; allowed: 1 to", [](CookOptions& o) { o.elements = 0; });
  expectRefused("elements is", [](CookOptions& o) { o.elements = 10'000'001; });
  expectRefused("radius is -1", [](CookOptions& o) { o.radius = -1; });
  expectRefused("radius is nan", [nan](CookOptions& o) { o.radius = nan; });
  expectRefused("fill is", [nan](CookOptions& o) { o.fill = nan; });
  expectRefused("fill is 0.9", [](CookOptions& o) { o.fill = 0.9; });
  expectRefused("maxOverlap is", [nan](CookOptions& o) { o.maxOverlap = nan; });
  expectRefused("maxIterations is 0", [](CookOptions& o) { o.maxIterations = 0; });
  expectRefused("minFaceArea is", [nan](CookOptions& o) { o.minFaceArea = nan; });
  expectRefused("anchorBand is", [nan](CookOptions& o) { o.anchorBand = nan; });
  expectRefused("anchorDirection is 0", [](CookOptions& o) { o.anchorDirection = Eigen::Vector3d::Zero(); });
}

TEST(Cook, SaysWhatFitsWhenTheElementsDoNot) {
  CookOptions options = optionsFor(8);
  options.radius = 0.6;
  expectError(boxMesh({1, 1, 1}), options, "times the mesh's volume");
  options.elements = 1;
  expectError(boxMesh({1, 1, 1}), options, "no sphere of radius 0.6 m fits");
  expectError(boxMesh({1, 1, 1}), options, "none of this radius fits, or a radius of about ");
  options.elements = 200;  // fills 0.84: less than the volume, more than any packing
  options.radius = 0.1;
  expectError(boxMesh({1, 1, 1}), options, "do not fit: they overlap by up to");
}

// The number named fits, and a fifth more does not.
TEST(Cook, NamesTheNumberThatFits) {
  struct Case {
    SurfaceMesh mesh;
    double radius;
  };
  for (const auto& [mesh, radius] :
       {Case{boxMesh({1, 1, 1}), 0.08}, Case{ball(1, 16), 0.18}, Case{boxMesh({1, 1, 0.1}), 0.045}}) {
    CookOptions options =
        optionsFor(std::size_t(0.95 * volumeOf(mesh) / (4.0 / 3 * std::numbers::pi * std::pow(radius, 3))));
    options.radius = radius;
    std::string text;
    try {
      cook(mesh, options);
    } catch (const Error& error) {
      text = error.what();
    }
    const std::size_t at = text.find("about ");
    ASSERT_NE(at, std::string::npos) << text;
    const auto count = std::size_t(std::stod(text.substr(at + 6)));
    options.elements = count;
    EXPECT_EQ(cook(mesh, options).elementCount(), count);
    options.elements = std::size_t(1.2 * double(count)) + 1;
    EXPECT_THROW(cook(mesh, options), Error) << text;
  }
}

// In the block 0.48 of its volume has room: 0.48 / (4/3 pi r^3) = 916.7. In the slab, whose spheres stand in
// one layer, 97 would be that share, and it may be fewer: never more, and never fewer than the 81 of a square
// lattice of 2 r 9 to a side, a tenth less for the steps.
TEST(Cook, TakesFewerElementsOfARadiusAlone) {
  CookOptions options = optionsFor(0);
  options.radius = 0.049;
  ExpectedWarnings warnings;
  const Asset asset = cook(boxMesh({1, 1, 0.1}), options, {}, warnings.log());
  EXPECT_EQ(asset.radius, 0.049);
  warnings.take("do not fit;");
  EXPECT_GE(asset.elementCount(), 72u);
  EXPECT_LE(asset.elementCount(), 97u);
  options.radius = 0.05;
  EXPECT_EQ(cook(boxMesh({1, 1, 1}), options).elementCount(), 917u);  // 0.48 of it
}

}  // namespace
}  // namespace rubble::test
