// Cells that a gap narrower than an element cuts into pieces: each piece goes to a cell on its own side.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/strict_cook.h"
#include "unit/cook/shapes.h"

namespace rubble::test {
namespace {

constexpr double kGap = 0.01;
constexpr double kDepth = 0.8;  // of the slot in the slab; its middle is x = 0.5

// No corner of a cell may lie on the other side of the slot. Vertices are floats.
TEST(Gaps, CellsBesideASlotKeepToTheirSide) {
  const Asset asset = cookStrictly(slottedSlab(kGap), optionsFor(300));
  ASSERT_GT(asset.spacing(), 4 * kGap);
  int looked = 0;
  for (const CellCorner& corner : asset.corners) {
    const Eigen::Vector3d& element = asset.positions[corner.element];
    if (element.z() > kDepth - 2 * asset.spacing()) continue;  // may reach round the end of the slot
    ++looked;
    const double x = double(asset.vertices[corner.vertex].position.x()) - 0.5;
    EXPECT_GE(element.x() < 0.5 ? -x : x, kGap / 2 - 1e-6) << "element " << corner.element;
  }
  EXPECT_GT(looked, 1000);
}

TEST(Gaps, SpringsDoNotCrossThem) {
  const Asset asset = cookStrictly(slottedSlab(kGap), optionsFor(300));
  for (const AssetSpring& spring : asset.springs) {
    const Eigen::Vector3d& a = asset.positions[spring.first];
    const Eigen::Vector3d& b = asset.positions[spring.second];
    if (std::max(a.z(), b.z()) > kDepth - asset.spacing()) continue;
    EXPECT_EQ(a.x() < 0.5, b.x() < 0.5) << "from " << a.transpose() << " to " << b.transpose();
  }
}

}  // namespace
}  // namespace rubble::test
