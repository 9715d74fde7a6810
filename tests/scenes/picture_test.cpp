// Runs with pictures: they are written, show the scene, and do not touch the simulation.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run.h"
#include "scene_file.h"

namespace rubble::tests {
namespace {

std::vector<unsigned char> readPng(const std::filesystem::path& file, int& width, int& height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, file.c_str())) return {};
  image.format = PNG_FORMAT_RGB;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr);
  width = static_cast<int>(image.width);
  height = static_cast<int>(image.height);
  return pixels;
}

class Pictures : public testing::Test {
 protected:
  /// Hashes of elements and Bullet bodies of all frames.
  std::string run(bool render, const std::vector<demo::Override>& overrides = {}) {
    const demo::Scene scene = demo::loadScene(m_folder.write("small.json", kSmallWall), overrides);
    std::ostringstream report;
    demo::runScene(scene, {.out = m_folder.path() / "out", .render = render, .width = 160, .height = 90},
                   report);
    std::ifstream stats(m_folder.path() / "out/stats.jsonl");
    std::string hashes;
    for (std::string line; std::getline(stats, line);) {
      const auto frame = nlohmann::json::parse(line);
      hashes += frame["hash"].get<std::string>() + "\n";
    }
    return hashes;
  }
  TestFolder m_folder;
};

TEST_F(Pictures, OneAFrameAndTheyShowSomething) {
  run(true);
  for (int frame = 0; frame < 5; ++frame) {
    int width = 0, height = 0;
    const auto pixels =
        readPng(m_folder.path() / "out" / ("frame_000" + std::to_string(frame) + ".png"), width, height);
    ASSERT_EQ(width, 160) << frame;
    ASSERT_EQ(height, 90) << frame;
    // An empty picture has one colour; sky, ground, wall and shadow span most of the range.
    const auto [darkest, brightest] = std::minmax_element(pixels.begin(), pixels.end());
    EXPECT_GT(*brightest - *darkest, 100) << frame;
  }
}

TEST_F(Pictures, DoNotTouchTheSimulation) {
  const std::string headless = run(false);
  EXPECT_EQ(headless, run(true));
}

TEST_F(Pictures, DustOnGlDoesNotTouchTheElements) {
  const std::string cpu = run(true, {{"dust.backend", "cpu"}});
  EXPECT_EQ(cpu, run(true, {{"dust.backend", "gl"}}));
}

}  // namespace
}  // namespace rubble::tests
