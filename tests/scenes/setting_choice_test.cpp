// `rubble run SCENE --error`: the cheapest setting of those whose error is kept, by a file of settings that
// is written here by hand.
#include "demo/setting_choice.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "demo/input_error.h"
#include "demo/settings_hash.h"
#include "scenes/program.h"

namespace rubble::test {
namespace {

TEST(ErrorShare, IsAPercentageOrAShareBelowOne) {
  EXPECT_DOUBLE_EQ(demo::parseErrorShare("2%"), 0.02);
  EXPECT_DOUBLE_EQ(demo::parseErrorShare("0.02"), 0.02);
  EXPECT_DOUBLE_EQ(demo::parseErrorShare("0.5%"), 0.005);
  EXPECT_DOUBLE_EQ(demo::parseErrorShare("2e-2"), 0.02);
  for (const char* bad : {"",     "%", "2",  "1",   "100%", "2 %", " 2%",  "2%%",   "abc",  "-1%",
                          "-0.1", "0", "0%", "nan", "nan%", "inf", "inf%", "0.02x", "2,5%", "1e-999%"})
    EXPECT_THROW(demo::parseErrorShare(bad), demo::InputError) << bad;
}

// Errors count by their worst run and from the scatter, 1.5 %, on; ms are of a simulated second.
class Within : public Program {
 protected:
  Within() {
    std::filesystem::create_directories(m_folder.path() / "data/scenes");
    std::filesystem::create_directories(m_folder.path() / "data/references");
    m_folder.write("data/scenes/small.json", kSmallWall);
    m_folder.write("small.json", kSmallWall);
    m_folder.write("copy.json", kSmallWall);
    keep(demo::settingsHash({}, kSolverVersions));
  }
  void keep(const std::string& solverHash) {
    const demo::Scene scene = demo::loadScene((m_folder.path() / "small.json").string());
    m_folder.write("data/references/small_settings.json",
                   R"({"made_by": "rubble report small_blow --keep", "scene": "small", "simulated_s": 0.05,
      "scatter": 0.015, "scene_hash": ")" +
                       demo::comparedHash(scene) + R"(", "solver_hash": ")" + solverHash +
                       R"(", "settings": [
      {"name": "whole", "default": true, "set": {"precision": "float", "substep_safety": "0.9"},
       "errors": [0.05, 0.125, 0.08], "largest_difference": 0.2, "ms_per_simulated_second": 100},
      {"name": "half", "default": false, "set": {"precision": "float", "substep_safety": "0.45"},
       "errors": [0.03, 0.04, 0.01], "largest_difference": 0.06, "ms_per_simulated_second": 190},
      {"name": "double half", "default": false, "set": {"precision": "double", "substep_safety": "0.45"},
       "errors": [0.01, 0.035, 0.02], "largest_difference": 0.06, "ms_per_simulated_second": 180},
      {"name": "quarter", "default": false, "set": {"precision": "double", "substep_safety": "0.225"},
       "errors": [0.001, 0.002, 0.001], "largest_difference": 0.003, "ms_per_simulated_second": 400},
      {"name": "broken", "default": false, "set": {"precision": "float", "substep_safety": "1"},
       "errors": [0.001, null, 0.001], "largest_difference": 0.003, "ms_per_simulated_second": 1}]})");
  }
  demo::KeptSettings kept() const {
    return demo::readSettings(m_folder.path() / "data/references/small_settings.json");
  }
  ChildResult runHere(const std::string& arguments) const {
    return runChild("cd " + m_folder.path().string() + " && RUBBLE_DATA=data " RUBBLE_PROGRAM " run " +
                        arguments + " --no-render --frames 2",
                    m_folder.path());
  }
  // Of the frames of the last run of that scene: the hash of its state and its substep [s].
  std::vector<std::pair<std::string, double>> frames(const std::string& scene) const {
    std::vector<std::pair<std::string, double>> found;
    std::ifstream stats(m_folder.path() / "out" / scene / "stats.jsonl");
    for (std::string line; std::getline(stats, line);) {
      const auto json = nlohmann::json::parse(line);
      found.push_back({json.at("hash").get<std::string>(), json.at("dt_s").get<double>()});
    }
    return found;
  }
};

TEST_F(Within, TheCheapestSettingThatKeptTheErrorIsTaken) {
  const demo::KeptSettings settings = kept();
  const auto named = [&](double error) {
    const demo::KeptSetting* setting = demo::cheapestWithin(settings, error);
    return setting ? setting->name : "none";
  };
  EXPECT_EQ(named(0.5), "whole");
  EXPECT_EQ(named(0.125), "whole");
  EXPECT_EQ(named(0.1), "double half");  // though the mean of `whole` is below
  EXPECT_EQ(named(0.036), "double half");
  EXPECT_EQ(named(0.034), "quarter");
  EXPECT_EQ(named(0.015), "quarter");
  EXPECT_EQ(named(0.0149), "none");  // below the scatter, whatever its runs say
}

TEST_F(Within, TheRunIsAtTheSettingThatItNames) {
  const ChildResult within = runHere("small --error 4.5%");
  ASSERT_EQ(within.exitCode, 0) << within.error;
  EXPECT_EQ(
      within.out.substr(0, within.out.find('\n')),
      "setting: double half: error 3.5 %, 180 ms of one core per simulated second, the cheapest of 5 to "
      "keep 4.5 %; the default (whole): 12.5 %, 100 ms");
  EXPECT_EQ(within.error.find("warning"), std::string::npos) << within.error;
  const auto chosen = frames("small");
  ASSERT_EQ(chosen.size(), 2u);
  ASSERT_EQ(runHere("small --set precision=double --set substep_safety=0.45").exitCode, 0);
  EXPECT_EQ(frames("small"), chosen);
  ASSERT_EQ(runHere("small").exitCode, 0);
  EXPECT_NE(frames("small")[0].first, chosen[0].first);
  EXPECT_NEAR(frames("small")[0].second / chosen[0].second, 2, 0.1);  // whole ticks of whole substeps
}

TEST_F(Within, ACopyOfTheSceneIsTheSceneAndItsDefaultIsNamed) {
  const ChildResult within = runHere("copy.json --error 0.2");
  ASSERT_EQ(within.exitCode, 0) << within.error;
  EXPECT_NE(within.out.find("the cheapest of 5 to keep 20 %; it is the default\n"), std::string::npos)
      << within.out;
  EXPECT_EQ(within.error.find("warning"), std::string::npos) << within.error;
}

TEST_F(Within, AnErrorThatNoSettingKeptIsRefusedWithTheLeast) {
  expectError(
      runHere("small --error 1%"), 2,
      "--error: 1 %: is below what any setting of small kept: the least was 1.5 % by quarter; runs of the "
      "reference itself scatter by 1.5 %");
  EXPECT_FALSE(exists("out"));
}

TEST_F(Within, ASceneWithoutFiguresIsRefusedWithThoseThatHaveSome) {
  std::string heavier = kSmallWall;
  heavier.replace(heavier.find("\"mass\": 20"), 10, "\"mass\": 21");
  m_folder.write("heavy.json", heavier);
  expectError(runHere("heavy.json --error 5%"), 2,
              "--error: heavy: has no kept errors of its settings; scenes that have: small; "
              "none can be made");
  m_folder.write("data/scenes/wall.json", heavier);
  expectError(runHere("wall --error 5%"), 2, "made by: rubble report wall_blow --keep");
  EXPECT_FALSE(exists("out"));
}

TEST_F(Within, FiguresOfAnotherSceneOrSolverAreWarnedOfAndTaken) {
  const auto warned = [&](const std::string& arguments, const std::string& words) {
    const ChildResult result = runHere(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.error;
    const auto at = result.error.find("rubble: warning: --error: ");
    ASSERT_NE(at, std::string::npos) << result.error;
    const std::string line = result.error.substr(at, result.error.find('\n', at) - at);
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_NE(line.find("made anew by: rubble report small_blow --keep"), std::string::npos) << line;
    EXPECT_TRUE(result.out.starts_with("setting: double half: ")) << result.out;
  };
  warned("small --error 4.5% --set impactors.0.mass=21", "of that scene with other values");
  keep("0");
  warned("small --error 4.5%", "of another version of the solver");
}

TEST_F(Within, WhatIsChosenCannotBeGiven) {
  expectError(runHere("small --error 5% --set precision=double"), 2,
              "--set: precision: is what --error chooses, must be left out with it");
  expectError(runHere("small --error 2"), 2, "--error: 2: is no error, must be a percentage such as 2%");
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace rubble::test
