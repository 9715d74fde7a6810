// What the picture tests share: a context and renderer for all of them, a camera, and light read back from a
// picture.
#pragma once

#include <cmath>
#include <memory>

#include "gl/context.h"
#include "rubble/render.h"
#include "support/folders.h"
#include "support/grid_asset.h"
#include "unit/render/random.h"

namespace rubble::test {

class Picture : public GlTest {
 protected:
  static constexpr int kWidth = 240, kHeight = 180;

  void prepare() override {
    m_renderer = std::make_unique<Renderer>(
        RendererDef{.shaderDirectory = test::shaderFolder(), .shadowMapSize = 1024});
    m_framebuffer = std::make_unique<Framebuffer>(kWidth, kHeight);
    m_lighting.toneCurve = false;
    m_lighting.exposure = 0.3f;  // keeps everything below white
    m_camera.eye = {2.5f, 2.2f, 3.5f};
    m_camera.target = {0.5f, 0.5f, 0.5f};
  }
  void TearDown() override {
    m_renderer.reset();
    m_framebuffer.reset();
  }

  Image draw() {
    m_renderer->draw(m_camera, m_lighting, m_framebuffer->target());
    return m_framebuffer->readPixels();
  }

  /// Light of a channel of a pixel before exposure and sRGB (IEC 61966-2-1).
  double light(const Image& image, int x, int y, int channel = 1) const {
    const double v = at(image, x, y, channel) / 255.0;
    const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    return linear / double(m_lighting.exposure);
  }
  static int at(const Image& image, int x, int y, int channel) {
    return image.pixels[std::size_t(4 * (y * image.width + x) + channel)];
  }
  static double meanDifference(const Image& a, const Image& b) {  // of 255
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
    return sum / double(a.pixels.size());
  }
  static std::size_t differentPixels(const Image& a, const Image& b, int tolerance = 2) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.pixels[i + c] - b.pixels[i + c]));
      if (most > tolerance) ++count;
    }
    return count;
  }

  std::unique_ptr<Renderer> m_renderer;
  std::unique_ptr<Framebuffer> m_framebuffer;
  Camera m_camera;
  Lighting m_lighting;
};

}  // namespace rubble::test
