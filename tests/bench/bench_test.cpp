// Tables in READMEs are written by `rubble_bench TOPIC --write`; here is told when they are out of date, and
// the program writes one. What the numbers are is no test's business.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "base/hash.h"
#include "bench/asset_hash.h"
#include "bench/crack_path.h"
#include "bench/result_table.h"
#include "bench/site_sets.h"
#include "bench/topic.h"
#include "demo/input_error.h"
#include "demo/marked_text.h"
#include "scenes/child.h"
#include "scenes/scene_file.h"
#include "support/folders.h"
#include "support/grid_asset.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

// The layer's results or the benchmark's inputs have changed since: write the table again, and read what it
// says now.
TEST(BenchReadme, TablesBelongToTheLayersAsTheyAre) {
  std::set<std::string> written;
  for (const std::filesystem::path& file : readmes()) {
    for (const demo::MarkedPart& part : demo::markedParts(file, "rubble_bench")) {
      const std::string name = part.command.substr(part.command.find(' ') + 1);
      written.insert(name);
      EXPECT_EQ(part.dependsOn, demo::hashText(benchTopic(name).hash()))
          << "run: build/release/tests/bench/" << part.command << " --write " << file.string();
    }
  }
  for (const BenchTopic& topic : benchTopics()) EXPECT_TRUE(written.contains(topic.name)) << topic.name;
}

TEST(BenchTopic, UnknownIsRefusedWithThoseThereAre) {
  try {
    benchTopic("edem");
    FAIL();
  } catch (const demo::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(benchTopics().front().name), std::string::npos) << error.what();
  }
}

std::uint64_t hashOf(const Asset& asset) {
  base::Fnv1a hash;
  addAsset(hash, asset);
  return hash.value();
}

TEST(AssetHash, KnowsEveryField) {
  const Asset cooked = cook(wallMesh(), optionsFor(64));
  ASSERT_EQ(hashOf(cooked), hashOf(Asset(cooked)));
  using Change = void (*)(Asset&);
  const std::pair<const char*, Change> changes[] = {
      {"radius", [](Asset& a) { a.radius *= 2; }},
      {"position", [](Asset& a) { a.positions.back().z() += 1e-12; }},
      {"volume", [](Asset& a) { a.volumes.back() *= 2; }},
      {"gyration", [](Asset& a) { a.gyrations.back() *= 2; }},
      {"spring's ends", [](Asset& a) { std::swap(a.springs.back().first, a.springs.back().second); }},
      {"spring's area", [](Asset& a) { a.springs.back().area *= 2; }},
      {"anchor",
       [](Asset& a) {
         a.anchors.push_back({0, 1, Eigen::Vector3d::Zero()});
       }},
      {"vertex", [](Asset& a) { a.vertices.back().elements[3] = 0; }},
      {"corner", [](Asset& a) { a.corners.back().normal *= -1; }},
      {"triangle", [](Asset& a) { std::swap(a.triangles.back()[0], a.triangles.back()[1]); }},
      {"face", [](Asset& a) { a.faces.back().centroid.x() += 1; }},
      {"cell", [](Asset& a) { ++a.cells.back().innerTriangles; }}};
  for (const auto& [field, change] : changes) {
    Asset other = cooked;
    change(other);
    EXPECT_NE(hashOf(other), hashOf(cooked)) << field;
  }
}

// Cubes in rows: a flat crack between two layers is the cheapest, and each axis has a third of the springs.
// Along a diagonal a crack is a staircase, at most sqrt(2) of a flat one.
TEST(CrackPath, OfCubesIsFlatAlongTheAxes) {
  constexpr double kEdge = 0.5;
  const Asset asset = gridAsset({{8, 8, 8}, kEdge, Eigen::Vector3d::Zero(), false});
  const SurfaceMesh mesh = boxMesh(Eigen::Vector3d::Constant(8 * kEdge), asset.bounds().center());
  const cooking::CheckedMesh solid = cooking::checkMesh(mesh);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(crackRoughness(asset, solid, Eigen::Vector3d::Unit(axis), 2 * kEdge), 1, 1e-9) << axis;
  const double diagonal = crackRoughness(asset, solid, Eigen::Vector3d(1, 1, 0).normalized(), 2 * kEdge);
  EXPECT_GT(diagonal, 1.1);
  EXPECT_LE(diagonal, std::sqrt(2.0) + 1e-9);
  EXPECT_NEAR(shareOfOneDirection(asset), 1.0 / 3, 1e-9);
}

// The box holds whole cells of both lattices.
TEST(SiteSets, HaveTheCountsAndLieInside) {
  constexpr std::size_t kCount = 64;
  const cooking::CheckedMesh solid = cooking::checkMesh(boxMesh({1, 1, 1}));
  EXPECT_EQ(cubicSites(solid, kCount).size(), kCount);         // 4 x 4 x 4
  EXPECT_EQ(faceCentredSites(solid, 4 * 27).size(), 4u * 27);  // 3 x 3 x 3 cells of four
  EXPECT_EQ(lloydSites(solid, kCount, 3).size(), kCount);
  for (const Sites& sites : {cubicSites(solid, kCount), faceCentredSites(solid, kCount),
                             lloydSites(solid, kCount, 3), randomSites(solid, kCount)})
    for (const Eigen::Vector3d& site : sites) EXPECT_LT(site.cwiseAbs().maxCoeff(), 0.5);
}

TEST(TimeText, HasThreeDigitsAndTheUnitThatSuits) {
  EXPECT_EQ(timeText(1.304e-7), "130 ns");
  EXPECT_EQ(timeText(1.8e-6), "1.8 us");
  EXPECT_EQ(timeText(0.01824), "18.2 ms");
  EXPECT_EQ(timeText(2), "2 s");
}

class BenchProgram : public testing::Test {
 protected:
  ChildResult run(const std::string& arguments) {
    return runChild(std::string(RUBBLE_BENCH) + " " + arguments, m_folder.path());
  }
  TestFolder m_folder;
};

TEST_F(BenchProgram, HelpNamesEveryTopicAndTheWayToWrite) {
  const ChildResult help = run("--help");
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.out.find("--write FILE.md"), std::string::npos) << help.out;
  for (const BenchTopic& topic : benchTopics())
    EXPECT_NE(help.out.find(' ' + topic.name), std::string::npos) << topic.name;
  EXPECT_NE(help.out.find("--benchmark_filter"), std::string::npos) << help.out;
}

TEST_F(BenchProgram, WritesTheTableBetweenTheMarkers) {
  const std::string file = m_folder.write(
      "notes.md",
      "# Notes\n\n<!-- rubble_bench debris -->\n<!-- end: depends on 0000000000000000 -->\nafter\n");
  const ChildResult result = run("debris --benchmark_min_time=0 --benchmark_repetitions=1 --write " + file);
  ASSERT_EQ(result.exitCode, 0) << result.error;
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_TRUE(text.str().starts_with("# Notes\n\n<!-- rubble_bench debris -->\n\n|  | time | a piece |\n"))
      << text.str();
  EXPECT_NE(text.str().find("\n| a step, all rest | "), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("Medians of 1; one core of "), std::string::npos) << text.str();
  EXPECT_EQ(demo::markedParts(file, "rubble_bench").at(0).dependsOn,
            demo::hashText(benchTopic("debris").hash()));
}

TEST_F(BenchProgram, RefusesWhatItDoesNotKnow) {
  for (const char* bad : {"edem", "--write notes.md", "debris --fast", "debris --write none.md"}) {
    const ChildResult result = run(bad);
    EXPECT_EQ(result.exitCode, 2) << bad;
    EXPECT_TRUE(result.error.starts_with("rubble_bench: error: ")) << bad << ": " << result.error;
  }
}

}  // namespace
}  // namespace rubble::test
