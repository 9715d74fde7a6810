// Solids with thin parts beside thick ones: every part gets elements, and messages say where they are too
// large.
#include <gtest/gtest.h>

#include "support/strict_cook.h"
#include "unit/cook/packed.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

// In mean spacings.
double farthestCorner(const Asset& asset) {
  double farthest = 0;
  for (const CellCorner& corner : asset.corners)
    farthest = std::max(
        farthest,
        (asset.vertices[corner.vertex].position.cast<double>() - asset.positions[corner.element]).norm());
  return farthest / asset.spacing();
}

struct ThinCase {
  const char* name;
  SurfaceMesh mesh;
  std::size_t elements;
};

std::vector<ThinCase> thinCases() {
  return {{"Table", table(0.1, 0.06), 400},
          {"TableOfFew", table(0.3, 0.06), 200},
          {"Dumbbell", dumbbell(0.05), 300},
          {"PlateWithBoss", plateWithBoss(0.05), 300},
          {"PlateAndCube", plateAndCube(0.0625), 300},
          {"TiltedTable", tilted(table(0.1, 0.06)), 400},
          {"Slab", slottedSlab(0.01), 300}};
}

class ThinParts : public testing::TestWithParam<std::size_t> {};

// The bound that rubble/cook.h states. Without elements in the legs of the tables a cell reaches 7 and more.
TEST_P(ThinParts, AreNowhereFarFromTheirElements) {
  const ThinCase solid = thinCases()[GetParam()];
  ExpectedWarnings warnings;
  const Asset asset = cook(solid.mesh, optionsFor(solid.elements), {}, warnings.log());
  warnings.take("elements would fill it");
  warnings.take("are thinner than the elements");
  EXPECT_EQ(asset.elementCount(), solid.elements);
  EXPECT_LE(farthestCorner(asset), 3);
}

INSTANTIATE_TEST_SUITE_P(Solids, ThinParts, testing::Range<std::size_t>(0, thinCases().size()),
                         [](const auto& solid) { return std::string(thinCases()[solid.param].name); });

// Evenly spread elements stand about a spacing apart in a leg as well: 0.7 m hold at least half as many.
TEST(ThinParts, LegsOfATableHaveElementsThatFitInside) {
  const double leg = 0.06;
  const Asset asset = cookStrictly(table(0.1, leg), optionsFor(400));
  std::array<int, 4> inLegs{};
  for (const Eigen::Vector3d& p : packEvenly(table(0.1, leg), optionsFor(400)).centres) {
    if (p.y() > 0.7) continue;
    const bool isRight = p.x() > 0.6;
    const bool isBack = p.z() > 0.4;
    ++inLegs[std::size_t(isRight) + 2 * std::size_t(isBack)];
    const Eigen::Vector3d middle(isRight ? 1.15 - leg / 2 : 0.05 + leg / 2, p.y(),
                                 isBack ? 0.75 - leg / 2 : 0.05 + leg / 2);
    EXPECT_LE((p - middle).cwiseAbs().maxCoeff(), leg / 2 - 0.98 * asset.radius);
    EXPECT_GE(p.y(), 0.98 * asset.radius);
  }
  for (const int count : inLegs) EXPECT_GE(count, int(0.7 / (2 * asset.spacing())));
}

// As many as its volume's share at least: a plate thinner than the spacing needs more.
TEST(ThinParts, PlateHasItsShareBesideACube) {
  ExpectedWarnings warnings;
  const Asset asset = cook(plateAndCube(0.0625), optionsFor(600), {}, warnings.log());
  EXPECT_EQ(warnings.take("elements would fill it"), 1);
  EXPECT_EQ(warnings.take("are thinner than the elements"), 1);
  int inPlate = 0;
  for (const Eigen::Vector3d& p : asset.positions) inPlate += p.y() < 0.1 ? 1 : 0;
  EXPECT_GE(inPlate, 300);
  EXPECT_LE(inPlate, 540);  // and the cube is not left without
}

TEST(ThinParts, GiveTheSameBytesForTheSameSeed) {
  const Asset first = cookStrictly(table(0.1, 0.06), optionsFor(200));
  const Asset second = cookStrictly(table(0.1, 0.06), optionsFor(200));
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.radius, second.radius);
}

// Half of the legs' 2 cm is the radius that would do, and with it nothing protrudes.
TEST(ThinParts, ThatAreThinnerThanTheElementsAreNamedWithWhatWouldDo) {
  ExpectedWarnings warnings;
  cook(table(0.5, 0.02), optionsFor(300), {}, warnings.log());
  EXPECT_EQ(warnings.take("are thinner than the elements"), 1);
  EXPECT_EQ(warnings.take("protrudes"), 1);
  CookOptions options = optionsFor(300);
  options.radius = 0.0098;
  EXPECT_LE(farthestCorner(cookStrictly(table(0.5, 0.02), options)), 3);
}

// The number after `words`.
double numberAfter(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? -1 : std::stod(text.substr(at + words.size()));
}

struct Foretold {
  std::string text, stage;
};

// What is said of thin walls, and the stage then.
Foretold foretold(const SurfaceMesh& mesh, const CookOptions& options) {
  Foretold result;
  std::string stage;
  cook(
      mesh, options, [&stage](double, const char* name) { stage = name; },
      [&](LogLevel, const std::string& text) {
        if (text.find("walls of about") != std::string::npos) result = {text, stage};
      });
  return result;
}

// The legs are 2 cm wide, so a sphere of 1 cm fits, and 0.48 V / (4/3 pi (1 cm)^3) of them fill the table. 5
// %: a place as deep as 0.98 radii counts as room, and the count goes with the third power.
TEST(ThinParts, AreToldOfBeforeTheWork) {
  const SurfaceMesh mesh = table(0.5, 0.02);
  CookOptions given = optionsFor(300);
  given.radius = 0.0125;
  for (const CookOptions& options : {optionsFor(300), given}) {
    const auto [text, stage] = foretold(mesh, options);
    EXPECT_EQ(stage, "measuring the walls");
    EXPECT_NEAR(numberAfter(text, "walls of about "), 0.02, 0.05 * 0.02) << text;
    EXPECT_NEAR(numberAfter(text, "; "), 0.01, 0.05 * 0.01) << text;
    const double count = 0.48 * volumeOf(mesh) / (4.0 / 3 * std::numbers::pi * 1e-6);
    EXPECT_NEAR(numberAfter(text, "or about "), count, 0.15 * count) << text;
  }
}

TEST(ThinParts, AreNotToldOfWhereElementsFit) {
  EXPECT_EQ(foretold(ball(1, 16), optionsFor(300)).text, "");
  EXPECT_EQ(foretold(boxMesh({1, 1, 0.3}), optionsFor(300)).text, "");
}

// At its second packing as well: of a thousand elements each has room in the legs, but they are left without.
TEST(ThinParts, KeepTheProgressGoing) {
  std::vector<double> packing;
  std::size_t cuts = 0;
  cook(table(0.1, 0.06), optionsFor(1000), [&](double share, const char* stage) {
    cuts += std::string(stage) == "cutting cells" ? 1 : 0;
    if (std::string(stage) == "packing" && cuts == 1) packing.push_back(share);
  });
  ASSERT_EQ(cuts, 2u);
  ASSERT_GT(packing.size(), 2u);
  EXPECT_GT(packing.back(), packing.front());
}

// What is foretold to be too thin is not packed in vain first.
TEST(ThinParts, ThatAreForetoldArePackedEvenlyAtOnce) {
  for (const std::size_t elements : {300u, 400u}) {
    std::size_t cuts = 0;
    cook(table(0.1, 0.06), optionsFor(elements),
         [&cuts](double, const char* stage) { cuts += std::string(stage) == "cutting cells" ? 1 : 0; });
    EXPECT_EQ(cuts, 1u);
  }
}

// In a solid that is thin nearly everywhere all elements fit, and the message says how many would fill it.
TEST(ThinParts, OfMostOfTheSolidMakeTheElementsSmall) {
  ExpectedWarnings warnings;
  const Asset asset = cook(plateAndCube(0.02), optionsFor(300), {}, warnings.log());
  EXPECT_LE(asset.radius, 0.01);
  EXPECT_GE(asset.radius, 0.008);
  EXPECT_EQ(warnings.take("elements would fill it"), 1);
  EXPECT_EQ(warnings.take("are thinner than the elements"), 1);
}

// A cube and two grains, one of which gets its element last: what was amiss before is not told.
TEST(ThinParts, ThatGetTheirElementLastAreNotToldToBeFarFromOne) {
  ExpectedWarnings warnings;
  SurfaceMesh grain = ball(0.005, 12);
  for (Eigen::Vector3d& vertex : grain.vertices) vertex += Eigen::Vector3d(0.7, 0, 0);
  const SurfaceMesh mesh = joined(
      joined(boxMesh({1, 1, 1}), boxMesh(Eigen::Vector3d::Constant(0.02), {1.01, -0.49, -0.49})), grain);
  const Asset asset = cook(mesh, optionsFor(2048), {}, warnings.log());
  EXPECT_LE(farthestCorner(asset), 3);
  EXPECT_EQ(warnings.take("cook: 1 part of the mesh had no element and gets one, which protrudes"), 1);
  warnings.take("an element protrudes by");
}

}  // namespace
}  // namespace rubble::test
