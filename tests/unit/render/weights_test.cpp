#include "render/weights.h"

#include <gtest/gtest.h>

#include "support/grid_asset.h"
#include "unit/render/random.h"
#ifdef RUBBLE_TEST_COOK
#include "rubble/cook.h"
#include "support/strict_cook.h"
#endif

namespace rubble::test {
using namespace render;
namespace {

using test::gridAsset;
using test::Random;

std::vector<std::uint8_t> intact(const Asset& asset) {
  return std::vector<std::uint8_t>(asset.springs.size(), 1);
}

std::uint32_t springBetween(const Asset& asset, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t s = 0; s < asset.springs.size(); ++s) {
    if (asset.springs[s].first == a && asset.springs[s].second == b) return s;
  }
  return kNoElement;
}

// The farthest that two copies of one vertex are apart [m].
float widestCrack(const Asset& asset, const CellWeights& weights, std::span<const ElementPose> poses) {
  float widest = 0;
  for (std::uint32_t v = 0; v < asset.vertices.size(); ++v) {
    const CellMask mask = weights.masks()[v];
    const Eigen::Vector3f first = cellPoint(asset, poses, mask, v, 0);
    for (unsigned owner = 1; owner < 4 && asset.vertices[v].elements[owner] != kNoElement; ++owner) {
      widest = std::max(widest, (cellPoint(asset, poses, mask, v, owner) - first).norm());
    }
  }
  return widest;
}

TEST(Weights, CopiesOfASharedVertexCoincideWhileTheBodyIsIntact) {
  const Asset asset = gridAsset({.cubes = {4, 3, 5}, .edge = 0.1});
  const CellWeights weights(asset, CellJoining::Transitive);
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    // Equal sums in equal order: equal to the last bit.
    EXPECT_EQ(widestCrack(asset, weights, test::shakenPoses(asset, random, 0.01f, 0.05f)), 0);
  }
}

#ifdef RUBBLE_TEST_COOK
TEST(Weights, CopiesOfASharedVertexCoincideInACookedBody) {
  // Cells of all shapes, some neighbours without a spring because their face is a sliver (about one in
  // twelve).
  CookOptions options;
  options.elements = 400;
  const Asset asset = cookStrictly(boxMesh({1, 1, 0.2}), options);
  const CellWeights weights(asset, CellJoining::Transitive);
  Random random(6);
  for (int trial = 0; trial < 5; ++trial) {
    EXPECT_EQ(widestCrack(asset, weights, test::shakenPoses(asset, random, 0.002f, 0.02f)), 0);
  }
}
#endif

TEST(Weights, BodyAtRestIsDrawnAtRest) {
  const Asset asset = gridAsset({.cubes = {3, 3, 3}, .edge = 0.25, .origin = {0.5, 1, -2}});
  for (const CellJoining joining : {CellJoining::Transitive, CellJoining::Direct}) {
    const CellWeights weights(asset, joining);
    for (std::uint32_t v = 0; v < asset.vertices.size(); ++v) {
      const Eigen::Vector3f drawn = cellPoint(asset, test::restPoses(asset), weights.masks()[v], v, 0);
      EXPECT_LT((drawn - asset.vertices[v].position).norm(), 1e-6f);
    }
  }
}

TEST(Weights, VertexOfAFollowedPairIsTheMeanOfBothOffers) {
  // Two cubes; the second moves by 2 cm along y: what they share moves by half of it (eq. 8).
  const Asset asset = gridAsset({.cubes = {2, 1, 1}, .edge = 1});
  auto poses = test::restPoses(asset);
  poses[1].position.y() += 0.02f;
  const CellWeights weights(asset, CellJoining::Direct);
  for (std::uint32_t v = 0; v < asset.vertices.size(); ++v) {
    const CellVertex& vertex = asset.vertices[v];
    const bool isShared = vertex.elements[1] != kNoElement;
    const float moved = isShared ? 0.01f : vertex.elements[0] == 1 ? 0.02f : 0.f;
    EXPECT_NEAR(cellPoint(asset, poses, weights.masks()[v], v, 0).y(), vertex.position.y() + moved, 1e-6f);
  }
}

TEST(Weights, PartedCellsFollowTheirOwnElement) {
  const Asset asset = gridAsset({.cubes = {2, 1, 1}, .edge = 1});
  auto poses = test::restPoses(asset);
  poses[1].position.x() += 0.5f;
  CellWeights weights(asset, CellJoining::Transitive);
  EXPECT_TRUE(weights.update(std::vector<std::uint8_t>{0}, poses));
  EXPECT_EQ(weights.changed().size(), 4u);  // the corners of the one shared face
  EXPECT_NEAR(widestCrack(asset, weights, poses), 0.5f, 1e-6f);
}

TEST(Weights, ChainOfSpringsAroundAnEdgeKeepsCellsJoined) {
  // Four cubes around an edge: with one of four springs broken the chain of the other three still joins all
  // of them by default, while the paper's rule parts the two.
  const Asset asset = gridAsset({.cubes = {2, 2, 1}, .edge = 1});
  auto springs = intact(asset);
  springs[springBetween(asset, 0, 1)] = 0;
  Random random(2);
  const auto poses = test::shakenPoses(asset, random, 0.05f, 0.1f);
  CellWeights transitive(asset, CellJoining::Transitive), direct(asset, CellJoining::Direct);
  transitive.update(springs, poses);
  direct.update(springs, poses);
  for (std::uint32_t v = 0; v < asset.vertices.size(); ++v) {
    if (asset.vertices[v].elements[3] == kNoElement) continue;
    for (unsigned owner = 0; owner < 4; ++owner) EXPECT_EQ(maskOf(transitive.masks()[v], owner), 15u);
    EXPECT_EQ(maskOf(direct.masks()[v], 0), 0b0101u);  // itself and its one remaining neighbour
    EXPECT_EQ(maskOf(direct.masks()[v], 3), 0b1110u);
  }
}

TEST(Weights, PairWithoutSpringStaysClosedWhileAThirdElementHoldsBoth) {
  // A vertex where only the two cubes of a diagonal meet, as a sliver of a face does on the surface.
  Asset asset = gridAsset({.cubes = {2, 2, 1}, .edge = 1});
  asset.vertices.push_back({{1, 1, 0.5f}, {0, 3, kNoElement, kNoElement}});
  const std::size_t sliver = asset.vertices.size() - 1;
  const auto poses = test::restPoses(asset);
  CellWeights weights(asset, CellJoining::Transitive);
  const auto isClosed = [&] {
    return maskOf(weights.masks()[sliver], 0) == 3u && maskOf(weights.masks()[sliver], 1) == 3u;
  };
  auto springs = intact(asset);
  EXPECT_TRUE(isClosed());
  springs[springBetween(asset, 0, 1)] = 0;  // cube 2 still holds 0 and 3
  weights.update(springs, poses);
  EXPECT_TRUE(isClosed());
  springs[springBetween(asset, 2, 3)] = 0;  // now no cube holds both
  weights.update(springs, poses);
  EXPECT_FALSE(isClosed());
}

TEST(Weights, UpdateByBrokenSpringsEqualsARebuild) {
  const Asset asset = gridAsset({.cubes = {5, 4, 3}, .edge = 0.1});
  for (const CellJoining joining : {CellJoining::Transitive, CellJoining::Direct}) {
    Random random(3);
    CellWeights updated(asset, joining);
    auto springs = intact(asset);
    auto poses = test::restPoses(asset);
    for (int step = 0; step < 60; ++step) {
      for (int i = 0; i < 4; ++i) springs[random.below(springs.size())] = random.unit() < 0.8f ? 0 : 1;
      if (step % 10 == 9) poses[random.below(poses.size())].alive = 0;
      const std::vector<CellMask> before(updated.masks().begin(), updated.masks().end());
      updated.update(springs, poses);
      CellWeights rebuilt(asset, joining);
      rebuilt.update(springs, poses);
      std::vector<std::uint32_t> changed;
      for (std::uint32_t v = 0; v < before.size(); ++v) {
        ASSERT_EQ(updated.masks()[v], rebuilt.masks()[v]) << "vertex " << v << ", step " << step;
        if (before[v] != updated.masks()[v]) changed.push_back(v);
      }
      EXPECT_TRUE(
          std::equal(changed.begin(), changed.end(), updated.changed().begin(), updated.changed().end()));
    }
  }
}

TEST(Weights, CrushedElementHoldsNothing) {
  const Asset asset = gridAsset({.cubes = {3, 3, 3}, .edge = 1});
  auto poses = test::restPoses(asset);
  poses[13].alive = 0;  // the middle
  CellWeights weights(asset, CellJoining::Transitive);
  weights.update(intact(asset), poses);  // its springs not yet marked broken
  for (std::uint32_t v = 0; v < asset.vertices.size(); ++v) {
    for (unsigned j = 0; j < 4; ++j) {
      if (asset.vertices[v].elements[j] != 13) continue;
      for (unsigned owner = 0; owner < 4; ++owner) {
        EXPECT_EQ(maskOf(weights.masks()[v], owner) >> j & 1u, owner == j ? 1u : 0u);
      }
    }
  }
}

}  // namespace
}  // namespace rubble::test
