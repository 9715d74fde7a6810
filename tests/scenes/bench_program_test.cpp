// `rubble bench paper` from outside: its smallest run.
#include <fstream>
#include <sstream>

#include "scenes/program.h"
#include "scenes/xml.h"

namespace rubble::test {
namespace {

std::string readFile(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// The table's smallest wall, of (b) and (d). Its elements fill little of the wall, which cooking warns of.
TEST_F(Program, BenchPaperEndsInATableACsvAChartAndAPartOfAReadme) {
  m_folder.write("notes.md",
                 "# Notes\n\n<!-- rubble bench paper --frames 3 --size 64x36 --most-elements 128 -->\n"
                 "<!-- end: depends on 0000000000000000 -->\nafter\n");
  const ChildResult result = runChild(
      "cd " + m_folder.path().string() +
          " && " RUBBLE_PROGRAM
          " bench paper --frames 3 --size 64x36 --most-elements 128 --csv a.csv --svg a.svg --write notes.md",
      m_folder.path());
  ASSERT_EQ(result.exitCode, 0) << result.error;
  EXPECT_NE(result.error.find("bench: run 2 of 2, 100 %"), std::string::npos) << result.error;
  EXPECT_NE(result.out.find("| (b) | wall | 128 | 64x36 | 64^3 | 11 |"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("| (d) | wall | 128 | none | 64^3 | 320 |"), std::string::npos) << result.out;
  const std::string csv = readFile(m_folder.path() / "a.csv");
  EXPECT_EQ(lines(csv), 3) << csv;
  EXPECT_TRUE(csv.starts_with("part,scene,elements,width,height,dust_resolution,paper_fps,fps,")) << csv;
  EXPECT_NE(csv.find("\nb,wall,128,64,36,64,11,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nd,wall,128,0,0,64,320,"), std::string::npos) << csv;
  EXPECT_EQ(faultOfXml(readFile(m_folder.path() / "a.svg")), "");
  const std::string notes = readFile(m_folder.path() / "notes.md");
  EXPECT_NE(notes.find("| (d) | wall |"), std::string::npos) << notes;
  EXPECT_TRUE(notes.ends_with("-->\nafter\n"));
  EXPECT_EQ(notes.find("depends on 0000000000000000"), std::string::npos);
}

}  // namespace
}  // namespace rubble::test
