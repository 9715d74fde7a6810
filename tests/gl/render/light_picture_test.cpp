#include "gl/render/picture.h"

namespace rubble::test {
namespace {

using LightPicture = Picture;

TEST_F(LightPicture, ShadowLeavesTheAmbientLight) {
  m_lighting.sunDirection = {0, 1, 0};
  m_lighting.shadowBounds = Eigen::AlignedBox3f(Eigen::Vector3f(-2, 0, -2), Eigen::Vector3f(2, 2, 2));
  m_camera.eye = {0, 0.4f, 2};  // looks under the box
  m_camera.target = {0, 0, 0};
  m_renderer->addGroundPlane(0, {0.4f, 0.4f, 0.4f});
  const Image sunny = draw();
  const PropId box = m_renderer->addBox({0.8f, 0.1f, 0.8f});
  m_renderer->setPropPose(box, {0, 1.5f, 0}, Eigen::Quaternionf::Identity());
  const Image shaded = draw();
  // Light on the ground: ambient from above, and the sun at right angles.
  for (int channel = 0; channel < 3; ++channel) {
    const double ambient = double(m_lighting.skyAmbient[channel]);
    const double expected = ambient / (ambient + double(m_lighting.sunColour[channel]));
    const double ratio =
        light(shaded, kWidth / 2, kHeight / 2, channel) / light(sunny, kWidth / 2, kHeight / 2, channel);
    EXPECT_NEAR(ratio, expected, 0.04 * expected);  // the 8-bit picture's steps at the dark end
  }
}

TEST_F(LightPicture, SurfaceFacingTheSunIsNotInItsOwnShadow) {
  m_renderer->addBox({0.5f, 0.5f, 0.5f}, {.colour = {0.3f, 0.3f, 0.3f}, .gloss = 0.99f});
  m_lighting.sunDirection = {0.3f, 0.8f, 0.5f};
  const Image with = draw();
  m_lighting.shadowBounds = Eigen::AlignedBox3f(Eigen::Vector3f(10, 10, 10), Eigen::Vector3f(11, 11, 11));
  const Image without = draw();  // nothing casts shadows now; a lone convex body had none on its sunny sides
  EXPECT_LT(differentPixels(with, without), 40u);
}

TEST_F(LightPicture, BackgroundIsTheSkyGradient) {
  m_lighting.skyZenith = {0.1f, 0.2f, 0.4f};
  m_lighting.skyHorizon = {0.7f, 0.8f, 0.9f};
  m_camera.eye = {0, 1, 0};
  m_camera.target = {0, 9, -0.01f};
  const Image up = draw();
  m_camera.target = {0, 1, -9};
  const Image ahead = draw();
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(light(up, kWidth / 2, kHeight / 2, channel), m_lighting.skyZenith[channel], 0.02);
    EXPECT_NEAR(light(ahead, kWidth / 2, kHeight / 2 + 2, channel), m_lighting.skyHorizon[channel], 0.02);
  }
}

}  // namespace
}  // namespace rubble::test
