// Errors and times of a scene's settings: kept for the scene and the solver as they are.
#include "demo/kept_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "demo/input_error.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

// Scene or solver have changed since: the command that the message names makes them anew, after the
// reference.
TEST(KeptSettings, AreOfTheScenesTheSolverAndTheCasesAsTheyAre) {
  const std::vector<demo::KeptSettings> all = demo::allKeptSettings();
  EXPECT_GE(all.size(), 1u);
  for (const demo::KeptSettings& kept : all) {
    EXPECT_EQ(demo::staleness(kept, demo::loadScene(kept.scene)), "") << kept.scene << ": " << kept.madeBy;
    const auto isOfIt = [&](const demo::ReportCase& c) {
      return c.reference && c.reference->scene == kept.scene;
    };
    const auto found = std::ranges::find_if(demo::reportCases(), isOfIt);
    ASSERT_NE(found, demo::reportCases().end()) << kept.scene;
    ASSERT_EQ(kept.settings.size(), found->runs.size()) << kept.scene;
    for (std::size_t i = 0; i < kept.settings.size(); ++i)
      EXPECT_EQ(kept.settings[i].name, found->runs[i].method + ", " + found->runs[i].setting);
  }
}

TEST(KeptSettings, AnErrorIsThatOfTheWorstRunAndNoLessThanTheScatter) {
  demo::KeptSettings kept;
  kept.scatter = 0.02;
  const auto errorOf = [&](std::vector<double> errors) {
    demo::KeptSetting setting;
    setting.errors = std::move(errors);
    return kept.errorOf(setting);
  };
  EXPECT_EQ(errorOf({0.01, 0.05, 0.03}), 0.05);
  EXPECT_EQ(errorOf({0.01, 0.001}), 0.02);
  EXPECT_EQ(errorOf({0.01, HUGE_VAL}), HUGE_VAL);
  EXPECT_EQ(errorOf({}), HUGE_VAL);  // never run
}

class SmallSettings : public testing::Test {
 protected:
  demo::ReportCase smallCase() const {
    demo::ReportCase c;
    c.name = m_def.caseName;
    c.reference = m_def;
    return c;
  }

  TestFolder m_folder;
  const std::string m_scene = m_folder.write("small.json", kSmallWall);
  const std::filesystem::path m_file = m_folder.path() / "small_settings.json";
  const demo::ReferenceDef m_def{"small_blow", m_scene, 3, 1};
};

// Compared with a run at the same setting, the first run has no error and those whose blow comes elsewhere
// have some; nor has one in double.
TEST_F(SmallSettings, AreReadAsTheyWereWritten) {
  const std::vector<demo::Override> whole = {{"precision", "float"}, {"substep_safety", "0.9"}},
                                    fine = {{"precision", "double"}, {"substep_safety", "0.45"}};
  const auto own = demo::runToEnd(demo::comparedScene(m_def, whole)).quantities;
  const demo::SceneReference reference = demo::referenceOf(std::vector{own, own});
  demo::ReportCase c = smallCase();
  c.runs = {{"float", "substep_safety 0.9", true, false, {}, 1, whole},
            {"double", "substep_safety 0.45", false, false, {}, 1, fine}};
  double share = 0;
  demo::writeSettings(c, reference, m_file, [&](double now) {
    EXPECT_GT(now, share);
    share = now;
  });
  EXPECT_EQ(share, 1);

  const demo::KeptSettings kept = demo::readSettings(m_file);
  EXPECT_EQ(kept.scene, "small");
  EXPECT_EQ(kept.madeBy, "rubble report small_blow --keep");
  EXPECT_DOUBLE_EQ(kept.simulated, 3 / 60.0);
  EXPECT_EQ(kept.scatter, 0);
  ASSERT_EQ(kept.settings.size(), 2u);
  EXPECT_EQ(kept.settings[0].name, "float, substep_safety 0.9");
  EXPECT_TRUE(kept.settings[0].standard);
  EXPECT_FALSE(kept.settings[1].standard);
  ASSERT_EQ(kept.settings[1].changes.size(), 2u);
  EXPECT_EQ(kept.settings[1].changes[1].path, "substep_safety");
  EXPECT_EQ(kept.settings[1].changes[1].value, "0.45");
  for (const demo::KeptSetting& setting : kept.settings) {
    ASSERT_EQ(setting.errors.size(), 3u) << setting.name;
    EXPECT_GT(setting.milliseconds, 0);
    // Of four quantities the root mean square is between half of the largest and the largest.
    EXPECT_GE(setting.largest, kept.errorOf(setting));
    EXPECT_LE(setting.largest, 2 * kept.errorOf(setting) + 1e-12);
  }
  EXPECT_EQ(kept.settings[0].errors[0], 0);
  EXPECT_GT(kept.settings[0].errors[1], 0);
  EXPECT_GT(kept.settings[1].errors[0], 0);
}

// Length and dust decide nothing, nor do camera and light; solver, seed, blow and the scene's own precision
// do.
TEST_F(SmallSettings, AreStaleWhenSceneOrSolverHaveChanged) {
  demo::KeptSettings kept;
  kept.sceneHash = demo::comparedHash(demo::comparedScene(m_def, {}));
  kept.solverHash = "0";
  EXPECT_NE(demo::staleness(kept, demo::loadScene(m_scene)).find("solver"), std::string::npos);
  demo::writeSettings(smallCase(), {}, m_file);
  kept = demo::readSettings(m_file);
  EXPECT_EQ(demo::staleness(kept, demo::loadScene(m_scene)), "");
  for (const auto& [key, value] : {std::pair("frames", "9"), std::pair("dust", "null"),
                                   std::pair("camera.eye", "[1,1,1]"), std::pair("light.ambient", "2")})
    EXPECT_EQ(demo::staleness(kept, demo::loadScene(m_scene, {{key, value}})), "") << key;
  for (const auto& [key, value] :
       {std::pair("seed", "2"), std::pair("impactors.0.mass", "21"), std::pair("precision", "double")})
    EXPECT_NE(demo::staleness(kept, demo::loadScene(m_scene, {{key, value}})), "") << key;
  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[0].world ^= 1;
  EXPECT_NE(demo::staleness(kept, demo::loadScene(m_scene), versions), "");
}

TEST_F(SmallSettings, AreRefusedWhenTheyAreNone) {
  EXPECT_THROW(demo::readSettings(m_file), demo::InputError);
  for (const char* text : {"", "{}", "{\"scene\": 3}", "[]"})
    EXPECT_THROW(demo::readSettings(m_folder.write("small_settings.json", text)), demo::InputError) << text;
}

}  // namespace
}  // namespace rubble::test
