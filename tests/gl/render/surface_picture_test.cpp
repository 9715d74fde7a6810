// An intact object looks as the mesh it was cooked from, with the mesh's own normals.
#include "gl/render/picture.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

const CellColours kGrey{.outer = {0.5f, 0.5f, 0.5f}, .inner = {0.8f, 0, 0}};

// A ball of radius 0.5 m in ten rings of eight: edges of up to 45 degrees, and the sphere's own normals.
SurfaceMesh smoothBall() {
  std::vector<Eigen::Vector2d> profile;
  constexpr int kRings = 10;
  for (int i = 0; i <= kRings; ++i) {
    const double angle = std::numbers::pi * i / kRings;
    profile.emplace_back(i % kRings == 0 ? 0 : 0.5 * std::sin(angle), -0.5 * std::cos(angle));
  }
  SurfaceMesh mesh = turned(profile, 8);
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3f, 3> normals;
    for (std::size_t k = 0; k < 3; ++k) normals[k] = mesh.vertices[triangle[k]].normalized().cast<float>();
    mesh.normals.push_back(normals);
  }
  return mesh;
}

// The mesh itself, uncut, as one cell.
Asset wholeMesh(const SurfaceMesh& mesh) {
  Asset asset;
  asset.radius = 0.1;
  asset.positions.emplace_back(0, 0, 0);
  asset.volumes.push_back(volumeOf(mesh));
  asset.gyrations.push_back(0.1);  // of a ball of radius 0.5, 2/5 r^2; not drawn
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    asset.vertices.push_back({vertex.cast<float>(), {0, kNoElement, kNoElement, kNoElement}});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = std::uint32_t(asset.corners.size());
    for (std::size_t k = 0; k < 3; ++k)
      asset.corners.push_back({mesh.triangles[t][k], 0, mesh.normals[t][k]});
    asset.triangles.push_back({first, first + 1, first + 2});
  }
  asset.faces.push_back({kNoElement, 0, Eigen::Vector3f::UnitX(), Eigen::Vector3f::Zero()});
  asset.cells.push_back({0, std::uint32_t(asset.triangles.size()), 0, 0, 1});
  return asset;
}

class SurfacePicture : public Picture {
 protected:
  void prepare() override {
    Picture::prepare();
    m_camera.eye = {0.9f, 0.8f, 1.2f};
    m_camera.target = {0, 0, 0};
    m_lighting.shadowBounds = Eigen::AlignedBox3f(Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(1, 1, 1));
  }
  Image drawn(const Asset& asset) {
    const BodyId body = m_renderer->addBody(asset, CellJoining::Transitive, kGrey);
    Image image = draw();
    m_renderer->removeBody(body);
    return image;
  }
};

// Both blend the same normals linearly, but the cells from unit normals at their own corners: half-way along
// a chord of 45 degrees the mesh's blend has length cos 22.5, so a cell that ends there is off by 22.5
// degrees / 2 x (1 - cos 22.5) / 2 = 7.5e-3 rad at most, and the rounding to 10 bits adds 1.7e-3 on both
// sides. Light of 0.5 x 2.75 x 0.3 (albedo, sun, exposure) then changes by 4.5e-3 at most, which is 2 of 255
// where sRGB has a slope below 2 (light above 0.08): less than the 4 that tell pixels apart here. On the mean
// over the ball, of which few places are so far from all corners, it must be below half a step of the
// picture's own numbers.
TEST_F(SurfacePicture, CellsAreLitAsTheMeshIs) {
  const SurfaceMesh mesh = smoothBall();
  const Image nothing = draw();
  const Image own = drawn(wholeMesh(mesh));
  const Image cells = drawn(cookStrictly(mesh, optionsFor(100)));
  const std::size_t seen = differentPixels(own, nothing);
  EXPECT_GT(seen, 5000u);
  const double overBall = double(own.pixels.size() / 4) / double(seen);
  EXPECT_LT(meanDifference(own, cells) * overBall, 0.5);
  EXPECT_LT(differentPixels(own, cells, 4), seen / 100);  // single samples along seams

  SurfaceMesh bare = mesh;
  bare.normals.clear();
  // The light does tell: without its normals the ball has facets.
  EXPECT_GT(meanDifference(own, drawn(cookStrictly(bare, optionsFor(100)))) * overBall, 2);
}

// Two joined cells, one of them turned: the border between them is no edge in the light, for the normals
// there are the mean of both (eq. 8).
TEST_F(SurfacePicture, BentCellsMeetInOneShade) {
  const Asset asset = gridAsset({.cubes = {2, 1, 1}, .edge = 0.5, .origin = {-0.5, -0.25, -0.25}});
  m_camera.eye = {0, 0, 1.5f};
  m_lighting.grainScale = 1e3f;  // none to speak of within the object
  const BodyId body = m_renderer->addBody(asset, CellJoining::Transitive, kGrey);
  std::vector<ElementPose> poses = restPoses(asset);
  constexpr float kTurn = 0.4f;  // about the vertical [rad]
  poses[1].rotation = Eigen::Quaternionf(Eigen::AngleAxisf(kTurn, Eigen::Vector3f::UnitY())).coeffs();
  const std::vector<std::uint8_t> intact(asset.springs.size(), 1);
  const auto steepest = [&] {
    const Image image = draw();
    double most = 0;
    constexpr int kReach = 12;  // pixels on either side of the border
    for (int x = kWidth / 2 - kReach; x < kWidth / 2 + kReach; ++x)
      most = std::max(most, std::abs(light(image, x + 1, kHeight / 2) - light(image, x, kHeight / 2)));
    return most;
  };
  const auto shadeOf = [&](float turn) {  // of a face turned so, as the shader computes it without a shadow
    const Eigen::Vector3f normal(std::sin(turn), 0, std::cos(turn));
    const float facing = normal.dot(m_lighting.sunDirection.normalized());
    return 0.5 * double(m_lighting.sunColour.y()) * double(std::max(facing, 0.0f));
  };
  const double whole = std::abs(shadeOf(kTurn) - shadeOf(0));
  m_renderer->updateBody(body, poses, intact);
  // The change is spread over both cells, some 100 pixels: a tenth of it in one step is an edge.
  EXPECT_LT(steepest(), 0.1 * whole);
  // Broken apart, each is lit for itself, and the border shows.
  const std::vector<std::uint8_t> broken(asset.springs.size(), 0);
  m_renderer->updateBody(body, poses, broken);
  EXPECT_GT(steepest(), 0.3 * whole);
}

}  // namespace
}  // namespace rubble::test
