// `rubble report stability`: what is asked for on the command line, the files, and that they count right.
#include "demo/stability_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "demo/input_error.h"
#include "demo/stability/case_world.h"
#include "demo/stability/known_faults.h"
#include "scenes/parsed.h"
#include "scenes/scene_file.h"
#include "scenes/xml.h"

namespace rubble::test {
namespace {

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(StabilityReport, IsAskedForByItsName) {
  const demo::CommandLine line =
      parsed({"report", "stability", "--cases", "12", "--out", "o", "--write", "w.md"});
  EXPECT_EQ(line.command, demo::CommandLine::Command::StabilityReport);
  EXPECT_EQ(line.stabilityReport.cases, 12);
  EXPECT_EQ(line.stabilityReport.folder, "o");
  EXPECT_EQ(line.stabilityReport.write, "w.md");
  EXPECT_EQ(parsed({"report", "stability"}).stabilityReport.cases, 500);
  EXPECT_EQ(parsed({"report", "stability", "--quick"}).stabilityReport.cases, 50);
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"report", "stability", "--quick", "--cases", "12"},
        {"report", "stability", "--cases", "0"},
        {"report", "stability", "--cases", "many"},
        {"report", "stability", "cantilever"},
        {"report", "stability", "--seed", "2"},
        {"report", "stability", "--reference"},
        {"report", "stability", "--all"},
        {"report", "cantilever", "--cases", "12"},
        {"report", "wall", "--cases", "12"}})
    EXPECT_THROW(parsed(bad), demo::InputError) << bad[1] << ' ' << bad.back();
}

TEST(StabilityReport, ItsNameIsAmongThoseThatAreKnown) {
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"report"}, {"report", "stabilty"}}) {
    try {
      parsed(bad);
      ADD_FAILURE() << bad.back() << " is taken";
    } catch (const demo::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("stability"), std::string::npos) << error.what();
    }
  }
  try {
    parsed({"report", "--help"});
    ADD_FAILURE() << "no help";
  } catch (const demo::HelpWanted& help) {
    EXPECT_NE(help.text.find("stability"), std::string::npos) << help.text;
  }
}

// Cells of a Markdown table's line.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream rest(line.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');)
    cells.push_back(cell.size() < 2 ? cell : cell.substr(1, cell.size() - 2));
  return cells;
}

// The first dozen, counted again from runs of their own.
TEST(StabilityReport, WritesWhatTheCasesCameTo) {
  constexpr int kCases = 12;
  const TestFolder folder;
  const std::string end = "<!-- end: depends on 0000000000000000 -->\n";
  const std::filesystem::path notes =
      folder.write("notes.md", "# Notes\n<!-- rubble report stability --cases 12 -->\n" + end);
  std::ostringstream out;
  demo::stabilityReport({kCases, folder.path() / "o", notes}, out);

  std::map<std::string, int> expected;
  int stockBroken = 0;
  for (int n = 0; n < kCases; ++n) {
    const stability::Case c = stability::stabilityCase(n);
    const stability::Outcome outcome = stability::run(c);
    ++expected[outcome.violations.empty() ? nameOf(outcome.kind) : "promise broken"];
    const bool toTheEnd = outcome.violations.empty() && outcome.kind <= stability::Outcome::Kind::Degraded;
    stockBroken += stability::runStock(c, toTheEnd ? outcome.ticks : 120).violation.empty() ? 0 : 1;
  }
  std::istringstream printed(out.str());
  std::string heading, rule, all;
  std::getline(printed, heading);
  std::getline(printed, rule);
  std::getline(printed, all);
  const std::vector<std::string> names = cellsOf(heading), counts = cellsOf(all);
  ASSERT_EQ(names.size(), 9u);
  ASSERT_EQ(counts.size(), 9u);
  EXPECT_EQ(counts[0], "all");
  EXPECT_EQ(counts[1], "12");
  for (std::size_t i = 2; i < 7; ++i) EXPECT_EQ(std::stoi(counts[i]), expected[names[i]]) << names[i];
  EXPECT_EQ(std::stoi(counts[7]), kCases - stockBroken);
  EXPECT_EQ(std::stoi(counts[8]), stockBroken);

  const std::string written = contentOf(notes);
  EXPECT_NE(written.find(all), std::string::npos);
  EXPECT_NE(written.find("depends on " + demo::stabilityReportHash(kCases)), std::string::npos);
  std::istringstream csv(contentOf(folder.path() / "o/stability.csv"));
  int lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, 1 + kCases);
  EXPECT_EQ(faultOfXml(contentOf(folder.path() / "o/stability.svg")), "");
}

// Made up: one of each kind, the last in stock Bullet alone.
std::vector<demo::StabilityResult> someResults() {
  std::vector<demo::StabilityResult> results(6);
  for (int n = 0; n < 6; ++n) results[std::size_t(n)].definition.number = n;
  using Kind = stability::Outcome::Kind;
  results[1].outcome.kind = Kind::Degraded;
  results[2].outcome.kind = Kind::Refused;
  results[3].outcome.kind = Kind::Stopped;
  results[4].outcome.violations = {"b < c, & d"};
  results[5].stock.violation = "a rigid body is not finite";
  return results;
}

TEST(StabilityReport, EveryRowOfTheTableAddsUp) {
  const demo::TextRows table = demo::stabilityTable(someResults());
  ASSERT_GT(table.size(), 5u);
  EXPECT_EQ(table[1], (demo::TextRows::value_type{"all", "6", "2", "1", "1", "1", "1", "5", "1"}));
  for (std::size_t row = 1; row < table.size(); ++row) {
    ASSERT_EQ(table[row].size(), table[0].size());
    const auto at = [&](std::size_t column) { return std::stoi(table[row][column]); };
    EXPECT_EQ(at(1), at(2) + at(3) + at(4) + at(5) + at(6)) << table[row][0];
    EXPECT_EQ(at(1), at(7) + at(8)) << table[row][0];
  }
  const demo::TextRows csv = demo::stabilityCsv(someResults());
  ASSERT_EQ(csv.size(), 7u);
  EXPECT_EQ(csv[5][1], "promise broken");
  EXPECT_EQ(csv[5][3], "b < c, & d");
  for (const std::vector<std::string>& row : csv) EXPECT_EQ(row.size(), csv[0].size());
}

// Each panel counts each case once, and those beyond an axis in its outermost cell.
TEST(StabilityReport, EveryCaseIsInACellOfEachPanel) {
  std::vector<demo::StabilityResult> results = someResults();
  results[0].definition.stiffness = 1e-9;
  results[1].definition.stiffness = 1e9;
  results[1].definition.massRatio = 1e9;
  results[2].definition.frameStep = 1;
  const demo::HeatMap map = demo::stabilityMap(results);
  ASSERT_EQ(map.panels.size(), 4u);
  for (const demo::HeatMap::Panel& panel : map.panels) {
    std::vector<int> sums(map.kinds.size());
    for (const std::vector<int>& cell : panel.counts)
      for (std::size_t k = 0; k < cell.size(); ++k) sums[k] += cell[k];
    const bool stock = panel.title.find("stock") != std::string::npos;
    EXPECT_EQ(sums, stock ? (std::vector<int>{5, 0, 0, 0, 1}) : (std::vector<int>{2, 1, 1, 1, 1}));
  }
  // The first: twelve columns of stiffness, six rows of mass ratio; ratio 1 is the lower end of the fourth
  // row.
  EXPECT_EQ(map.panels[0].counts[3 * 12 + 0], (std::vector<int>{1, 0, 0, 0, 0}));
  EXPECT_EQ(map.panels[0].counts[5 * 12 + 11], (std::vector<int>{0, 1, 0, 0, 0}));
  EXPECT_EQ(faultOfXml(demo::svgOf(map)), "");
}

TEST(StabilityReport, WhatIsBrokenIsNamedWithWhatIsKnownOfIt) {
  EXPECT_EQ(demo::brokenPromises({}), "");
  std::vector<demo::StabilityResult> results = someResults();
  EXPECT_NE(demo::brokenPromises(results).find("Case 4 breaks the promise, b < c, & d."), std::string::npos);
  for (const stability::KnownFault& fault : stability::kKnownFaults) {
    results[4].definition.number = fault.number;
    EXPECT_NE(demo::brokenPromises(results).find(fault.what), std::string::npos);
  }
}

TEST(StabilityReport, TheHashKnowsTheCasesAndTheSolver) {
  const std::string first = demo::stabilityReportHash(12);
  EXPECT_EQ(first.size(), 16u);
  EXPECT_NE(demo::stabilityReportHash(13), first);
  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[0].world ^= 1;
  EXPECT_NE(demo::stabilityReportHash(12, versions), first);
}

// In place of a body stands a box of its mass, size and friction: of 2 x 2 x 2 cubes of 0.1 m, 2400 kg/m3.
TEST(StockRun, HasABoxOfTheBodysMassAndSize) {
  stability::Case c;
  c.elements = 8;
  c.radius = 0.05;
  c.friction = 0.7;
  c.spin = 2;
  c.impactor = stability::Impactor::None;
  stability::CaseWorld world(c, stability::Engine::Stock);
  world.build();
  ASSERT_EQ(world.moved().size(), 1u);
  const btRigidBody& body = *world.moved().front();
  EXPECT_NEAR(1 / body.getInvMass(), 2400 * 0.008, 1e-4);
  btVector3 low, high;
  body.getAabb(low, high);
  EXPECT_NEAR(high.x() - low.x(), 0.2, 0.05);  // with Bullet's margins
  EXPECT_NEAR(body.getAngularVelocity().length(), 2, 1e-6);
  EXPECT_FLOAT_EQ(body.getFriction(), btScalar(0.7));
  EXPECT_EQ(world.bullet().destruction, nullptr);
}

// A box that falls from rest holds what gravity put in, m g times its way: nothing is broken, and the books
// agree before it lands.
TEST(StockRun, BooksWhatGravityPutsIn) {
  stability::Case c;
  c.elements = 1;
  c.impactor = stability::Impactor::None;
  c.frameStep = 1e-3;
  c.radius = 100;  // it starts a metre above the ground
  const stability::StockOutcome outcome = stability::runStock(c, 100);
  EXPECT_EQ(outcome.ticks, 100);
  EXPECT_EQ(outcome.violation, "");
  const double mass = 2400 * std::pow(200.0, 3), speed = 9.81 * 0.1;
  EXPECT_NEAR(outcome.energyHeld, 0.5 * mass * speed * speed, 1e-3 * outcome.energyHeld);
  EXPECT_NEAR(outcome.energyPut, outcome.energyHeld, 0.02 * outcome.energyHeld);
}

}  // namespace
}  // namespace rubble::test
