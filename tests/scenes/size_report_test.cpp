// `rubble report element_size`: what is asked for on the command line, the closed form, the tables, and one
// blow.
#include "demo/size_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "demo/input_error.h"
#include "demo/size_run.h"
#include "scenes/parsed.h"

namespace rubble::test {
namespace {

TEST(SizeReport, IsAskedForByItsName) {
  const demo::CommandLine line =
      parsed({"report", "element_size", "--long", "--out", "o", "--write", "w.md"});
  EXPECT_EQ(line.command, demo::CommandLine::Command::SizeReport);
  EXPECT_TRUE(line.sizeReport.longest);
  EXPECT_EQ(line.sizeReport.folder, "o");
  EXPECT_EQ(line.sizeReport.write, "w.md");
  EXPECT_EQ(demo::wallSizes(line.sizeReport).back().elements, 32000u);
  EXPECT_EQ(demo::wallSizes({}).back().elements, 8000u);
  EXPECT_TRUE(parsed({"report", "element_size", "--quick"}).sizeReport.quick);
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"report", "element_size", "--quick", "--long"},
        {"report", "element_size", "--seed", "2"},
        {"report", "element_size", "--cases", "3"},
        {"report", "element_size", "--keep"},
        {"report", "element_size", "cantilever"},
        {"report", "stability", "--long"},
        {"report", "--all", "--long"}})
    EXPECT_THROW(parsed(bad), demo::InputError) << bad.back();
}

// A rod of 1 MPa at 2 GPa holds 250 J/m3, of 4 m 1000 J/m2.
TEST(SizeReport, AShorterSpringHoldsLessWhenItBreaks) {
  EXPECT_DOUBLE_EQ(demo::tensionEnergyPerArea(1e6, 2e9, 4), 1000);
  EXPECT_DOUBLE_EQ(demo::tensionEnergyPerArea(1e6, 2e9, 1), 250);
}

TEST(SizeReport, TheExponentIsThatOfAPowerLaw) {
  const std::vector<double> x = {1, 2, 5, 7};
  std::vector<double> y;
  for (const double v : x) y.push_back(3 * std::pow(v, -1.5));
  EXPECT_NEAR(demo::exponentOf(x, y), -1.5, 1e-12);
  EXPECT_FALSE(std::isfinite(demo::exponentOf(std::vector<double>{2, 2}, std::vector<double>{1, 3})));
}

TEST(SizeReport, ARowIsTheMeanOfThePackings) {
  std::vector<demo::SizeRun> runs(3);
  for (demo::SizeRun& run : runs) {
    run.wanted = run.elements = 500;
    run.exitSpeed = 6;
  }
  runs[1].exitSpeed = 7;
  runs[2].wanted = 1000;
  runs[2].elements = 1001;
  runs[2].exitSpeed = 5;
  const demo::TextRows table = demo::sizeTable(runs);
  ASSERT_EQ(table.size(), 3u);
  const auto column = std::size_t(std::ranges::find(table[0], "exit speed, m/s") - table[0].begin());
  EXPECT_EQ(table[1][0], "500");
  EXPECT_EQ(table[1][1], "2");
  EXPECT_EQ(table[1][column], "6.5 +- 0.5");
  EXPECT_EQ(table[2][0], "1001");
  EXPECT_EQ(table[2][column], "5");
  EXPECT_EQ(demo::sizeCsv(runs).size(), 4u);
}

TEST(SizeReport, TheHashKnowsTheSizesAndTheSolver) {
  const std::string first = demo::sizeReportHash({});
  EXPECT_EQ(first.size(), 16u);
  demo::SizeReportOptions longest;
  longest.longest = true;
  EXPECT_NE(demo::sizeReportHash(longest), first);
  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[0].world ^= 1;
  EXPECT_NE(demo::sizeReportHash({}, versions), first);
}

// 0.08 m3 in 60 elements. A spring bent to its strength holds a third of one pulled to it, since stress goes
// from nothing to f_t across its face. At most it is sheared to the cohesion, sqrt(10) / 2 of f_t, as well,
// by springs as stiff that way: three and a half times the closed form; blows overshoot.
TEST(SizeReport, ABlowLeavesCracksWhoseEnergyIsTheClosedForms) {
  const demo::SizeRun run = demo::runSized(60, 1);
  EXPECT_NEAR(run.spacing, std::cbrt(0.08 / run.elements), 1e-3 * run.spacing);
  EXPECT_NEAR(run.asked, 0.2e6 * 0.2e6 * run.spacing / (2 * 30e6), 1e-9 * run.asked + 1e-12);
  EXPECT_GT(run.crackArea, 0);
  EXPECT_GT(run.tensionEnergy, run.asked / 3);
  EXPECT_LT(run.tensionEnergy, 4 * run.asked);
  EXPECT_GT(run.largest, 0);
  EXPECT_LE(run.heavy, run.light);
}

}  // namespace
}  // namespace rubble::test
