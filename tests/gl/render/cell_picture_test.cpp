#include "gl/render/picture.h"

namespace rubble::test {
namespace {

const CellColours kGreyAndRed{.outer = {0.5f, 0.5f, 0.5f}, .inner = {0.8f, 0, 0}};

class CellPicture : public Picture {
 protected:
  Asset m_asset = gridAsset({.cubes = {4, 4, 4}, .edge = 0.25});
  std::vector<ElementPose> m_poses = restPoses(m_asset);
  std::vector<std::uint8_t> m_springs = std::vector<std::uint8_t>(m_asset.springs.size(), 1);

  static std::size_t redPixels(const Image& image) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
      if (image.pixels[i] > 40 && image.pixels[i + 1] < image.pixels[i] / 3) ++count;
    }
    return count;
  }
  void part(std::uint32_t element) {
    for (std::size_t s = 0; s < m_springs.size(); ++s) {
      if (m_asset.springs[s].first == element || m_asset.springs[s].second == element) m_springs[s] = 0;
    }
  }
};

TEST_F(CellPicture, IntactCellsLookLikeTheBodysOwnMesh) {
  std::vector<Eigen::Vector3f> vertices;
  for (const CellVertex& vertex : m_asset.vertices) vertices.push_back(vertex.position);
  std::vector<std::array<std::uint32_t, 3>> surface;
  for (const Cell& cell : m_asset.cells) {
    for (std::uint32_t t = cell.firstTriangle; t < cell.firstTriangle + cell.outerTriangles; ++t) {
      const auto& corners = m_asset.triangles[t];
      surface.push_back({m_asset.corners[corners[0]].vertex, m_asset.corners[corners[1]].vertex,
                         m_asset.corners[corners[2]].vertex});
    }
  }
  const Eigen::Quaternionf turn(Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1, 2, 3).normalized()));
  const Eigen::Vector3f shift(0.2f, 0.1f, -0.1f);
  for (ElementPose& pose : m_poses) {
    pose.position = turn * pose.position + shift;
    pose.rotation = turn.coeffs();
  }
  m_lighting.shadowBounds = Eigen::AlignedBox3f(Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(2, 2, 2));
  const BodyId body = m_renderer->addBody(m_asset, CellJoining::Transitive, kGreyAndRed);
  m_renderer->updateBody(body, m_poses, m_springs);
  const Image cells = draw();
  m_renderer->removeBody(body);
  const Image nothing = draw();
  const PropId prop = m_renderer->addHull(vertices, surface, {.colour = kGreyAndRed.outer, .gloss = 0});
  m_renderer->setPropPose(prop, shift, turn);
  const Image mesh = draw();
  EXPECT_GT(differentPixels(cells, nothing), 3000u);  // there is something to see
  EXPECT_LT(meanDifference(cells, mesh), 1);
  EXPECT_LT(differentPixels(cells, mesh), 30u);  // normals are packed in ten bits
}

TEST_F(CellPicture, IntactBodyShowsNoFractureFaceWhenItBends) {
  Random random(4);
  const BodyId body = m_renderer->addBody(m_asset, CellJoining::Transitive, kGreyAndRed);
  for (int trial = 0; trial < 3; ++trial) {
    m_renderer->updateBody(body, shakenPoses(m_asset, random, 0.02f, 0.1f), m_springs);
    EXPECT_EQ(redPixels(draw()), 0u);
  }
}

TEST_F(CellPicture, PartedElementThatMovesOpensAGap) {
  const std::uint32_t corner = 63;  // at the block's upper corner nearest to the camera
  const BodyId body = m_renderer->addBody(m_asset, CellJoining::Transitive, kGreyAndRed);
  part(corner);
  m_renderer->updateBody(body, m_poses, m_springs);
  EXPECT_LT(redPixels(draw()), 10u);  // closed still; seams may show single samples
  m_poses[corner].position += Eigen::Vector3f(0.1f, 0.25f, 0.1f);
  m_renderer->updateBody(body, m_poses, m_springs);
  EXPECT_GT(redPixels(draw()), 100u);
}

TEST_F(CellPicture, CrushedElementVanishes) {
  m_asset = gridAsset({.cubes = {1, 1, 1}, .edge = 1});
  m_poses = restPoses(m_asset);
  m_lighting.shadowBounds = Eigen::AlignedBox3f(Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(2, 2, 2));
  const Image nothing = draw();
  const BodyId body = m_renderer->addBody(m_asset);
  EXPECT_GT(differentPixels(draw(), nothing), 1000u);
  m_poses[0].alive = 0;
  m_poses[0].position.setConstant(std::numeric_limits<float>::quiet_NaN());  // nobody reads it any more
  m_renderer->updateBody(body, m_poses, {});
  EXPECT_EQ(draw().pixels, nothing.pixels);
}

TEST_F(CellPicture, DebrisCoversTheAreaOfItsScale) {
  m_asset = gridAsset({.cubes = {2, 2, 2}, .edge = 0.5});
  m_poses = restPoses(m_asset);
  for (ElementPose& pose : m_poses) pose.alive = 0;
  m_camera.eye = {0.5f, 0.5f, 60};  // from afar: hardly any perspective
  m_camera.verticalFov = 0.02f;
  const BodyId body = m_renderer->addBody(m_asset);
  m_renderer->updateBody(body, m_poses, std::vector<std::uint8_t>(m_asset.springs.size(), 0));
  const Image nothing = draw();
  const double pixel = 2 * 60 * std::tan(0.01) / kHeight;  // [m]
  for (const float scale : {1.f, 0.5f, 0.25f}) {
    m_renderer->setDebris(
        std::vector<DebrisInstance>{{{0.5f, 0.5f, 0}, scale, Eigen::Quaternionf::Identity(), body, 3}});
    const double side = 0.5 * double(scale) / pixel;  // of the square on screen, pixels
    const auto covered = double(differentPixels(draw(), nothing));
    EXPECT_NEAR(covered, side * side, 4 * side + 4);  // one pixel along the rim
  }
  EXPECT_EQ(m_renderer->counts().debrisTriangles, 12u);
}

TEST_F(CellPicture, DebrisOfManyCellsKeepsEveryPieceInItsPlace) {
  // Pieces at scale 1 in the cells' own places, handed over in a mixed order, look like the parted body
  // itself.
  const CellColours red{.outer = {0.8f, 0, 0}, .inner = {0.8f, 0, 0}};
  const BodyId body = m_renderer->addBody(m_asset, CellJoining::Transitive, red);
  std::fill(m_springs.begin(), m_springs.end(), std::uint8_t{0});
  m_renderer->updateBody(body, m_poses, m_springs);
  const std::size_t cells = redPixels(draw());
  std::vector<DebrisInstance> debris;
  for (std::uint32_t i = 0; i < m_poses.size(); ++i) {
    const std::uint32_t e = i * 37 % 64;
    debris.push_back({m_poses[e].position, 1, Eigen::Quaternionf::Identity(), body, e});
    m_poses[e].alive = 0;
  }
  m_renderer->updateBody(body, m_poses, m_springs);
  m_renderer->setDebris(debris);
  EXPECT_EQ(redPixels(draw()), cells);
  EXPECT_EQ(m_renderer->counts().debrisPieces, 64u);
}

TEST_F(CellPicture, SameInputGivesTheSameBytes) {
  m_renderer->addBody(m_asset);
  m_renderer->addGroundPlane(0);
  const Image first = draw();
  EXPECT_EQ(first.pixels, draw().pixels);
}

}  // namespace
}  // namespace rubble::test
