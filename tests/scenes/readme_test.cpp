// Tables in READMEs are written by `rubble report ... --write` and `rubble bench paper --write`; here is told
// when they are out of date.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "demo/command_line.h"
#include "demo/input_error.h"
#include "demo/markdown_table.h"
#include "demo/marked_text.h"
#include "scenes/scene_file.h"
#include "support/folders.h"

namespace rubble::test {
namespace {

// What the part of this command depends on.
std::string hashOf(const std::string& command) {
  std::istringstream stream(command);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<char*> raw;
  for (std::string& word : words) raw.push_back(word.data());
  const demo::CommandLine line = demo::parseCommandLine(int(raw.size()), raw.data());
  switch (line.command) {
    case demo::CommandLine::Command::BenchPaper:
      return demo::benchPaperHash(line.benchPaper);
    case demo::CommandLine::Command::CaseReport:
      return demo::caseReportHash(line.caseReport);
    case demo::CommandLine::Command::MaterialReport:
      return demo::materialReportHash();
    case demo::CommandLine::Command::SizeReport:
      return demo::sizeReportHash(line.sizeReport);
    case demo::CommandLine::Command::StabilityReport:
      return demo::stabilityReportHash(line.stabilityReport.cases);
    default:
      return demo::reportHash(line.report);
  }
}

// Scenes, presets or the solver have changed since: write the table again, and read what it says now.
TEST(Readme, TablesBelongToTheScenesAndTheSolverAsTheyAre) {
  int tables = 0;
  for (const std::filesystem::path& file : readmes()) {
    for (const demo::MarkedPart& part : demo::markedParts(file, "rubble")) {
      ++tables;
      EXPECT_EQ(part.dependsOn, hashOf(part.command))
          << "run: build/release/demo/" << part.command << " --write " << file.string();
    }
  }
  EXPECT_GE(tables, 4);
}

// README's table of what works names a test in each row.
TEST(Readme, TestsThatItNamesExist) {
  std::string sources;
  for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() + "/tests/bullet")) {
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    sources += text.str();
  }
  std::ifstream readme(sourceFolder() + "/README.md");
  const std::regex name("([A-Z][A-Za-z]+)[.]([A-Z][A-Za-z0-9]+)");
  int named = 0;
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("| ")) continue;
    for (std::sregex_iterator found(line.begin(), line.end(), name), end; found != end; ++found) {
      ++named;
      const std::string test = (*found)[1].str() + ", " + (*found)[2].str() + ")";
      EXPECT_NE(sources.find(test), std::string::npos) << found->str();
    }
  }
  EXPECT_GE(named, 25);
}

TEST(Rounded, HasThreeDigitsAndThousandsWithoutExponent) {
  EXPECT_EQ(demo::rounded(2301.4), "2300");
  EXPECT_EQ(demo::rounded(-19190), "-19200");
  EXPECT_EQ(demo::rounded(999.6), "1000");
  EXPECT_EQ(demo::rounded(312.4), "312");
  EXPECT_EQ(demo::rounded(0.0041172), "0.00412");
  EXPECT_EQ(demo::rounded(1.34e-5), "1.34e-05");
  EXPECT_EQ(demo::rounded(0), "0");
}

class Marked : public testing::Test {
 protected:
  std::string text() const {
    std::ifstream stream(m_folder.path() / "notes.md");
    std::ostringstream whole;
    whole << stream.rdbuf();
    return whole.str();
  }
  std::filesystem::path file() const { return m_folder.path() / "notes.md"; }

  TestFolder m_folder;
};

TEST_F(Marked, TextBetweenTheMarkersIsReplacedAndNothingElse) {
  const std::string end = "<!-- end: depends on 0000000000000000 -->\n";
  m_folder.write("notes.md", "# Before\n\n<!-- rubble report a -->\nold\n" + end +
                                 "\nbetween\n<!-- rubble report b -->\n" + end + "after\n");
  demo::MarkedText(file(), "rubble report b").replace("new\n", "00000000000000bb");
  EXPECT_EQ(text(), "# Before\n\n<!-- rubble report a -->\nold\n" + end +
                        "\nbetween\n<!-- rubble report b -->\n\nnew\n\n"
                        "<!-- end: depends on 00000000000000bb -->\nafter\n");
  const std::vector<demo::MarkedPart> parts = demo::markedParts(file(), "rubble");
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].command, "rubble report a");
  EXPECT_EQ(parts[0].dependsOn, "0000000000000000");
  EXPECT_EQ(parts[1].dependsOn, "00000000000000bb");
  EXPECT_TRUE(demo::markedParts(file(), "rubble_bench").empty());
}

TEST_F(Marked, AFileWithoutTheMarkersIsRefused) {
  m_folder.write("notes.md", "# Notes\n<!-- rubble report a -->\n<!-- rubble report b -->\n");
  EXPECT_THROW(demo::MarkedText(file(), "rubble report c"), demo::InputError);
  EXPECT_THROW(demo::MarkedText(file(), "rubble report a"), demo::InputError);  // no end
  m_folder.write("notes.md",
                 "# Notes\n<!-- rubble report a -->\n<!-- rubble_bench b -->\n<!-- end: depends on 0 -->\n");
  EXPECT_THROW(demo::markedParts(file(), "rubble"),
               demo::InputError);  // that end is of another program's part
  EXPECT_THROW(demo::MarkedText(m_folder.path() / "none.md", "rubble report a"), demo::InputError);
}

// What a report depends on: every key of the scene, the presets among them; not how it looks.
TEST_F(Marked, TheHashKnowsTheSceneAndNotItsLook) {
  const std::filesystem::path scene = m_folder.write("small.json", kSmallWall);
  demo::ReportOptions options;
  options.scene = scene.string();
  const std::string first = demo::reportHash(options);
  EXPECT_EQ(first.size(), 16u);
  options.overrides = {{"camera.field_of_view_degrees", "30"}, {"light.ambient", "0.5"}};
  EXPECT_EQ(demo::reportHash(options), first);
  for (const auto& [key, value] :
       {std::pair("objects.0.material.friction", "0.61"), std::pair("impactors.0.velocity", "[0,0,10.5]"),
        std::pair("seed", "7"), std::pair("objects.0.anchor", "[0,1,0]"), std::pair("debris", "null")}) {
    options.overrides = {{key, value}};
    EXPECT_NE(demo::reportHash(options), first) << key;
  }
  options.overrides = {};
  options.sweeps = {demo::parseSweep("precision=float;double")};
  EXPECT_NE(demo::reportHash(options), first);
}

// A table counts broken springs, crushed elements and dust, and says how fast the impactor comes out.
TEST_F(Marked, TheHashKnowsEveryPartOfTheSolversVersion) {
  demo::ReportOptions options;
  options.scene = m_folder.write("small.json", kSmallWall);
  const std::string first = demo::reportHash(options);
  for (std::size_t i = 0; i < std::size(kSolverVersions); ++i) {
    for (std::uint64_t SolverVersion::*part :
         {&SolverVersion::world, &SolverVersion::debris, &SolverVersion::dust}) {
      std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
      versions[i].*part ^= 1;
      EXPECT_NE(demo::reportHash(options, versions), first) << versions[i].precision;
    }
  }
}

TEST(Sweep, IsAKeyAndItsValues) {
  const demo::Sweep sweep = demo::parseSweep("impactors.0.velocity=[0,0,2];[0,0,5]");
  EXPECT_EQ(sweep.key, "impactors.0.velocity");
  EXPECT_EQ(sweep.values, (std::vector<std::string>{"[0,0,2]", "[0,0,5]"}));
  for (const char* bad : {"seed", "seed=", "=1;2", "seed=1;;2"})
    EXPECT_THROW(demo::parseSweep(bad), demo::InputError) << bad;
}

}  // namespace
}  // namespace rubble::test
