// Surfaces that are closed, but of which it cannot be said what is inside: refused with the place.
#include <gtest/gtest.h>

#include "cook/box_pairs.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

const Eigen::Vector3d kCube(1, 1, 1);

std::string refusalOf(const SurfaceMesh& mesh, std::size_t elements = 60) {
  try {
    cook(mesh, optionsFor(elements));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expectRefused(const SurfaceMesh& mesh, const std::vector<std::string>& words) {
  const std::string text = refusalOf(mesh);
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << ": " << text;
}

// Before the search for places, which went on for ever.
TEST(SurfaceCheck, NamesTwoSheetsInTheSamePlace) {
  expectRefused(joined(boxMesh(kCube), boxMesh(kCube)),
                {"two sheets of surface in the same place: triangles 0 and 12, of parts 0 and 1", "at (",
                 "remove one of them"});
  // They overlap by half, their sides lie in the same planes and no edge goes through a triangle.
  expectRefused(joined(boxMesh(kCube), boxMesh(kCube, {0.5, 0, 0})), {"face the same way"});
}

TEST(SurfaceCheck, NamesPartsThatCross) {
  expectRefused(joined(boxMesh(kCube), boxMesh(kCube, {0.37, 0.21, 0.13})),
                {"passes through itself: triangles ", "of parts 0 and 1, cross at (", "a repair unites"});
}

// A corner of a ball pulled through its other side.
TEST(SurfaceCheck, NamesAPartThatPassesThroughItself) {
  SurfaceMesh mesh = ball(1, 16);
  mesh.vertices[100] *= -1.3;
  expectRefused(mesh, {"passes through itself: triangles ", "of part 0, cross at (", "does not mend"});
}

// Parts that touch without sharing a piece of face, and walls that are merely near, are solids.
TEST(SurfaceCheck, TakesWhatOnlyTouches) {
  for (const SurfaceMesh& mesh :
       {joined(boxMesh(kCube), boxMesh(kCube, {1, 1, 0})), joined(boxMesh(kCube), boxMesh(kCube, kCube)),
        joined(boxMesh(kCube), boxMesh(kCube, {1.001, 0, 0})),
        tilted(joined(boxMesh(kCube), boxMesh(kCube, {1, 1, 0}))), hollowCube(), ball(1, 32),
        slottedSlab(1e-4)})
    EXPECT_EQ(refusalOf(mesh), "");
}

TEST(SurfaceCheck, NamesWherePartsShareAFace) {
  expectRefused(joined(boxMesh(kCube), boxMesh(kCube, {1, 0, 0})),
                {"cannot be cut into cells: two sheets", "touch at (0.5, ", "a repair unites"});
}

TEST(SurfaceCheck, NamesPartsThatFaceTheWrongWay) {
  expectRefused(joined(boxMesh(kCube), boxMesh(kCube / 2)),
                {"part 1 inside part 0, with a corner at (-0.25, -0.25, -0.25), faces the same way"});
  expectRefused(joined(boxMesh(kCube), reversed(boxMesh(kCube / 2, {2, 0, 0}))),
                {"part 1, with a corner at (1.75, ", "faces inwards, but lies inside no other"});
  expectRefused(joined(hollowCube(), reversed(boxMesh(kCube / 4))),
                {"part 2 inside part 1", "a cavity already"});
  EXPECT_EQ(refusalOf(joined(hollowCube(), boxMesh(kCube / 4))), "");
}

// By comparing each with each.
TEST(BoxPairs, AreAllFoundOnce) {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::uint32_t state = 1;
  const auto next = [&state] { return double((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24; };
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d corner(next(), next(), next());
    boxes.emplace_back(corner, corner + 0.2 * Eigen::Vector3d(next(), next(), next()));
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found, expected;
  EXPECT_TRUE(cooking::visitOverlaps(boxes, 10'000'000,
                                     [&](std::uint32_t a, std::uint32_t b) { found.emplace_back(a, b); }));
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      if (boxes[a].intersects(boxes[b])) expected.emplace_back(a, b);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
  EXPECT_FALSE(cooking::visitOverlaps(boxes, 1000, [](std::uint32_t, std::uint32_t) {}));
}

}  // namespace
}  // namespace rubble::test
