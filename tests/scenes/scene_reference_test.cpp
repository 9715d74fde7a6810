// What runs of a scene are compared with: kept for the scene and the solver as they are, and refused when it
// is of others.
#include "demo/scene_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "demo/input_error.h"
#include "demo/report_case.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

using Quantities = std::vector<demo::SceneQuantity>;

std::string refusalOf(const demo::ReferenceDef& def, const std::filesystem::path& file,
                      std::span<const SolverVersion> versions = kSolverVersions) {
  try {
    demo::readReference(def, file, versions);
  } catch (const demo::InputError& error) {
    return error.what();
  }
  return "";
}

// Scene or solver have changed since: make the reference anew by the command that the refusal names, then
// write the tables again.
TEST(SceneReference, ThoseOfTheCasesAreOfTheScenesAndTheSolverAsTheyAre) {
  int references = 0;
  for (const demo::ReportCase& c : demo::reportCases()) {
    if (!c.reference) continue;
    ++references;
    EXPECT_EQ(refusalOf(*c.reference, demo::referenceFile(*c.reference)), "");
  }
  EXPECT_GE(references, 1);
}

// sqrt(((2 - 1) / 1)^2 + ((3 - 4) / 4)^2) over two.
TEST(SceneReference, DifferencesAreRelativeAndTheirRootMeanSquareIsTaken) {
  const Quantities found = {{"a", 2}, {"b", 3}}, expected = {{"a", 1}, {"b", 4}};
  EXPECT_DOUBLE_EQ(demo::relativeDifference(found, expected), std::sqrt((1 + 1.0 / 16) / 2));
  EXPECT_EQ(demo::relativeDifference(found, found), 0);
}

TEST(SceneReference, WhatIsForReadersAloneIsInNoDifference) {
  const Quantities found = {{"a", 2}, {"b", 9, false}}, expected = {{"a", 1}, {"b", 4, false}};
  EXPECT_DOUBLE_EQ(demo::relativeDifference(found, expected), 1);
}

// Of 1 and 3 each is the mean of the others for the other: 1 is off by 2/3 of 3, 3 by 2 of 1.
TEST(SceneReference, IsAMeanAndScattersAsEachRunDoesAboutTheOthers) {
  const std::vector<Quantities> runs = {{{"a", 1}, {"b", 5}, {"c", 1, false}},
                                        {{"a", 3}, {"b", 5}, {"c", 3, false}}};
  const demo::SceneReference reference = demo::referenceOf(runs);
  ASSERT_EQ(reference.quantities.size(), 3u);
  EXPECT_EQ(reference.quantities[0].name, "a");
  EXPECT_DOUBLE_EQ(reference.quantities[0].value, 2);
  EXPECT_DOUBLE_EQ(reference.quantities[1].value, 5);
  const double scatter = std::sqrt((4.0 / 9 + 4) / 2);
  ASSERT_EQ(reference.scatters.size(), 3u);
  EXPECT_DOUBLE_EQ(reference.scatters[0], scatter);
  EXPECT_EQ(reference.scatters[1], 0);
  EXPECT_DOUBLE_EQ(reference.scatters[2], scatter);
  EXPECT_DOUBLE_EQ(reference.scatter, scatter / std::sqrt(2.0));  // of two in the error, one without any
}

class SmallReference : public testing::Test {
 protected:
  SmallReference() { scene(kSmallWall); }
  void scene(const std::string& text) { m_folder.write("small.json", text); }

  TestFolder m_folder;
  const std::filesystem::path m_file = m_folder.path() / "references/small.json";
  const demo::ReferenceDef m_def{"small_blow", (m_folder.path() / "small.json").string(), 3, 7};
};

TEST_F(SmallReference, IsReadAsItWasWrittenUntilSceneOrSolverChange) {
  EXPECT_NE(refusalOf(m_def, m_file).find("cannot be read"), std::string::npos);
  double share = 0;
  demo::writeReference(m_def, m_file, [&](double now) {
    EXPECT_GT(now, share);
    share = now;
  });
  EXPECT_EQ(share, 1);
  const demo::SceneReference reference = demo::readReference(m_def, m_file);
  ASSERT_EQ(reference.scatters.size(), reference.quantities.size());
  // A run at another setting gives the same quantities.
  const demo::SceneOutcome run = demo::runToEnd(demo::comparedScene(m_def, {{"precision", "double"}}));
  ASSERT_EQ(run.quantities.size(), reference.quantities.size());
  for (std::size_t q = 0; q < run.quantities.size(); ++q)
    EXPECT_EQ(run.quantities[q].name, reference.quantities[q].name);
  EXPECT_NO_THROW(demo::requireSameQuantities(m_def, reference, run));
  demo::SceneOutcome other = run;
  other.quantities.back().name = "another";
  EXPECT_THROW(demo::requireSameQuantities(m_def, reference, other), demo::InputError);
  EXPECT_GT(run.processorSeconds, 0);
  EXPECT_DOUBLE_EQ(run.simulatedSeconds, 3 / 60.0);

  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[1].debris ^= 1;
  const std::string solver = refusalOf(m_def, m_file, versions);
  EXPECT_NE(solver.find("another version of the solver"), std::string::npos) << solver;
  EXPECT_NE(solver.find("in about 7 minutes by: rubble report small_blow --reference"), std::string::npos);

  demo::ReferenceDef longer = m_def;
  longer.frames = 4;
  EXPECT_NE(refusalOf(longer, m_file).find("other settings"), std::string::npos);
  std::string heavier = kSmallWall;
  heavier.replace(heavier.find("\"mass\": 20"), 10, "\"mass\": 21");
  scene(heavier);
  EXPECT_NE(refusalOf(m_def, m_file).find("as it was before"), std::string::npos);
}

TEST_F(SmallReference, IsRefusedWhenItIsNone) {
  m_folder.write("none.json", "{}");
  m_folder.write("half.json", "{\"scene_hash\": ");
  for (const char* name : {"none.json", "half.json"})
    EXPECT_NE(refusalOf(m_def, m_folder.path() / name).find("is no reference"), std::string::npos) << name;
}

// Where nothing else strikes, an object that moves does: in free flight at 5 m/s, its only way.
TEST_F(SmallReference, AnObjectThatStrikesHasAnExitSpeed) {
  scene(R"({"gravity": [0, 0, 0], "objects": [
    {"size": [0.5, 0.5, 0.5], "position": [0, 9, 0], "elements": 30},
    {"size": [0.5, 0.5, 0.5], "position": [5, 9, 0], "elements": 30, "velocity": [3, 0, 4]}]})");
  const demo::SceneOutcome run = demo::runToEnd(demo::comparedScene(m_def, {}));
  EXPECT_EQ(run.quantities.front().name, "exit speed of what is left, m/s");
  EXPECT_NEAR(run.quantities.front().value, 5, 1e-5);
}

// What would be divided by.
TEST_F(SmallReference, IsNotMadeOfARunInWhichNothingBreaks) {
  scene(R"({"objects": [{"size": [0.5, 0.5, 0.5], "position": [0, 9, 0], "elements": 30}]})");
  EXPECT_THROW(demo::writeReference(m_def, m_file), demo::RunStopped);
  EXPECT_FALSE(std::filesystem::exists(m_file));
}

}  // namespace
}  // namespace rubble::test
