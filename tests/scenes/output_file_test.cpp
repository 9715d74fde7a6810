// Files of results on disks that fill up.
#include "demo/output_file.h"

#include <gtest/gtest.h>

#include <sstream>

#include "demo/input_error.h"
#include "rubble/machine_error.h"
#include "scenes/full_disk.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(OutputFile, CanBeReadWhileItGrows) {
  const TestFolder folder;
  demo::OutputFile file(folder.path() / "a");
  file.append("one\n");
  EXPECT_EQ(textOf(folder.path() / "a"), "one\n");
  file.append("two\n");
  EXPECT_EQ(textOf(folder.path() / "a"), "one\ntwo\n");
}

TEST(OutputFile, EndsWithItsLastWholePieceWhenTheDiskIsFull) {
  const TestFolder folder;
  const FileSizeLimit limit(10);
  demo::OutputFile file(folder.path() / "a");
  file.append("one\ntwo\n");
  EXPECT_THROW(file.append("three\n"), MachineError);
  EXPECT_EQ(textOf(folder.path() / "a"), "one\ntwo\n");
}

TEST(OutputFile, IsRemovedWhenNothingOfItFits) {
  const TestFolder folder;
  const FileSizeLimit limit(3);
  EXPECT_THROW(demo::OutputFile(folder.path() / "a").append("one\n"), MachineError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a"));
}

TEST(OutputFile, ADeviceAndALinkToOneStay) {
  const TestFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "full");
  try {
    demo::OutputFile(folder.path() / "full").append("one\n");
    ADD_FAILURE() << "/dev/full takes nothing";
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "full"));
}

TEST(OutputFile, WholeFilesReplaceTheOldOneOrLeaveItAlone) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a";
  demo::writeWhole(file, "old\n");
  {
    const FileSizeLimit limit(5);
    EXPECT_THROW(demo::writeWhole(file, "too long\n"), MachineError);
  }
  EXPECT_EQ(textOf(file), "old\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.part"));
  demo::writeWhole(file, "new\n");
  EXPECT_EQ(textOf(file), "new\n");
}

TEST(OutputFile, NamesThatCannotBeFoldersAreRefused) {
  const TestFolder folder;
  const std::string file = folder.write("file", "");
  EXPECT_THROW(demo::checkFolder("--out", file), demo::InputError);
  EXPECT_THROW(demo::checkFolder("--out", file + "/below"), demo::InputError);
  EXPECT_THROW(demo::checkFolder("--out", folder.path() / std::string(300, 'x')), demo::InputError);
  EXPECT_NO_THROW(demo::checkFolder("--out", folder.path() / "new/newer"));
}

}  // namespace
}  // namespace rubble::test
