// Signed distances of solids of revolution against sampled surfaces.
#include <algorithm>
#include <limits>
#include <numbers>

#include "physics/bodies.h"

namespace rubble::test {
namespace {

using edem::Collider;

constexpr double kRadius = 0.3, kHalf = 0.5;
constexpr int kSteps = 4000;  // samples of a half profile; neighbours are within 1 mm

Collider solid(Collider::Kind kind, double rounding = 0) {
  Collider part;
  part.kind = kind;
  part.size = {kRadius, kHalf, 0};
  part.rounding = rounding;
  return part;
}

// Half profile in (distance from the axis, y), densely.
std::vector<Eigen::Vector2d> profile(Collider::Kind kind) {
  std::vector<Eigen::Vector2d> points;
  const auto line = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    for (int i = 0; i <= kSteps; ++i) points.push_back(a + double(i) / kSteps * (b - a));
  };
  switch (kind) {
    case Collider::Kind::Capsule:
      line({kRadius, -kHalf}, {kRadius, kHalf});
      for (int i = 0; i <= kSteps; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / kSteps;
        for (const double up : {-1.0, 1.0})
          points.push_back({kRadius * std::cos(angle), up * (kHalf + kRadius * std::sin(angle))});
      }
      break;
    case Collider::Kind::Cylinder:
      line({0, -kHalf}, {kRadius, -kHalf});
      line({kRadius, -kHalf}, {kRadius, kHalf});
      line({kRadius, kHalf}, {0, kHalf});
      break;
    default:
      line({0, -kHalf}, {kRadius, -kHalf});
      line({kRadius, -kHalf}, {0, kHalf});
  }
  return points;
}

bool inside(Collider::Kind kind, const Eigen::Vector2d& p) {
  if (kind == Collider::Kind::Capsule)
    return (p - Eigen::Vector2d(0, std::clamp(p.y(), -kHalf, kHalf))).norm() < kRadius;
  if (std::abs(p.y()) >= kHalf) return false;
  return p.x() < (kind == Collider::Kind::Cone ? kRadius * (0.5 - 0.5 * p.y() / kHalf) : kRadius);
}

TEST(RoundSurface, DistanceIsThatOfTheSampledSurface) {
  Numbers numbers;
  for (const auto kind : {Collider::Kind::Capsule, Collider::Kind::Cylinder, Collider::Kind::Cone}) {
    const std::vector<Eigen::Vector2d> surface = profile(kind);
    for (int n = 0; n < 300; ++n) {
      const Eigen::Vector3d p = numbers.vector(1);
      const Eigen::Vector2d at(std::hypot(p.x(), p.z()), p.y());
      double least = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& q : surface) least = std::min(least, (q - at).norm());
      const double expected = inside(kind, at) ? -least : least;
      // Samples are 0.25 mm apart: off the nearest point by half of that at most.
      EXPECT_NEAR(edem::nearest(solid(kind), p).distance, expected, 1.3e-4)
          << int(kind) << ": " << p.transpose();
      EXPECT_NEAR(edem::nearest(solid(kind, 0.1), p).distance, expected - 0.1, 1.3e-4);
    }
  }
}

TEST(RoundSurface, NormalIsTheGradientOfTheDistance) {
  Numbers numbers;
  for (const auto kind : {Collider::Kind::Capsule, Collider::Kind::Cylinder, Collider::Kind::Cone}) {
    Collider part = solid(kind);
    part.place = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized());
    part.place.translation() = Eigen::Vector3d(0.1, -0.2, 0.3);
    for (int n = 0; n < 300; ++n) {
      const Eigen::Vector3d p = part.place.translation() + numbers.vector(1);
      const edem::SurfacePoint s = edem::nearest(part, p);
      EXPECT_NEAR(s.normal.norm(), 1, 1e-12);
      // The next point along the normal is as much further out; a kink on the way inside may make it less.
      const double step = s.distance > 0 ? 0.1 : 1e-6;
      EXPECT_NEAR(edem::nearest(part, p + step * s.normal).distance, s.distance + step, 1e-9) << int(kind);
    }
  }
}

TEST(RoundSurface, AxisAndSurfaceHaveNormals) {
  for (const auto kind : {Collider::Kind::Capsule, Collider::Kind::Cylinder, Collider::Kind::Cone}) {
    const double top = kHalf + (kind == Collider::Kind::Capsule ? kRadius : 0);
    for (const double y : {-2.0, -top, -0.1, 0.0, 0.2, top, 2.0}) {
      const edem::SurfacePoint s = edem::nearest(solid(kind), {0, y, 0});
      EXPECT_NEAR(s.normal.norm(), 1, 1e-12) << int(kind) << " at " << y;
      if (std::abs(y) >= top) {
        EXPECT_NEAR(s.distance, std::abs(y) - top, 1e-12);
      }
    }
  }
}

TEST(RoundSurface, BoundsHoldTheSolid) {
  Numbers numbers;
  for (const auto kind : {Collider::Kind::Capsule, Collider::Kind::Cylinder, Collider::Kind::Cone}) {
    Collider part = solid(kind, 0.05);
    part.place = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 0.3, 0.5).normalized());
    const Eigen::AlignedBox3d box = part.bounds();
    for (int n = 0; n < 2000; ++n) {
      const Eigen::Vector3d p = numbers.vector(1.2);
      if (edem::nearest(part, p).distance <= 0) {
        EXPECT_TRUE(box.contains(p)) << int(kind);
      }
    }
  }
}

// Of a cone: the shorter height of a triangle with a base of 2 and a height of 2, 4 / sqrt(5).
TEST(Thickness, IsTheLeastWidth) {
  using Kind = edem::Collider::Kind;
  edem::Collider part;
  part.size = {1, 2, 0.5};
  const auto thicknessAs = [&](Kind kind) {
    part.kind = kind;
    return part.thickness();
  };
  EXPECT_EQ(thicknessAs(Kind::Box), 1);
  EXPECT_EQ(thicknessAs(Kind::Sphere), 2);
  EXPECT_EQ(thicknessAs(Kind::Capsule), 2);
  EXPECT_EQ(thicknessAs(Kind::Cylinder), 2);
  EXPECT_EQ(thicknessAs(Kind::Plane), std::numeric_limits<double>::infinity());
  part.size = {1, 1, 0};
  EXPECT_NEAR(thicknessAs(Kind::Cone), 4 / std::sqrt(5.0), 1e-12);
  part.rounding = 0.25;
  EXPECT_EQ(thicknessAs(Kind::Cylinder), 2.5);
}

}  // namespace
}  // namespace rubble::test
