// What adding a body says in the log.
#include <gtest/gtest.h>

#include "bullet/bullet_world.h"

namespace rubble::test {
namespace {

struct Line {
  LogLevel level;
  std::string text;
};

std::vector<Line> linesOf(const DestructibleBodyDef& body) {
  std::vector<Line> lines;
  DestructionDef def;
  def.log = [&](LogLevel level, const std::string& text) { lines.push_back({level, text}); };
  BulletWorld w(def);
  w.destruction->addBody(body);
  return lines;
}

std::shared_ptr<const Asset> column(double height, bool anchored) {
  CookOptions options;
  options.elements = 64;
  if (anchored) options.anchorDirection = Eigen::Vector3d(0, -1, 0);
  const Eigen::Vector3d size(0.1 * height, height, 0.1 * height);
  return std::make_shared<const Asset>(cook(boxMesh(size, {0, height / 2, 0}), options));
}

TEST(Log, AnAnchoredBodyThatStandsSaysNothing) {
  DestructibleBodyDef def;
  def.asset = column(1, true);
  EXPECT_TRUE(linesOf(def).empty());
}

TEST(Log, ABodyWithoutAnchorsIsSaidToBeFree) {
  DestructibleBodyDef def;
  def.asset = column(1, false);
  const std::vector<Line> lines = linesOf(def);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].level, LogLevel::Info);
  EXPECT_NE(lines[0].text.find("its asset has no anchors: it is free"), std::string::npos) << lines[0].text;
}

// A slender soft column under rho g H / E = 0.16 of strain: below its strength of 1 GPa, beyond buckling
// (Greenhill: H_max = (7.84 E I / (rho g A))^(1/3) = 6.9 m for a square of 2 m, E 3 MPa).
TEST(Log, ABodyThatCannotBePreStressedIsNamed) {
  DestructibleBodyDef def;
  def.asset = column(20, true);
  def.material.youngsModulus = 3e6;
  def.material.compressiveStrength = def.material.tensileStrength = 1e9;
  const std::vector<Line> lines = linesOf(def);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].level, LogLevel::Warning);
  EXPECT_NE(lines[0].text.find("(concrete_soft, 20 m tall): is anchored but was not pre-stressed: "),
            std::string::npos)
      << lines[0].text;
}

}  // namespace
}  // namespace rubble::test
