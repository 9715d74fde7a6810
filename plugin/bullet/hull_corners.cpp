#include "bullet/hull_corners.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// The hull begins with the furthest points in so many directions.
constexpr int kFirst = 24;
// What stands out of the hull by less than this share of its size is in it.
constexpr double kStandsOut = 1e-5;
// Points that are added before the faces are made anew, as a share of the corners: each of them takes up the
// place of some others.
constexpr double kGrowth = 0.4;

struct Outer {
  std::size_t point;
  double gain;  // of the hull's volume, about [m^3]
};

std::vector<std::size_t> furthestOf(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d size = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  // In a cube: a thin piece has as many along it as around.
  const Eigen::Vector3d into = size.cwiseMax(1e-9 * size.maxCoeff()).cwiseInverse();
  const Eigen::Matrix3Xd directions = directionsAround(kFirst);
  std::vector<std::size_t> found;
  for (Eigen::Index d = 0; d < directions.cols(); ++d) {
    Eigen::Index furthest = 0;
    (into.cwiseProduct(directions.col(d)).transpose() * points).maxCoeff(&furthest);
    found.push_back(std::size_t(furthest));
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

// Of each face the point that is furthest beyond it.
std::vector<Outer> outersOf(const ConvexHull& hull, const Eigen::Matrix3Xd& points, double least) {
  std::vector<Outer> outers;
  Eigen::RowVectorXd over;
  for (const HullFace& face : hull.faces) {
    over.noalias() = face.normal.transpose() * points;
    Eigen::Index furthest = 0;
    const double depth = over.maxCoeff(&furthest) - face.offset;
    if (depth > least) outers.push_back({std::size_t(furthest), face.area * depth / 3});
  }
  std::ranges::sort(outers, [](const Outer& a, const Outer& b) {
    return a.point != b.point ? a.point < b.point : a.gain > b.gain;
  });
  outers.erase(std::ranges::unique(outers, {}, &Outer::point).begin(), outers.end());
  std::ranges::stable_sort(outers, std::ranges::greater{}, &Outer::gain);
  return outers;
}

}  // namespace

// A spiral [SaffKuijlaars97].
Eigen::Matrix3Xd directionsAround(int count) {
  Eigen::Matrix3Xd all(3, count);
  for (int d = 0; d < count; ++d) {
    const double z = 1 - (2 * d + 1) / double(count), angle = d * std::numbers::pi * (3 - std::sqrt(5));
    const double r = std::sqrt(1 - z * z);
    all.col(d) = Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z);
  }
  return all;
}

ConvexHull hullOfFew(std::span<const Eigen::Vector3d> points, std::size_t most) {
  if (points.size() < 4) return convexHullOf(points);
  const Eigen::Matrix3Xd all =
      Eigen::Map<const Eigen::Matrix3Xd>(points[0].data(), 3, Eigen::Index(points.size()));
  const double least = kStandsOut * (all.rowwise().maxCoeff() - all.rowwise().minCoeff()).norm();
  std::vector<Eigen::Vector3d> taken;
  for (const std::size_t i : furthestOf(all)) taken.push_back(points[i]);
  ConvexHull hull = convexHullOf(taken);
  while (hull.points.size() < most) {
    const std::vector<Outer> outers = outersOf(hull, all, least);
    if (outers.empty()) break;
    const auto step = std::max<std::size_t>(4, std::size_t(kGrowth * double(hull.points.size())));
    taken = hull.points;
    for (const Outer& outer : outers)
      if (taken.size() < std::min(most, hull.points.size() + step)) taken.push_back(points[outer.point]);
    ConvexHull larger = convexHullOf(taken);
    if (!(larger.volume > hull.volume)) break;  // Bullet rounds what is so near away
    hull = std::move(larger);
  }
  return hull;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
