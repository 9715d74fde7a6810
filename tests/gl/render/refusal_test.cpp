#include "gl/render/picture.h"
#include "support/folders.h"

namespace rubble::test {
namespace {

using Refusal = Picture;

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Refusal, NamesTheMissingShader) {
  const std::string text = refusal([] { Renderer renderer({.shaderDirectory = "/nowhere"}); });
  EXPECT_NE(text.find("draw/cells.vert"), std::string::npos) << text;
  EXPECT_NE(text.find("/nowhere"), std::string::npos) << text;
}

TEST_F(Refusal, NamesTheBadSetting) {
  const auto make = [](const RendererDef& def) { return refusal([&] { Renderer renderer(def); }); };
  EXPECT_NE(make({.shaderDirectory = test::shaderFolder(), .samples = 3}).find("samples"), std::string::npos);
  EXPECT_NE(make({.shaderDirectory = test::shaderFolder(), .shadowMapSize = 1}).find("shadowMapSize"),
            std::string::npos);
  EXPECT_NE(make({.shaderDirectory = test::shaderFolder(), .dustSteps = 0}).find("dustSteps"),
            std::string::npos);
  EXPECT_THROW(Framebuffer(0, 10), Error);
}

TEST_F(Refusal, BadBodiesAndPiecesLeaveThePictureAsItWas) {
  const Asset asset = gridAsset({.cubes = {2, 2, 2}, .edge = 0.5});
  const BodyId body = m_renderer->addBody(asset);
  const Image before = draw();
  auto poses = restPoses(asset);
  const std::vector<std::uint8_t> springs(asset.springs.size(), 1);
  EXPECT_THROW(m_renderer->updateBody(BodyId{99}, poses, springs), Error);
  EXPECT_THROW(m_renderer->updateBody(body, std::span(poses).first(3), springs), Error);
  EXPECT_THROW(m_renderer->updateBody(body, poses, std::span(springs).first(2)), Error);
  poses[2].position.x() = std::numeric_limits<float>::infinity();
  EXPECT_THROW(m_renderer->updateBody(body, poses, springs), Error);
  const Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
  const auto piece = [&](BodyId of, std::uint32_t element, float scale) {
    return std::vector<DebrisInstance>{{{0, 0, 0}, scale, turn, of, element}};
  };
  EXPECT_THROW(m_renderer->setDebris(piece(body, 8, 1)), Error);
  EXPECT_THROW(m_renderer->setDebris(piece(BodyId{99}, 0, 1)), Error);
  EXPECT_THROW(m_renderer->setDebris(piece(body, 0, std::numeric_limits<float>::quiet_NaN())), Error);
  EXPECT_EQ(draw().pixels, before.pixels);
}

TEST_F(Refusal, BadPropsAndViews) {
  EXPECT_THROW(m_renderer->addSphere(-1), Error);
  EXPECT_THROW(m_renderer->addBox({1, 0, 1}), Error);
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(m_renderer->addHull(points, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}}), Error);
  EXPECT_THROW(m_renderer->setPropPose(PropId{5}, {0, 0, 0}, Eigen::Quaternionf::Identity()), Error);
  EXPECT_THROW(m_renderer->removeProp(PropId{5}), Error);
  EXPECT_THROW(m_renderer->setDust(nullptr, {.opacity = -1}), Error);
  Camera camera = m_camera;
  camera.target = camera.eye;
  EXPECT_THROW(m_renderer->draw(camera, m_lighting, m_framebuffer->target()), Error);
  m_lighting.sunDirection = {1, -1, 0};
  EXPECT_THROW(m_renderer->draw(m_camera, m_lighting, m_framebuffer->target()), Error);
}

}  // namespace
}  // namespace rubble::test
