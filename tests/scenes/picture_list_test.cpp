// Which files a run with pictures removes and which it refuses to replace. No GL: only names matter.
#include "demo/picture_list.h"

#include <gtest/gtest.h>

#include "demo/input_error.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

class Folder : public testing::Test {
 protected:
  bool exists(const std::string& name) const {
    return std::filesystem::exists(std::filesystem::symlink_status(m_folder.path() / name));
  }
  demo::PictureList list() const { return {m_folder.path(), "small.mp4"}; }
  // What a run does that writes these files.
  void runThatWrites(const std::vector<std::string>& names) const {
    demo::PictureList list = this->list();
    list.startAnew();
    for (const std::string& name : names) {
      list.add(name);
      m_folder.write(name, "ours");
    }
  }
  // Appends lines to a list of ours.
  void forge(const std::string& lines) const {
    std::ofstream(m_folder.path() / demo::PictureList::kName, std::ios::app) << lines;
  }

  TestFolder m_folder;
};

TEST_F(Folder, ASecondRunRemovesThePicturesAndTheMovieOfTheFirst) {
  runThatWrites({"frame_0000.png", "frame_0007.png", "small.mp4"});
  demo::PictureList second = list();
  second.requireFree(8);
  second.startAnew();
  for (const char* name : {"frame_0000.png", "frame_0007.png", "small.mp4"})
    EXPECT_FALSE(exists(name)) << name;
}

TEST_F(Folder, WhatAKilledRunWasWritingIsRemovedToo) {
  runThatWrites({"frame_0000.png", "small.mp4.part"});
  m_folder.write("frame_0000.png.part", "half");
  demo::PictureList second = list();
  second.requireFree(1);
  second.startAnew();
  for (const char* name : {"frame_0000.png", "frame_0000.png.part", "small.mp4.part"})
    EXPECT_FALSE(exists(name)) << name;
}

TEST_F(Folder, PicturesOfOthersStay) {
  runThatWrites({"frame_0000.png"});
  for (const char* name : {"frame_beach_holiday.png", "frame_0001.png", "notes.txt"})
    m_folder.write(name, "mine");
  demo::PictureList second = list();
  second.requireFree(1);
  second.startAnew();
  for (const char* name : {"frame_beach_holiday.png", "frame_0001.png", "notes.txt"})
    EXPECT_TRUE(exists(name));
}

TEST_F(Folder, APictureOrMovieOfOthersInTheWayIsRefused) {
  for (const char* name : {"frame_0001.png", "small.mp4", "frame_0001.png.part"}) {
    m_folder.write(name, "mine");
    EXPECT_THROW(list().requireFree(2), demo::InputError) << name;
    std::filesystem::remove(m_folder.path() / name);
    EXPECT_NO_THROW(list().requireFree(2));
  }
}

// Whatever stands in the list, nothing is removed but regular files of this folder with a picture's name.
TEST_F(Folder, AForgedListRemovesNothingElse) {
  const TestFolder other;
  other.write("frame_0000.png", "mine");
  other.write("victim.png", "mine");
  runThatWrites({});
  for (const char* name :
       {"frame_1.png", "frame_00001.png", "frame_-001.png", "frame_0001.pngx", "notes.txt"})
    m_folder.write(name, "mine");
  std::filesystem::create_directories(m_folder.path() / "frame_0003.png");
  std::filesystem::create_symlink(other.path() / "victim.png", m_folder.path() / "frame_0002.png");
  forge("../" + other.path().filename().string() + "/frame_0000.png\n" + other.path().string() +
        "/frame_0000.png\nframe_1.png\nframe_00001.png\nframe_-001.png\nframe_0001.pngx\nnotes.txt\n"
        "frame_0002.png\nframe_0003.png\n.\n..\n\n");
  list().startAnew();
  EXPECT_TRUE(std::filesystem::exists(other.path() / "frame_0000.png"));
  EXPECT_TRUE(std::filesystem::exists(other.path() / "victim.png"));
  for (const char* name : {"frame_1.png", "frame_00001.png", "frame_-001.png", "frame_0001.pngx", "notes.txt",
                           "frame_0002.png", "frame_0003.png"})
    EXPECT_TRUE(exists(name)) << name;
}

TEST_F(Folder, AListedNameThatIsALinkNowIsInTheWay) {
  runThatWrites({"frame_0000.png"});
  std::filesystem::rename(m_folder.path() / "frame_0000.png", m_folder.path() / "kept.png");
  std::filesystem::create_symlink("kept.png", m_folder.path() / "frame_0000.png");
  EXPECT_THROW(list().requireFree(1), demo::InputError);
}

TEST_F(Folder, AFileThatOnlyHasTheListsNameIsRefused) {
  m_folder.write(demo::PictureList::kName, "my own notes\nframe_0000.png\n");
  EXPECT_THROW(list(), demo::InputError);
  std::filesystem::remove(m_folder.path() / demo::PictureList::kName);
  std::filesystem::create_symlink("/etc/hostname", m_folder.path() / demo::PictureList::kName);
  EXPECT_THROW(list(), demo::InputError);
}

TEST_F(Folder, TheMovieOfAnotherSceneStaysAndStaysOurs) {
  runThatWrites({"small.mp4"});
  demo::PictureList(m_folder.path(), "wall.mp4").startAnew();
  EXPECT_TRUE(exists("small.mp4"));
  EXPECT_NO_THROW(list().requireFree(1));
}

}  // namespace
}  // namespace rubble::test
