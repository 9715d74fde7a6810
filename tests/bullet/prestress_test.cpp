// The static state made ahead and saved with the asset, as an application uses it.
#include "rubble/prestress.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bullet/body_impl.h"
#include "bullet/bullet_world.h"
#include "bullet/world_tick.h"

namespace rubble::test {
namespace {

const btVector3 kDown(0, btScalar(-9.81), 0);

DestructibleBodyDef wall() {
  DestructibleBodyDef def;
  def.regime = Regime::Elements;
  def.asset = smallWall();
  return def;
}

std::shared_ptr<const Asset> throughAFile(const Asset& asset) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      ("rubble_prestress_" + std::to_string(sizeof(btScalar)) +
       testing::UnitTest::GetInstance()->current_test_info()->name() + ".rubble-asset");
  save(asset, file);
  auto loaded = std::make_shared<const Asset>(load(file));
  std::filesystem::remove(file);
  return loaded;
}

edem::PrestressResult resultOf(BulletWorld& w, const DestructibleBody& body) {
  return implOf(*w.destruction).solver->prestressed(body.id());
}

void expectKeptAndEqual(const DestructibleBodyDef& def, Precision precision) {
  DestructibleBodyDef loaded = def;
  loaded.asset = throughAFile(prestress(def, kDown, precision));
  DestructionDef destruction;
  destruction.precision = precision;
  BulletWorld solving(destruction), taking(destruction);  // a warning fails
  const auto solved = resultOf(solving, *solving.destruction->addBody(def));
  EXPECT_EQ(solved.outcome, edem::PrestressOutcome::Done) << solved.reason;
  EXPECT_GT(solved.corrections, 0);
  const auto taken = resultOf(taking, *taking.destruction->addBody(loaded));
  EXPECT_EQ(taken.outcome, edem::PrestressOutcome::Kept) << taken.refusal;
  EXPECT_EQ(taken.corrections, 0);
  EXPECT_EQ(taken.iterations, 0);
  EXPECT_EQ(solving.destruction->hash(), taking.destruction->hash());
  for (BulletWorld* w : {&solving, &taking}) w->world.stepSimulation(btScalar(1.0 / 60), 0);
  EXPECT_EQ(solving.destruction->hash(), taking.destruction->hash());
}

TEST(KeptPrestress, IsFoundAfterAFileInEitherPrecision) {
  expectKeptAndEqual(wall(), Precision::Float);
  expectKeptAndEqual(wall(), Precision::Double);
}

TEST(KeptPrestress, IsThatOfATurnedBodyToo) {
  DestructibleBodyDef def = wall();
  def.transform.setRotation(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.3)));
  def.transform.setOrigin({1, 2, 3});
  expectKeptAndEqual(def, Precision::Float);
}

TEST(KeptPrestress, OfAnotherMaterialIsWarnedOfAndSolvedAnew) {
  DestructibleBodyDef def = wall();
  def.asset = throughAFile(prestress(def, kDown));
  def.material.density *= 1.5;
  std::vector<std::string> lines;
  DestructionDef logged;
  logged.log = [&](LogLevel level, const std::string& text) {
    EXPECT_EQ(level, LogLevel::Warning);
    lines.push_back(text);
  };
  BulletWorld w(logged), solving;
  EXPECT_EQ(resultOf(w, *w.destruction->addBody(def)).outcome, edem::PrestressOutcome::Done);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("tall): the static state that its asset keeps was not taken: it is of another "
                          "material, model, gravity, precision or geometry; it is solved anew"),
            std::string::npos)
      << lines[0];
  def.asset = smallWall();
  solving.destruction->addBody(def);
  EXPECT_EQ(w.destruction->hash(), solving.destruction->hash());
}

TEST(KeptPrestress, ReplacesAStaleOne) {
  DestructibleBodyDef def = wall();
  def.asset = std::make_shared<const Asset>(prestress(def, kDown));
  def.material.density *= 1.5;
  def.asset = std::make_shared<const Asset>(prestress(def, kDown));
  BulletWorld w;
  EXPECT_EQ(resultOf(w, *w.destruction->addBody(def)).outcome, edem::PrestressOutcome::Kept);
}

TEST(KeptPrestress, IsRefusedWhereThereIsNone) {
  const auto expectRefused = [](const DestructibleBodyDef& def, const btVector3& gravity, const char* words) {
    try {
      prestress(def, gravity);
      ADD_FAILURE() << "made; expected: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  DestructibleBodyDef def = wall();
  expectRefused(def, {0, 0, 0}, "gravity: must not be zero");
  expectRefused(def, {0, btScalar(-1e4), 0}, "gravity: -10000 is not allowed");
  def.anchored = false;
  expectRefused(def, kDown, "the body has no static state: it has no anchors");
  def = wall();
  def.material.youngsModulus = 1e3;
  expectRefused(def, kDown, "the body has no static state: ");
  def.asset.reset();
  expectRefused(def, kDown, "asset: none given");
}

}  // namespace
}  // namespace rubble::test
