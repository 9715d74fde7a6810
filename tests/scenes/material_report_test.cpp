// `rubble report materials`: what is asked for on the command line, the tables, and what one preset reaches.
#include "demo/material_report.h"

#include <gtest/gtest.h>

#include "demo/input_error.h"
#include "scenes/parsed.h"

namespace rubble::test {
namespace {

TEST(MaterialReport, IsAskedForByItsName) {
  const demo::CommandLine line = parsed({"report", "materials", "--out", "o", "--write", "w.md"});
  EXPECT_EQ(line.command, demo::CommandLine::Command::MaterialReport);
  EXPECT_EQ(line.materialReport.folder, "o");
  EXPECT_EQ(line.materialReport.write, "w.md");
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"report", "materials", "--quick"},
                                              {"report", "materials", "--seed", "2"},
                                              {"report", "materials", "cantilever"},
                                              {"report", "materials", "--set", "seed=1"},
                                              {"report", "materials", "--all"}})
    EXPECT_THROW(parsed(bad), demo::InputError) << bad.back();
}

TEST(MaterialReport, TheTablesTellWhatWasAskedAndReached) {
  const std::vector<demo::MaterialRow> rows = {{"m", "pulled", 64, 2e6, 1e6},
                                               {"m", "pulled", 216, 2e6, 3e6},
                                               {"n", "pulled", 64, 4e6, 4e6},
                                               {"n", "pulled", 216, 4e6, 5e6}};
  EXPECT_EQ(demo::materialTable(rows),
            (demo::TextRows{{"material", "test", "asked", "64 elements", "216 elements"},
                            {"m", "pulled", "2", "1 (0.5)", "3 (1.5)"},
                            {"n", "pulled", "4", "4 (1)", "5 (1.25)"}}));
  const demo::TextRows csv = demo::materialCsv(rows);
  ASSERT_EQ(csv.size(), 5u);
  EXPECT_EQ(std::vector<std::string>(csv[2].begin(), csv[2].begin() + 6),
            (std::vector<std::string>{"m", "pulled", "216", "2e+06", "3e+06", "1.5"}));
  for (const std::vector<std::string>& row : csv) EXPECT_EQ(row.size(), csv[0].size());
}

TEST(MaterialReport, TheHashKnowsTheMaterialsAndTheSolver) {
  std::vector<Material> materials = {material("concrete")};
  const std::string first = demo::materialReportHash(materials);
  EXPECT_EQ(first.size(), 16u);
  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[0].world ^= 1;
  EXPECT_NE(demo::materialReportHash(materials, versions), first);
  materials[0].tensileStrength *= 2;
  EXPECT_NE(demo::materialReportHash(materials), first);
}

// The bounds of tests/physics: 0.6 to 1.3 of a strength, 1 % of the modulus when pulled, 8 % when bent.
TEST(MaterialReport, ASoftPresetReachesWhatItAsksFor) {
  const std::vector<demo::MaterialRow> rows = demo::testMaterial(material("concrete_soft"), 64);
  ASSERT_EQ(rows.size(), 5u);
  for (const demo::MaterialRow& row : rows) {
    const double ratio = row.reached / row.asked;
    if (row.test.starts_with("E")) {
      EXPECT_NEAR(ratio, 1, row.test == "E, cube pulled" ? 0.01 : 0.08) << row.test;
    } else {
      EXPECT_GT(ratio, 0.6) << row.test;
      EXPECT_LT(ratio, 1.3) << row.test;
    }
  }
  EXPECT_TRUE(demo::testMaterial(material("concrete_soft"), 65).empty());
}

}  // namespace
}  // namespace rubble::test
