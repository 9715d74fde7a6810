// Solids that a scene names: closed, outward, of the size and the volume that geometry says, and refused
// where they would be none.
#include "demo/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "cook/checked_mesh.h"
#include "cook/parts.h"
#include "demo/implicit_mesh.h"
#include "demo/input_error.h"
#include "demo/statue_mesh.h"
#include "scenes/scene_file.h"
#include "support/strict_cook.h"

namespace rubble::test {
namespace {

using cooking::CheckedMesh;
using cooking::checkMesh;
using demo::SceneObject;

constexpr double kPi = std::numbers::pi;

demo::Scene sceneOf(const std::string& keys) {
  const TestFolder folder;
  return demo::loadScene(folder.write("scene.json", "{\"objects\": [{" + keys + "}]}"));
}

SceneObject objectOf(const std::string& keys) {
  return sceneOf(keys).objects.front();
}

// Area of the regular polygon of n corners on a circle, over the square of its radius.
double polygon(double n) {
  return n / 2 * std::sin(2 * kPi / n);
}

// Integral of the squared radius over the height of a profile of straight parts: of frusta, over pi.
double frusta(const std::vector<Eigen::Vector2d>& profile) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto& [a, b] = std::pair(profile[i], profile[i + 1]);
    sum += (b.y() - a.y()) * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 3;
  }
  return sum;
}

// Of a ball of diameter 1 with its vertices on the sphere.
double facettedBall(int segments) {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= segments / 2; ++i) {
    const double angle = kPi * i / (segments / 2);
    profile.emplace_back(std::sin(angle) / 2, -std::cos(angle) / 2);
  }
  return polygon(segments) * frusta(profile);
}

struct Case {
  std::string name, keys;
  Eigen::Vector3d size;
  double volume;  // [m^3]
  int euler;      // 2 - 2 x handles
};

std::vector<Case> cases() {
  // Pappus: area of the tube's polygon times the way around, which is one of straight parts too.
  const double torus = 2 * polygon(16) * polygon(16) * (0.35 * 0.15 * 0.15) * 2;
  return {
      {"box", R"("size": [1, 2, 0.5])", {1, 2, 0.5}, 1, 2},
      {"cylinder",
       R"("shape": "cylinder", "size": [1, 2, 0.5], "segments": 12)",
       {1, 2, 0.5},
       polygon(12) * 0.5 * 0.25 * 2,
       2},
      {"sphere",
       R"("shape": "sphere", "size": [1, 2, 0.5], "segments": 16)",
       {1, 2, 0.5},
       facettedBall(16),
       2},
      {"torus", R"("shape": "torus", "size": [1, 0.3, 2], "segments": 16)", {1, 0.3, 2}, torus, 0},
      {"column",
       R"("shape": "column", "size": [0.4, 1.6, 0.5], "shaft": 0.26, "plinth": 0.2, "segments": 12)",
       {0.4, 1.6, 0.5},
       2 * 0.4 * 0.5 * 0.2 + polygon(12) * 0.13 * 0.13 * 1.2,
       2},
      {"column of chosen parts",
       R"("shape": "column", "size": [0.4, 1.6, 0.5])",
       {0.4, 1.6, 0.5},
       2 * 0.4 * 0.5 * 0.16 + polygon(32) * 0.12 * 0.12 * 1.28,
       2},
      {"slab", R"("shape": "slab", "size": [2, 1, 0.1])", {2, 1, 0.1}, 0.2, 2},
      {"slab with two windows side by side and one that is higher",
       R"("shape": "slab", "size": [2, 1, 0.1],
          "openings": [[0.2, 0.3, 0.4, 0.4], [0.8, 0.3, 0.4, 0.4], [1.4, 0.25, 0.3, 0.6]])",
       {2, 1, 0.1},
       0.1 * (2 - 0.16 - 0.16 - 0.18),
       -4},
      {"slab with a door, a corner cut off and a window",
       R"("shape": "slab", "size": [2, 1, 0.1],
          "openings": [[0.5, 0, 0.3, 0.7], [1.8, 0.7, 0.2, 0.3], [1.2, 0.3, 0.3, 0.3]])",
       {2, 1, 0.1},
       0.1 * (2 - 0.21 - 0.06 - 0.09),
       0},
      {"course of bricks",
       R"("shape": "brick_course", "size": [0.25, 0.06, 0.12], "bricks": 4, "joint": 0.01)",
       {1.03, 0.06, 0.12},
       4 * 0.25 * 0.06 * 0.12,
       4 * 2},
      // One joint more, in what was brick.
      {"course of bricks that begins and ends with a half",
       R"("shape": "brick_course", "size": [0.25, 0.06, 0.12], "bricks": 4, "joint": 0.01, "offset": 0.5)",
       {1.03, 0.06, 0.12},
       (4 * 0.25 - 0.01) * 0.06 * 0.12,
       5 * 2},
  };
}

TEST(Primitive, IsClosedAndOutwardWithItsHandlesVolumeAndSize) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    // Throws where an edge has not two triangles, where two neighbours disagree, and where it is inside out.
    const CheckedMesh mesh = checkMesh(demo::primitiveMesh(objectOf(c.keys)));
    EXPECT_EQ(int(mesh.vertices.size()) - int(mesh.edges.size()) + int(mesh.triangles.size()), c.euler);
    EXPECT_NEAR(mesh.volume, c.volume, 1e-12);
    EXPECT_LT((mesh.bounds.sizes() - c.size).norm(), 1e-12) << mesh.bounds.sizes().transpose();
    EXPECT_LT(mesh.bounds.center().norm(), 1e-12);
  }
}

// Facets on a circle of n corners leave out (2 pi / n)^2 / 6 of its area, and as much again in the other
// direction: 1e-4 at 256.
TEST(Primitive, ComesCloseToTheSmoothSolid) {
  const auto volume = [](const std::string& keys) {
    return checkMesh(demo::primitiveMesh(objectOf(keys + R"(, "segments": 256)"))).volume;
  };
  EXPECT_NEAR(volume(R"("shape": "cylinder", "size": [1, 2, 1])") / (kPi * 0.25 * 2), 1, 3e-4);
  EXPECT_NEAR(volume(R"("shape": "sphere", "size": [1, 1, 1])") / (kPi / 6), 1, 3e-4);
  EXPECT_NEAR(volume(R"("shape": "torus", "size": [1, 0.3, 1])") / (2 * kPi * kPi * 0.35 * 0.15 * 0.15), 1,
              3e-4);
}

// Elements of one solid hang together; a warning of the cook fails the test.
TEST(Primitive, CooksIntoAsManyElementsAsAskedFor) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    SceneObject object = objectOf(c.keys);
    CookOptions options;
    options.elements = 400;
    const Asset asset = cookStrictly(demo::primitiveMesh(object), options);
    EXPECT_EQ(asset.elementCount(), 400u);
    EXPECT_NEAR(asset.volume(), c.volume, 1e-9 * c.volume);
  }
}

// The field is looked at half way between the planes of this grid, so nothing of the polygoniser is used.
double volumeOfStatueField() {
  constexpr double kStep = 0.01;
  double inside = 0;
  for (double x = -0.3 + kStep / 2; x < 0.3; x += kStep)
    for (double y = -0.05 + kStep / 2; y < 1.05; y += kStep)
      for (double z = -0.3 + kStep / 2; z < 0.3; z += kStep) inside += demo::statueField({x, y, z}) < 0;
  return inside * kStep * kStep * kStep;
}

// A hand on the hip is the one handle. Facets of 2 cm leave out a little of the limbs; tetrahedra cut half a
// spacing off two edges of the foot.
TEST(Primitive, StatueIsClosedWithOneHandleAndAFlatFoot) {
  const CheckedMesh mesh = checkMesh(
      demo::primitiveMesh(objectOf(R"("shape": "statue", "size": [0.49, 1, 0.34], "anchor": [0, -1, 0])")));
  EXPECT_EQ(int(mesh.vertices.size()) - int(mesh.edges.size()) + int(mesh.triangles.size()), 0);
  EXPECT_LT((mesh.bounds.sizes() - Eigen::Vector3d(0.49, 1, 0.34)).norm(), 1e-12);
  EXPECT_NEAR(mesh.volume / volumeOfStatueField(), 1, 0.02);
  double foot = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& v = mesh.vertices;
    if (std::max({v[a].y(), v[b].y(), v[c].y()}) < -0.5 + 1e-9)
      foot += (v[b] - v[a]).cross(v[c] - v[a]).norm() / 2;
  }
  EXPECT_NEAR(foot, 0.33 * 0.33, 1e-4);
}

// Edges of the triangles are no longer than those of the tetrahedra, L = sqrt(3) h, so their middles lie less
// than L^2 / (6 R) under a surface of radius R: with h = 0.1 under the ball's 0.005, 1.5 % of its volume, and
// under the torus' tube 0.017, 11 %. The box has its planes half way between the samples; of its 12 edges
// of 1.8 at most a strip of 0.05^2 / 2 is cut off.
TEST(Implicit, BallTorusAndBoxAreClosedAndOfTheRightVolume) {
  const demo::SampleGrid grid = {Eigen::Vector3d::Constant(-1.25), 0.1, {26, 26, 26}};
  const auto check = [&](const demo::Field& field, double volume, double error, int euler) {
    const CheckedMesh mesh = checkMesh(demo::implicitMesh(field, grid));
    EXPECT_EQ(int(mesh.vertices.size()) - int(mesh.edges.size()) + int(mesh.triangles.size()), euler);
    EXPECT_NEAR(mesh.volume / volume, 1, error);
  };
  check([](const Eigen::Vector3d& p) { return p.norm() - 1; }, 4 * kPi / 3, 0.015, 2);
  check([](const Eigen::Vector3d& p) { return std::hypot(std::hypot(p.x(), p.z()) - 0.7, p.y()) - 0.3; },
        2 * kPi * kPi * 0.7 * 0.09, 0.11, 0);
  check([](const Eigen::Vector3d& p) { return p.cwiseAbs().maxCoeff() - 0.9; }, 1.8 * 1.8 * 1.8, 5e-3, 2);
}

// Low and high end of each brick along x, in order.
std::vector<Eigen::Vector2d> bricksOf(const std::string& keys) {
  const SurfaceMesh mesh = demo::primitiveMesh(
      objectOf(R"("shape": "brick_course", "size": [0.2, 0.06, 0.1], "bricks": 3, "joint": 0.02)" + keys));
  std::vector<Eigen::Vector2d> bricks;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double x = mesh.vertices[v].x();
    if (v % 8 == 0) bricks.emplace_back(x, x);
    bricks.back() = {std::min(bricks.back()[0], x), std::max(bricks.back()[1], x)};
  }
  return bricks;
}

// 3 bricks of 0.2 m and 2 joints of 0.02 m take 0.64 m. A half is what two halves and a joint make a brick
// of.
TEST(Primitive, BricksLieAJointApartAndHalvesEndTheNextCourse) {
  const auto check = [](const std::vector<Eigen::Vector2d>& bricks,
                        const std::vector<Eigen::Vector2d>& expected) {
    ASSERT_EQ(bricks.size(), expected.size());
    for (std::size_t k = 0; k < bricks.size(); ++k) EXPECT_LT((bricks[k] - expected[k]).norm(), 1e-12) << k;
  };
  check(bricksOf(""), {{-0.32, -0.12}, {-0.1, 0.1}, {0.12, 0.32}});
  check(bricksOf(R"(, "offset": 0.5)"), {{-0.32, -0.23}, {-0.21, -0.01}, {0.01, 0.21}, {0.23, 0.32}});
  check(bricksOf(R"(, "offset": 0.25)"), {{-0.32, -0.285}, {-0.265, -0.065}, {-0.045, 0.155}, {0.175, 0.32}});
}

// Springs tie each brick to itself alone: as many parts as bricks.
TEST(Primitive, BricksOfACourseArePartsOfTheirOwn) {
  for (const auto& [offset, bricks] : {std::pair("0", 4u), std::pair("0.5", 5u)}) {
    CookOptions options;
    options.elements = 200;
    const Asset asset = cookStrictly(
        demo::primitiveMesh(objectOf(R"("shape": "brick_course", "size": [0.25, 0.06, 0.12], "offset": )" +
                                     std::string(offset))),
        options);
    EXPECT_EQ(cooking::countTied(asset.elementCount(), asset.springs), bricks);
  }
}

std::string refusalOf(const std::string& keys) {
  try {
    sceneOf(keys);
  } catch (const demo::InputError& error) {
    const std::string text = error.what();
    return text.substr(text.find("objects.0"));
  }
  return "accepted";
}

TEST(Primitive, IsRefusedWhereItWouldBeNone) {
  EXPECT_EQ(refusalOf(R"("shape": "torus", "size": [1, 0.5, 1])"),
            "objects.0.size: is [1, 0.5, 1], must have a y, the thickness of the ring, of at most 0.49, 0.49 "
            "of x and z");
  EXPECT_EQ(refusalOf(R"("shape": "sphere", "size": [1, 1, 1], "segments": 30)"),
            "objects.0.segments: is 30, must be a multiple of 4, 8 to 256");
  EXPECT_EQ(refusalOf(R"("shape": "sphere", "size": [1, 1, 1], "segments": 4)"),
            "objects.0.segments: is 4, must be a whole number 8 to 256");
  EXPECT_EQ(refusalOf(R"("shape": "column", "size": [0.4, 1, 0.5], "shaft": 0.4)"),
            "objects.0.shaft: is 0.4, must be at most 0.396, 0.99 of x and z of the size");
  EXPECT_EQ(refusalOf(R"("shape": "column", "size": [0.4, 1, 0.5], "plinth": 0.5)"),
            "objects.0.plinth: is 0.5, must be at most 0.49, 0.49 of y of the size");
  const std::string course = R"("shape": "brick_course", "size": [0.2, 0.06, 0.1], "joint": )";
  EXPECT_EQ(
      refusalOf(course + R"(0.05, "offset": 0.9)"),
      "objects.0.offset: is 0.9, must be 0, or 0.28 to 0.72, so that a tenth of a brick is left at both "
      "ends");
  EXPECT_EQ(refusalOf(course + R"(0.3, "offset": 0.5)"),
            "objects.0.offset: is 0.5, must be 0 where the joints are so wide");
  EXPECT_EQ(refusalOf(course + "0"), "objects.0.joint: is 0, must be 1e-04 to 100000");
  EXPECT_EQ(refusalOf(course + R"(0.01, "bricks": 0)"),
            "objects.0.bricks: is 0, must be a whole number 1 to 256");
  EXPECT_EQ(refusalOf(R"("size": [1, 1, 1], "bricks": 8)").find("objects.0.bricks: unknown key"), 0u);
  EXPECT_EQ(refusalOf(R"("size": [1, 1, 1], "segments": 8)").find("objects.0.segments: unknown key"), 0u);
  EXPECT_EQ(refusalOf(R"("shape": "slab", "size": [1, 1, 1], "segments": 8)")
                .find("objects.0.segments: unknown key"),
            0u);
}

TEST(Primitive, OpeningsLieApartInTheSlab) {
  const auto refusal = [](const std::string& openings) {
    const std::string text =
        refusalOf(R"("shape": "slab", "size": [2, 1, 0.1], "openings": [)" + openings + "]");
    const auto must = text.find("must");
    return must == text.npos ? text : text.substr(must);
  };
  EXPECT_EQ(refusal("[0.5, 0.5, 0.2, 0.2], [0.8, 0.5, 0.2, 0.2]"), "accepted");
  EXPECT_EQ(refusal("[0.5, 0.5, 0.2]"), "must have 4: [x, y, width, height]");
  EXPECT_EQ(refusal("[0.5, 0.5, 0.2, 0]"), "must be 1e-04 to 100000");
  EXPECT_EQ(refusal("[1.9, 0.5, 0.2, 0.2]"), "must end within the slab");
  EXPECT_EQ(refusal("[0.5, 0, 0.2, 1]"), "must not cut the slab in two");
  EXPECT_EQ(refusal("[0, 0.4, 2, 0.2]"), "must not cut the slab in two");
  EXPECT_EQ(refusal("[0.5, 0.0005, 0.2, 0.2]"),
            "must end at an edge of the slab or a thousandth of it before");
  // Corners that touch would be an edge of four faces.
  for (const char* second : {"[0.7, 0.7, 0.2, 0.2]", "[0.6, 0.6, 0.2, 0.2]", "[0.5, 0.5, 0.2, 0.2]"})
    EXPECT_EQ(refusal(std::string("[0.5, 0.5, 0.2, 0.2], ") + second),
              "must be a thousandth of the slab away from openings.0")
        << second;
}

}  // namespace
}  // namespace rubble::test
