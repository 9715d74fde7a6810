// Every connected part of a solid has an element, and springs tie together what is one part and nothing else.
#include <gtest/gtest.h>

#include "cook/parts.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

using cooking::countTied;

// Two unit cubes, 1 cm apart.
SurfaceMesh twoCubes() {
  return joined(boxMesh({1, 1, 1}), boxMesh({1, 1, 1}, {1.01, 0, 0}));
}

// Hollow cubes inside each other, with walls of `wall` and gaps of as much again.
SurfaceMesh nestedShells(int shells, double wall) {
  SurfaceMesh mesh;
  for (int s = 0; s < shells; ++s) {
    const double outer = 1 - 4 * s * wall;
    mesh = joined(mesh, boxMesh(Eigen::Vector3d::Constant(outer)));
    mesh = joined(mesh, reversed(boxMesh(Eigen::Vector3d::Constant(outer - 2 * wall))));
  }
  return mesh;
}

// A cube on a stack of sheets 1 mm thick and 1 mm apart.
SurfaceMesh cubeOverSheets(int sheets) {
  SurfaceMesh mesh = boxMesh({1, 1, 1}, {0, 0.5, 0});
  for (int s = 1; s <= sheets; ++s) mesh = joined(mesh, boxMesh({0.9, 0.001, 0.9}, {0, -0.002 * s, 0}));
  return mesh;
}

struct PartsCase {
  const char* name;
  SurfaceMesh mesh;
  std::size_t elements;
  std::size_t parts;  // by how it was made
};

std::vector<PartsCase> partsCases() {
  return {{"TwoCubes", twoCubes(), 200, 2},
          {"PlateAndCube", plateAndCube(0.0625), 300, 2},
          {"SlottedSlab", slottedSlab(0.01), 300, 1},
          {"NestedShells", nestedShells(3, 0.02), 300, 3},
          {"FewInNestedShells", nestedShells(4, 0.02), 8, 4},
          {"CubeOverSheets", cubeOverSheets(5), 200, 6},
          {"FewInCubeOverSheets", cubeOverSheets(5), 7, 6},
          {"TableOnThinLegs", table(0.5, 0.02), 300, 1},
          {"HollowCube", hollowCube(), 200, 1}};
}

class Parts : public testing::TestWithParam<std::size_t> {};

TEST_P(Parts, AreTiedTogetherEachAndNotToOthers) {
  const PartsCase solid = partsCases()[GetParam()];
  EXPECT_EQ(cooking::countParts(cooking::checkMesh(solid.mesh)), solid.parts);
  ExpectedWarnings warnings;
  const Asset asset = cook(solid.mesh, optionsFor(solid.elements), {}, warnings.log());
  EXPECT_EQ(warnings.take("do not touch"), 0);
  for (const char* text : {"would fill it", "thinner than the elements", "protrudes", "too few elements"})
    warnings.take(text);
  EXPECT_EQ(asset.elementCount(), solid.elements);
  EXPECT_EQ(countTied(asset.elementCount(), asset.springs), solid.parts);
}

INSTANTIATE_TEST_SUITE_P(Solids, Parts, testing::Range<std::size_t>(0, partsCases().size()),
                         [](const auto& solid) { return std::string(partsCases()[solid.param].name); });

// Each sheet holds the middle of an element, which may protrude.
TEST(Parts, ThinSheetsHaveAnElementEach) {
  ExpectedWarnings warnings;
  const Asset asset = cook(cubeOverSheets(5), optionsFor(30), {}, warnings.log());
  for (const char* text : {"would fill it", "thinner than the elements", "protrudes", "too few elements"})
    warnings.take(text);
  for (int s = 1; s <= 5; ++s) {
    int inSheet = 0;
    for (const Eigen::Vector3d& p : asset.positions) inSheet += std::abs(p.y() + 0.002 * s) < 0.0005 ? 1 : 0;
    EXPECT_GE(inSheet, 1) << "sheet " << s;
  }
}

TEST(Parts, MoreThanElementsAreTold) {
  ExpectedWarnings warnings;
  cook(twoCubes(), optionsFor(1), {}, warnings.log());
  EXPECT_EQ(warnings.take("the mesh has 2 parts that do not touch and only 1 elements; 2 and more would do"),
            1);
  warnings.take("too few elements");
  warnings.take("would fill it");
}

}  // namespace
}  // namespace rubble::test
