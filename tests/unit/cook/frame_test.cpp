// Solids far from their mesh's origin: cooked as they would be at it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/asset_format.h"
#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

const Eigen::Vector3d kGeo(5e5, 0, 6e6);  // an easting and a northing, as in UTM [m]

SurfaceMesh at(SurfaceMesh mesh, const Eigen::Vector3d& place) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex += place;
  return mesh;
}

CookOptions anchored(std::size_t elements) {
  CookOptions options = optionsFor(elements);
  options.anchorDirection = -Eigen::Vector3d::UnitY();
  return options;
}

// Every number of the asset but its origin.
std::vector<double> numbersOf(const Asset& asset) {
  std::vector<double> numbers = {asset.radius};
  const auto add = [&numbers](const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      numbers.push_back(double(value));
    } else {
      for (const auto number : value) numbers.push_back(double(number));
    }
  };
  const std::string names = base::nameBytesOf(asset);
  base::visitAssetFields(asset, names, add);
  return numbers;
}

// Its corners are sums of few powers of two, so the move loses no bit.
TEST(Frame, OfACubeAtGeoCoordinatesIsTheSameToTheBit) {
  const Asset near = cookStrictly(boxMesh({1, 1, 1}), anchored(200));
  const Asset far = cookStrictly(at(boxMesh({1, 1, 1}), kGeo), anchored(200));
  EXPECT_EQ(near.origin, Eigen::Vector3d::Zero());
  EXPECT_EQ(far.origin, kGeo);
  EXPECT_FALSE(far.anchors.empty());
  EXPECT_TRUE(numbersOf(far) == numbersOf(near));
}

// The corners of a ring are rounded where they are, to 2^-31 m at 6e6 m; what is about a middle is not the
// same to the bit as what is about the origin, and elements find other places. The solid is the same.
TEST(Frame, OfARingAtGeoCoordinatesHoldsTheSameSolid) {
  const SurfaceMesh ring = torus(1, 0.3, 24, 12);
  const Eigen::Vector3d place = kGeo + Eigen::Vector3d(0.1, 0.2, 0.3);
  const Asset near = cookStrictly(ring, anchored(80));
  const Asset far = cookStrictly(at(ring, place), anchored(80));
  EXPECT_NEAR(far.volume() / near.volume(), 1, 1e-9);
  EXPECT_LT((far.origin - place).cwiseAbs().maxCoeff(), 0.5);
  EXPECT_LT((far.bounds().center() + far.origin - place).norm(), 1e-6);
  EXPECT_NEAR(far.diagonal() / near.diagonal(), 1, 1e-6);
}

// 5e-5 of the spacing h of 200 elements in a cubic metre is 8.5e-6 m, floats' rounding of places up to
// x 1.2e-7 x.
TEST(Frame, IsTheMeshsOwnAsLongAsFloatsHoldIt) {
  const double farthest = 5e-5 * std::cbrt(1.0 / 200) / std::ldexp(1, -23);
  const auto originAt = [](double x) {
    return cookStrictly(at(boxMesh({1, 1, 1}), {x, 0, 0}), anchored(200)).origin;
  };
  EXPECT_EQ(originAt(0.99 * farthest - 0.5), Eigen::Vector3d::Zero());
  const Eigen::Vector3d moved = originAt(1.01 * farthest);
  EXPECT_EQ(moved.x(), std::round(4 * 1.01 * farthest) / 4);  // the power of two below a quarter of sqrt(3) m
  EXPECT_EQ(moved.tail<2>(), Eigen::Vector2d::Zero());
}

// No frame is better for a solid that is larger than its distance.
TEST(Frame, IsTheMeshsOwnAboutALargeSolid) {
  EXPECT_EQ(cookStrictly(at(boxMesh({1e5, 1e5, 1e5}), {1e5, 0, 0}), optionsFor(8)).origin,
            Eigen::Vector3d::Zero());
  const Asset plate = cook(at(boxMesh({1000, 1000, 1}), {1000, 0, 0}), optionsFor(1000));
  EXPECT_EQ(plate.origin, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace rubble::test
