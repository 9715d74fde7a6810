// The program from outside: exit codes, what it says, what it leaves behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "scenes/child.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

class Program : public testing::Test {
 protected:
  ChildResult run(const std::string& arguments) {
    return runChild("cd " + m_folder.path().string() + " && " RUBBLE_PROGRAM " " + arguments,
                    m_folder.path());
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(m_folder.path() / name); }
  static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

  TestFolder m_folder;
};

TEST_F(Program, RunsASceneAndSaysWhatHappened) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("run small.json --no-render --frames 3 --events events.jsonl");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  for (const char* word :
       {"elements", "springs", "fragments", "debris", "dust", "impactor", "ledger errors", "ms a frame"})
    EXPECT_NE(result.out.find(word), std::string::npos) << word << " in\n" << result.out;
  std::ifstream stats(m_folder.path() / "out/small/stats.jsonl");
  int frames = 0;
  for (std::string line; std::getline(stats, line);) ++frames;
  EXPECT_EQ(frames, 3);
  EXPECT_TRUE(exists("events.jsonl"));
}

TEST_F(Program, BadInputIsOneLineExitCode2AndNothingWritten) {
  m_folder.write("bad.json", R"({"objects": [{"size": [1, 1, 1], "radius": -1}]})");
  const ChildResult result = run("run bad.json --events events.jsonl");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.error, "rubble: error: bad.json: objects.0.radius: is -1, must be 0 to 100000\n");
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(exists("out"));
  EXPECT_FALSE(exists("events.jsonl"));
}

TEST_F(Program, EveryBadArgumentIsExitCode2AndOneLine) {
  m_folder.write("small.json", kSmallWall);
  for (const char* arguments :
       {"", "fly wall", "run", "run none.json", "run small.json --frames 0", "run small.json --frames many",
        "run small.json --size 12", "run small.json --size 0x0", "run small.json --size 1280x720x3",
        "run small.json --threads 0", "run small.json --set gravityy=1", "run small.json --set gravity",
        "run small.json --wat", "run small.json --seed -1", "info none.rubble-asset", "view none",
        "run small.json --no-render --set dust.backend=gl", "run small.json --no-render --out small.json",
        "run small.json --no-render --stats none/stats.jsonl"}) {
    const ChildResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << arguments;
    const auto errors = result.error.rfind("rubble: error: ");
    ASSERT_NE(errors, std::string::npos) << arguments << '\n' << result.error;
    EXPECT_EQ(lines(result.error.substr(errors)), 1) << arguments << '\n' << result.error;
    EXPECT_EQ(result.out, "") << arguments;
  }
  EXPECT_FALSE(exists("out/small/stats.jsonl"));
}

TEST_F(Program, ASceneThatNeedsTooManySubstepsIsRefused) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("run small.json --no-render --set max_substeps_per_frame=1");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_NE(result.error.find("rubble: error: small.json: objects.0: "), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("max"), std::string::npos) << result.error;
}

TEST_F(Program, InfoSaysWhatASceneNeeds) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("info small.json --set debris=null");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  // 0.5 x 0.5 x 0.08 m of 2400 kg/m^3.
  for (const char* text :
       {"128, radius", "48 kg", "stable substep", "16^3 cells", "debris                none", "OpenGL"})
    EXPECT_NE(result.out.find(text), std::string::npos) << text << " in\n" << result.out;
  EXPECT_FALSE(exists("out"));
}

TEST_F(Program, ReportComparesPrecisionsAndSubsteps) {
  m_folder.write("small.json", kSmallWall);
  const ChildResult result = run("report small.json --frames 2 --out report");
  EXPECT_EQ(result.exitCode, 0) << result.error;
  std::ifstream table(m_folder.path() / "report/small.csv");
  int rows = 0;
  for (std::string line; std::getline(table, line);) ++rows;
  EXPECT_EQ(rows, 7);  // a head, and three substeps in each of two precisions
}

TEST_F(Program, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(run("--help").exitCode, 0);
  EXPECT_EQ(run("run --help").exitCode, 0);
  EXPECT_EQ(run("--version").out.find("rubble "), 0u);
}

}  // namespace
}  // namespace rubble::test
