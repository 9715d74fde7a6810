// Debris outlive the body that they broke from.
#include "gl/render/picture.h"

namespace rubble::test {
namespace {

class RemovedBody : public Picture {
 protected:
  void prepare() override {
    Picture::prepare();
    m_lighting.shadowBounds = Eigen::AlignedBox3f(Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(2, 2, 2));
  }
  static std::vector<DebrisInstance> pieceOf(BodyId body, float scale = 1) {
    return {{{0.5f, 0.5f, 0.5f}, scale, Eigen::Quaternionf::Identity(), body, 3}};
  }

  Asset m_asset = gridAsset({.cubes = {2, 2, 2}, .edge = 0.5});
};

TEST_F(RemovedBody, LeavesItsDebrisInThePicture) {
  const Image empty = draw();
  const BodyId body = m_renderer->addBody(m_asset);
  std::vector<ElementPose> crushed = restPoses(m_asset);
  for (ElementPose& pose : crushed) pose.alive = 0;
  m_renderer->updateBody(body, crushed, std::vector<std::uint8_t>(m_asset.springs.size(), 0));
  m_renderer->setDebris(pieceOf(body));
  const Image alone = draw();
  EXPECT_GT(differentPixels(alone, empty), 1000u);

  const BodyId whole = m_renderer->addBody(m_asset);
  EXPECT_GT(differentPixels(draw(), alone), 1000u);
  m_renderer->setDebris(pieceOf(whole));
  m_renderer->removeBody(whole);
  EXPECT_EQ(draw().pixels, alone.pixels);
  EXPECT_EQ(m_renderer->counts().cellTriangles, 0u);
  EXPECT_EQ(m_renderer->counts().debrisPieces, 1u);
  for (int frame = 0; frame < 3; ++frame) {
    m_renderer->setDebris(pieceOf(whole));
    EXPECT_EQ(draw().pixels, alone.pixels);
  }
}

// Debris of the tick in which the body was removed come after the removal.
TEST_F(RemovedBody, TakesDebrisUntilItIsDrawnWithoutAny) {
  const Image empty = draw();
  const BodyId body = m_renderer->addBody(m_asset);
  m_renderer->removeBody(body);
  m_renderer->setDebris(pieceOf(body));
  EXPECT_GT(differentPixels(draw(), empty), 1000u);
  m_renderer->setDebris({});
  EXPECT_EQ(draw().pixels, empty.pixels);
  EXPECT_NO_THROW(m_renderer->setDebris(pieceOf(body)));  // its cells are gone: left out
  EXPECT_EQ(draw().pixels, empty.pixels);
  EXPECT_EQ(m_renderer->counts().debrisPieces, 0u);
}

TEST_F(RemovedBody, IsRefusedOtherwise) {
  const BodyId body = m_renderer->addBody(m_asset);
  const PropId prop = m_renderer->addSphere(0.1f);
  m_renderer->setDebris(pieceOf(body));
  m_renderer->removeBody(body);
  const std::vector<std::uint8_t> springs(m_asset.springs.size(), 1);
  EXPECT_THROW(m_renderer->updateBody(body, restPoses(m_asset), springs), Error);
  EXPECT_THROW(m_renderer->removeBody(body), Error);
  EXPECT_THROW(m_renderer->setDebris(pieceOf(body, std::numeric_limits<float>::infinity())), Error);
  EXPECT_THROW(m_renderer->setDebris(pieceOf(BodyId{std::uint32_t(prop)})), Error);
  EXPECT_THROW(m_renderer->setDebris(pieceOf(BodyId{99})), Error);
}

}  // namespace
}  // namespace rubble::test
