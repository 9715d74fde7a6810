#include <gtest/gtest.h>

#include "render/dust_volume.h"
#include "render/frame.h"
#include "unit/render/random.h"

namespace rubble::test {
using namespace render;
namespace {

const Eigen::AlignedBox3f kGrid(Eigen::Vector3f(-2, 0, -1), Eigen::Vector3f(2, 3, 2));

std::vector<Eigen::Vector3f> suns() {
  return {{0, 1, 0}, {-0.55f, 0.72f, 0.42f}, {0.9f, 0.3f, 0.1f}, {-0.9f, 0.2f, 0.3f}, {0.1f, 0.3f, -0.95f}};
}

Eigen::Vector3f apply(const Eigen::Matrix4f& m, const Eigen::Vector3f& p) {
  return (m * p.homogeneous()).head<3>();
}

TEST(DustLight, PointsOnOneSunRayLieInOneColumn) {
  test::Random random(1);
  for (Eigen::Vector3f sun : suns()) {
    sun.normalize();
    const DustLightBox box = dustLightBox(kGrid, sun, 64);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3f p = random.vector();
      const Eigen::Vector3f a = apply(box.worldToLight, p), b = apply(box.worldToLight, p - 0.5f * sun);
      EXPECT_NEAR(a.x(), b.x(), 1e-5f);
      EXPECT_NEAR(a.y(), b.y(), 1e-5f);
      EXPECT_GT(b.z(), a.z());  // away from the sun
      EXPECT_LT((apply(box.lightToWorld, a) - p).norm(), 1e-5f);
    }
  }
}

TEST(DustLight, HoldsTheWholeGridAndNoMoreThanItMust) {
  for (Eigen::Vector3f sun : suns()) {
    sun.normalize();
    const DustLightBox box = dustLightBox(kGrid, sun, 64);
    Eigen::AlignedBox3f image;
    for (int c = 0; c < 8; ++c) {
      image.extend(apply(box.worldToLight, kGrid.corner(static_cast<Eigen::AlignedBox3f::CornerType>(c))));
    }
    EXPECT_LT(image.min().norm(), 1e-5f);
    EXPECT_LT((image.max() - Eigen::Vector3f::Ones()).norm(), 1e-5f);
  }
}

TEST(DustLight, StrideIsTheWayOfTheLightThroughOneSlice) {
  for (Eigen::Vector3f sun : suns()) {
    sun.normalize();
    const DustLightBox box = dustLightBox(kGrid, sun, 64);
    const Eigen::Vector3f next =
        apply(box.worldToLight, -box.stride * sun) - apply(box.worldToLight, Eigen::Vector3f::Zero());
    EXPECT_NEAR(next.z(), 1.f / 64, 1e-6f);
  }
}

TEST(ShadowMap, HoldsItsBoxAndLooksAlongTheLight) {
  for (Eigen::Vector3f sun : suns()) {
    sun.normalize();
    const Eigen::Matrix4f m = shadowMatrix(kGrid, sun);
    for (int c = 0; c < 8; ++c) {
      const Eigen::Vector3f q = apply(m, kGrid.corner(static_cast<Eigen::AlignedBox3f::CornerType>(c)));
      EXPECT_GT(q.minCoeff(), -1e-5f);
      EXPECT_LT(q.maxCoeff(), 1 + 1e-5f);
    }
    const Eigen::Vector3f along = apply(m, -sun) - apply(m, Eigen::Vector3f::Zero());
    EXPECT_NEAR(along.head<2>().norm(), 0, 1e-6f);
    EXPECT_GT(along.z(), 0);
  }
}

}  // namespace
}  // namespace rubble::test
