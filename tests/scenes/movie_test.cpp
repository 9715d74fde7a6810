// What becomes of a run's movie, with programs of the test's own in place of ffmpeg.
#include "demo/movie.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "rubble/machine_error.h"
#include "scenes/scene_file.h"

namespace rubble::test {
namespace {

class Movie : public testing::Test {
 protected:
  Movie() : m_path(std::getenv("PATH")), m_out(m_folder.path() / "100%d") {
    std::filesystem::create_directories(m_out);
    std::filesystem::create_directories(m_folder.path() / "bin");
    m_folder.write("100%d/frame_0000.png", "picture");
    setenv("PATH", (m_folder.path() / "bin").c_str(), 1);
  }
  ~Movie() override { setenv("PATH", m_path.c_str(), 1); }
  // `script` sees the output's name as $part.
  void installFfmpeg(const std::string& script) const {
    const std::string file =
        m_folder.write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\npart=${last#file:}\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  bool write() {
    demo::PictureList list(m_out, "small.mp4");
    list.startAnew();
    return demo::writeMovie(m_out, "small.mp4", 1, 60, list);
  }
  std::string failure() {
    try {
      write();
    } catch (const MachineError& error) {
      return error.what();
    }
    return "";
  }
  void expectOnlyThePicture() const {
    EXPECT_TRUE(std::filesystem::exists(m_out / "frame_0000.png"));
    EXPECT_FALSE(std::filesystem::exists(m_out / "small.mp4"));
    EXPECT_FALSE(std::filesystem::exists(m_out / "small.mp4.part"));
  }

  TestFolder m_folder;
  std::string m_path;
  std::filesystem::path m_out;  // a % in it is no pattern
};

TEST_F(Movie, WithoutFfmpegThereIsNoneAndThatIsNoFailure) {
  EXPECT_FALSE(write());
  expectOnlyThePicture();
}

TEST_F(Movie, IsMadeFromThePicturesOfItsFolder) {
  installFfmpeg("test -f frame_0000.png && echo \"$@\" > \"$part\"");
  EXPECT_TRUE(write());
  std::ifstream movie(m_out / "small.mp4");
  std::string arguments;
  std::getline(movie, arguments);
  EXPECT_NE(arguments.find(" -i frame_%04d.png "), std::string::npos) << arguments;
  EXPECT_EQ(arguments.find("100%d"), std::string::npos) << arguments;
  EXPECT_FALSE(std::filesystem::exists(m_out / "small.mp4.part"));
  EXPECT_NO_THROW(demo::PictureList(m_out, "small.mp4").requireFree(0)) << "the movie must be listed";
}

TEST_F(Movie, AFailingFfmpegIsToldWithItsReason) {
  installFfmpeg("echo first >&2; echo 'Unknown encoder mpeg4' >&2; exit 1");
  EXPECT_NE(failure().find("ffmpeg ended with exit code 1: Unknown encoder mpeg4"), std::string::npos)
      << failure();
  expectOnlyThePicture();
}

TEST_F(Movie, HalfAMovieIsRemoved) {
  installFfmpeg("echo half > \"$part\"; exit 3");
  EXPECT_NE(failure().find("exit code 3"), std::string::npos) << failure();
  expectOnlyThePicture();
  installFfmpeg("echo half > \"$part\"; kill -9 $$");
  EXPECT_NE(failure().find("signal 9"), std::string::npos) << failure();
  expectOnlyThePicture();
}

TEST_F(Movie, AnFfmpegThatWritesNothingHasFailed) {
  installFfmpeg("exit 0");
  EXPECT_NE(failure().find("left no movie"), std::string::npos) << failure();
  expectOnlyThePicture();
}

}  // namespace
}  // namespace rubble::test
