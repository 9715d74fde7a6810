// The thread that writes pictures. No GL: the pictures are made by hand.
#include "demo/picture_writer.h"

#include <gtest/gtest.h>

#include "rubble/machine_error.h"
#include "scenes/full_disk.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

Image grey(std::uint8_t level) {
  constexpr int kWidth = 64, kHeight = 36;
  return {kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight * 4, level)};
}

TEST(PictureWriter, WritesMorePicturesThanItsQueueHolds) {
  const TestFolder folder;
  demo::PictureWriter writer(folder.path());
  for (int frame = 0; frame < 30; ++frame) writer.save(frame, grey(std::uint8_t(frame)));
  writer.finish();
  for (int frame = 0; frame < 30; ++frame)
    EXPECT_TRUE(std::filesystem::exists(folder.path() / demo::pictureName(frame))) << frame;
}

TEST(PictureWriter, WritesWhatIsQueuedBeforeItGoes) {
  const TestFolder folder;
  { demo::PictureWriter(folder.path()).save(0, grey(1)); }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frame_0000.png"));
}

TEST(PictureWriter, TellsWhatFailed) {
  const TestFolder folder;
  demo::PictureWriter writer(folder.path() / "none");
  writer.save(0, grey(1));
  EXPECT_THROW(writer.finish(), Error);
}

TEST(PictureWriter, AFullDiskLeavesNoHalfPicture) {
  const TestFolder folder;
  const FileSizeLimit limit(50);  // [bytes]; the smallest picture takes more
  demo::PictureWriter writer(folder.path());
  writer.save(0, grey(1));
  EXPECT_THROW(writer.finish(), MachineError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PictureWriter, ListsWhatItWrites) {
  const TestFolder folder;
  {
    demo::PictureList list(folder.path(), "small.mp4");
    list.startAnew();
    demo::PictureWriter writer(folder.path(), &list);
    writer.save(3, grey(1));
    writer.finish();
  }
  demo::PictureList(folder.path(), "small.mp4").startAnew();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "frame_0003.png"));
}

TEST(PictureWriter, NamesSortByFrame) {
  EXPECT_EQ(demo::pictureName(0), "frame_0000.png");
  EXPECT_EQ(demo::pictureName(179), "frame_0179.png");
  EXPECT_EQ(demo::pictureName(12345), "frame_12345.png");
}

}  // namespace
}  // namespace rubble::test
