#include "render/cell_mesh.h"

#include <gtest/gtest.h>

#include "support/grid_asset.h"
#include "unit/render/random.h"

namespace rubble::test {
using namespace render;
namespace {

using test::gridAsset;

struct Drawn {
  Asset asset;
  CellMesh mesh{asset};
  CellWeights weights{asset, CellJoining::Transitive};
  std::vector<std::uint8_t> springs = std::vector<std::uint8_t>(asset.springs.size(), 1);
  std::vector<ElementPose> poses = test::restPoses(asset);

  std::size_t triangles() {
    weights.update(springs, poses);
    std::vector<std::array<std::uint32_t, 3>> visible;
    mesh.visible(weights.masks(), poses, visible);
    return visible.size();
  }
};

TEST(GridAsset, IsAValidAssetOfTheBlocksVolume) {
  const Asset asset = gridAsset({.cubes = {4, 3, 2}, .edge = 0.5, .anchored = true});
  EXPECT_NO_THROW(asset.validate());
  EXPECT_DOUBLE_EQ(asset.volume(), 24 * 0.125);
  EXPECT_EQ(asset.springs.size(),
            3u * 3 * 2 + 4u * 2 * 2 + 4u * 3 * 1);  // faces between neighbours along x, y, z
  EXPECT_EQ(asset.anchors.size(), 4u * 2);
  EXPECT_EQ(asset.triangles.size(), 24u * 12);
}

TEST(GridAsset, TrianglesTurnOutwards) {
  const Asset asset = gridAsset({.cubes = {3, 2, 2}, .edge = 0.5, .origin = {-1, 2, 3}});
  for (const auto& triangle : asset.triangles) {
    std::array<Eigen::Vector3f, 3> p;
    for (unsigned c = 0; c < 3; ++c) p[c] = asset.vertices[asset.corners[triangle[c]].vertex].position;
    const Eigen::Vector3f normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    EXPECT_LT((normal - asset.corners[triangle[0]].normal).norm(), 1e-6f);
  }
}

TEST(CellMesh, IntactBodyDrawsItsSurfaceOnly) {
  Drawn body{gridAsset({.cubes = {5, 4, 3}, .edge = 0.1})};
  EXPECT_EQ(body.triangles(), 2u * 2 * (5 * 4 + 4 * 3 + 3 * 5));  // two triangles a square
}

TEST(CellMesh, CutShowsBothItsSides) {
  Drawn body{gridAsset({.cubes = {5, 4, 3}, .edge = 0.1})};
  const std::size_t surface = body.triangles();
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const auto& spring = body.asset.springs[s];
    if (spring.first % 5 == 2 && spring.second % 5 == 3) body.springs[s] = 0;  // between x layers 2 and 3
  }
  EXPECT_EQ(body.triangles(), surface + 2u * 2 * 4 * 3);
}

TEST(CellMesh, CrushedCellLeavesAHoleWithWalls) {
  Drawn body{gridAsset({.cubes = {3, 3, 3}, .edge = 0.1})};
  const std::size_t surface = body.triangles();
  body.poses[13].alive = 0;  // the middle: six neighbours show a face each
  EXPECT_EQ(body.triangles(), surface + 6u * 2);
}

TEST(CellMesh, LoneCellOfAPartedBodyDrawsAllItsFaces) {
  Drawn body{gridAsset({.cubes = {3, 3, 3}, .edge = 0.1})};
  std::fill(body.springs.begin(), body.springs.end(), std::uint8_t{0});
  EXPECT_EQ(body.triangles(), 27u * 12);
}

TEST(CellMesh, CoarseCellHasTheVolumeOfItsCell) {
  const Asset asset = gridAsset({.cubes = {2, 2, 2}, .edge = 0.1, .origin = {1, -2, 3}});
  const CellMesh mesh(asset);
  for (std::size_t e = 0; e < asset.elementCount(); ++e) {
    double volume = 0;
    Eigen::Vector3d areas = Eigen::Vector3d::Zero();  // of a closed surface they cancel
    for (const auto& triangle : mesh.coarseTriangles().subspan(e * kCoarseTriangles, kCoarseTriangles)) {
      std::array<Eigen::Vector3d, 3> p;
      for (unsigned c = 0; c < 3; ++c) {
        const auto vertex = mesh.corners()[triangle[c]].vertexAndOwner / 4;
        p[c] = (asset.vertices[vertex].position.cast<double>() - asset.positions[e]) *
               double(mesh.coarseScale(e));
      }
      volume += p[0].cross(p[1]).dot(p[2]) / 6;
      areas += (p[1] - p[0]).cross(p[2] - p[0]) / 2;
    }
    EXPECT_NEAR(volume, asset.volumes[e], 1e-5 * asset.volumes[e]);
    EXPECT_LT(areas.norm(), 1e-8);
  }
}

}  // namespace
}  // namespace rubble::test
