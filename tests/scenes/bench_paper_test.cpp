// `rubble bench paper`: the paper's own figures, the options, and the files. No time is asserted.
#include "demo/bench_paper.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "demo/bar_chart.h"
#include "demo/bench_result.h"
#include "demo/csv_table.h"
#include "demo/input_error.h"
#include "scenes/parsed.h"
#include "scenes/scene_file.h"
#include "scenes/xml.h"

namespace rubble::test {
namespace {

// Times that differ in every part, so that columns cannot be swapped unseen.
std::vector<demo::BenchRow> twoRows() {
  demo::BenchRow drawn{.part = "a",
                       .scene = "wall",
                       .elements = 2048,
                       .width = 320,
                       .height = 180,
                       .dust = 64,
                       .paperFps = 9.0,
                       .times = {}};
  drawn.times = {.total = 500,
                 .simulation = 300,
                 .dust = 60,
                 .pictures = 140,
                 .substeps = 244,
                 .cores = 1.5,
                 .frames = 60};
  demo::BenchRow bare = drawn;
  bare.part = "figure 8";
  bare.scene = "column";
  bare.width = bare.height = 0;
  bare.paperFps.reset();
  return {drawn, bare};
}

demo::BenchMachine someMachine() {
  return {.name = "A \"fast\" one, of <two> & more",
          .processors = 4,
          .dustThreads = 2,
          .renderer = "llvmpipe",
          .load = 0.25};
}

// Table 1, section 5: the settings that (a), (b) and (c) have in common have one speed, and so has figure 6.
TEST(PaperTable, SharedSettingsHaveOneSpeed) {
  int shared = 0;
  for (const demo::PaperCell& cell : demo::kPaperTable) {
    if (cell.width != 1280 || cell.elements != 2048 || cell.dust != 64 || !cell.pictures) continue;
    ++shared;
    EXPECT_EQ(cell.fps, 8.8) << cell.part;
  }
  EXPECT_EQ(shared, 3);
  EXPECT_EQ(demo::kPaperFigures[0].fps, 8.8);
}

// Table 1 has 4, 5, 4 and 5 columns; (d) alone is without rendering. Sums of the printed numbers.
TEST(PaperTable, HasTheCellsOfThePage) {
  const auto part = [](char name) {
    std::pair<int, double> countAndSum;
    for (const demo::PaperCell& cell : demo::kPaperTable) {
      if (cell.part != name) continue;
      countAndSum.first += 1;
      countAndSum.second += cell.fps;
      EXPECT_EQ(cell.pictures, name != 'd');
    }
    return countAndSum;
  };
  EXPECT_EQ(part('a').first, 4);
  EXPECT_DOUBLE_EQ(part('a').second, 9.0 + 8.9 + 8.9 + 8.8);
  EXPECT_EQ(part('b').first, 5);
  EXPECT_DOUBLE_EQ(part('b').second, 11.0 + 10.7 + 10.7 + 10.6 + 8.8);
  EXPECT_EQ(part('c').first, 4);
  EXPECT_DOUBLE_EQ(part('c').second, 9.1 + 9.1 + 9.0 + 8.8);
  EXPECT_EQ(part('d').first, 5);
  EXPECT_DOUBLE_EQ(part('d').second, 320 + 160 + 75 + 30 + 9.1);
}

TEST(BenchPaper, TheStandardIsThePapersSizeWithPictures) {
  const demo::CommandLine line = parsed({"bench", "paper"});
  EXPECT_EQ(line.command, demo::CommandLine::Command::BenchPaper);
  EXPECT_EQ(line.benchPaper.width, 1280);
  EXPECT_EQ(line.benchPaper.height, 720);
  EXPECT_TRUE(line.benchPaper.render);
  EXPECT_EQ(line.benchPaper.frames, "60");
  EXPECT_FALSE(line.benchPaper.mostElements.has_value());
}

TEST(BenchPaper, TakesItsOptions) {
  const demo::BenchPaperOptions options =
      parsed({"bench", "paper", "--frames", "3", "--size", "320x180", "--most-elements", "256", "--no-render",
              "--threads", "2", "--csv", "a.csv", "--svg", "a.svg", "--write", "a.md"})
          .benchPaper;
  EXPECT_EQ(options.frames, "3");
  EXPECT_EQ(options.width, 320);
  EXPECT_EQ(options.height, 180);
  EXPECT_EQ(options.mostElements, 256);
  EXPECT_FALSE(options.render);
  EXPECT_EQ(options.threads, 2);
  EXPECT_EQ(options.csv, "a.csv");
  EXPECT_EQ(options.svg, "a.svg");
  EXPECT_EQ(options.write, "a.md");
}

TEST(BenchPaper, TheHashKnowsTheRunsAndNotTheFiles) {
  const demo::BenchPaperOptions all;
  const std::string first = demo::benchPaperHash(all);
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(demo::benchPaperHash({.csv = "a.csv"}), first);
  EXPECT_NE(demo::benchPaperHash({.frames = "59"}), first);
  EXPECT_NE(demo::benchPaperHash({.mostElements = 2048}), first);  // figure 7 has 2304
  EXPECT_NE(demo::benchPaperHash({.render = false}), first);
  std::vector<SolverVersion> versions(std::begin(kSolverVersions), std::end(kSolverVersions));
  versions[0].world ^= 1;
  EXPECT_NE(demo::benchPaperHash(all, versions), first);
}

TEST(BenchResult, TheCsvHasAColumnForEverySettingAndTime) {
  const demo::TextRows table = demo::benchCsv(twoRows(), someMachine());
  ASSERT_EQ(table.size(), 3u);
  const auto cell = [&](std::size_t row, const char* column) {
    const auto at = std::ranges::find(table[0], column);
    return at == table[0].end() ? "no such column" : table[row].at(at - table[0].begin());
  };
  for (const auto& [column, value] :
       std::vector<std::pair<const char*, std::string>>{{"part", "a"},
                                                        {"scene", "wall"},
                                                        {"elements", "2048"},
                                                        {"width", "320"},
                                                        {"height", "180"},
                                                        {"dust_resolution", "64"},
                                                        {"paper_fps", "9"},
                                                        {"fps", "2"},
                                                        {"ms_per_frame", "500"},
                                                        {"ms_simulation", "300"},
                                                        {"ms_dust", "60"},
                                                        {"ms_pictures", "140"},
                                                        {"substeps_per_frame", "244"},
                                                        {"cores_used", "1.5"},
                                                        {"frames", "60"},
                                                        {"dust_threads", "2"},
                                                        {"processors", "4"},
                                                        {"load_average", "0.25"},
                                                        {"renderer", "llvmpipe"},
                                                        {"machine", someMachine().name}})
    EXPECT_EQ(cell(1, column), value) << column;
  EXPECT_EQ(cell(2, "paper_fps"), "");
  EXPECT_EQ(cell(2, "width"), "0");
  EXPECT_EQ(table[0].size(), 20u);
}

TEST(BenchResult, TheTableSaysWhenThePicturesAreNotOfThePapersSize) {
  const std::string words = "is not of the paper's 1280x720";
  std::vector<demo::BenchRow> rows = twoRows();
  EXPECT_NE(demo::benchMarkdown(rows, someMachine()).find(words), std::string::npos);
  rows[0].width = 1280;
  rows[0].height = 720;
  EXPECT_EQ(demo::benchMarkdown(rows, someMachine()).find(words), std::string::npos);
}

// The checker of the next tests sees what it must.
TEST(Xml, FaultsAreFound) {
  EXPECT_EQ(faultOfXml("<a x=\"1\"><b/>t &amp; u</a>\n"), "");
  for (const char* bad : {"", "text", "<a>", "<a></b>", "<a/><b/>", "<a>x & y</a>", "<a x=1/>",
                          "<a x=\"<\"/>", "<a x=\"1\"y=\"2\"/>", "<a><b></a></b>", "<a/>text", "<a"})
    EXPECT_NE(faultOfXml(bad), "") << bad;
}

TEST(BenchResult, TheChartIsWellFormedXmlWhateverTheNames) {
  const std::string svg = demo::benchSvg(twoRows(), someMachine());
  EXPECT_EQ(faultOfXml(svg), "");
  EXPECT_NE(svg.find("of &lt;two&gt; &amp; more"), std::string::npos);
}

// On a logarithmic axis equal ratios are equal lengths: the bars of 1, 10 and 100 differ by one step each.
TEST(BarChart, BarsAreLogarithmic) {
  const std::string svg = demo::svgOf({.title = "t",
                                       .axis = "a",
                                       .first = "one",
                                       .second = "two",
                                       .rows = {{"x", 1, 10}, {"y", 100, std::nullopt}},
                                       .notes = {}});
  EXPECT_EQ(faultOfXml(svg), "");
  std::vector<double> lengths;
  const std::string wanted = "height=\"9\" fill=";  // bars, and the two squares of the legend before them
  for (auto at = svg.find(wanted); at != svg.npos; at = svg.find(wanted, at + 1)) {
    const auto width = svg.rfind("width=\"", at) + std::string("width=\"").size();
    lengths.push_back(std::stod(svg.substr(width)));
  }
  ASSERT_EQ(lengths.size(), 5u);
  EXPECT_GT(lengths[2], 0);
  EXPECT_NEAR(lengths[3] - lengths[2], lengths[4] - lengths[3], 0.01);  // printed to six digits
  EXPECT_GT(lengths[3], lengths[2]);
}

TEST(BarChart, LongNotesAreBrokenBetweenWords) {
  const std::string half(70, 'x');  // two of them and a space are longer than the line of 130 letters
  const std::string svg = demo::svgOf({.title = "t",
                                       .axis = "a",
                                       .first = "one",
                                       .second = "two",
                                       .rows = {{"x", 1, 10}},
                                       .notes = {half + " " + half}});
  EXPECT_EQ(svg.find(half + " "), std::string::npos);
  const auto first = svg.find(half);
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(svg.find(half, first + half.size()), std::string::npos);
}

TEST(Csv, CellsWithCommasAndQuotesAreQuoted) {
  EXPECT_EQ(demo::csvTable({{"a", "b"}, {"1,2", "say \"no\""}}), "a,b\n\"1,2\",\"say \"\"no\"\"\"\n");
}

}  // namespace
}  // namespace rubble::test
