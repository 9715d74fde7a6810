// What the compute back end refuses, and by what name.
#include <filesystem>
#include <fstream>

#include "gl/dust/both.h"
#include "support/folders.h"

namespace rubble::test {
namespace {

std::string refusalOf(const DustGridDef& def, const std::string& directory) {
  try {
    createDustGridGl(def, directory);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

class DustRefusal : public Both {};

TEST_F(DustRefusal, NamesAShaderThatIsNotThere) {
  EXPECT_NE(refusalOf(grid(), "nowhere").find("dust/add_sources.comp"), std::string::npos);
}

TEST_F(DustRefusal, ReportsTheLogOfAKernelThatDoesNotBuild) {
  const std::string directory = ::testing::TempDir() + "rubble_broken_kernel";
  std::filesystem::create_directories(directory + "/dust");
  std::ofstream(directory + "/dust/broken.comp")
      << "layout(local_size_x = 1) in;\nvoid main() { missing(); }\n";
  const dust::GlKernelSource source(directory, 32);
  try {
    source.build("broken.comp");
    FAIL() << "a broken kernel was built";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("dust/broken.comp"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("missing"), std::string::npos) << e.what();
  }
  std::filesystem::remove_all(directory);
}

TEST_F(DustRefusal, ChecksTheDefinitionAsTheCpuDoes) {
  DustGridDef def = grid();
  def.resolution = 33;
  EXPECT_NE(refusalOf(def, test::shaderFolder()).find("resolution"), std::string::npos);
}

TEST(DustWithoutContext, IsRefused) {
  EXPECT_NE(refusalOf(DustGridDef{}, test::shaderFolder()).find("OpenGL 4.3"), std::string::npos);
}

}  // namespace
}  // namespace rubble::test
