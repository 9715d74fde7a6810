#include <algorithm>
#include <cmath>

#include "base/asset_check.h"

namespace rubble::base {
namespace {

// Of the bounds [m]. Moments of inertia of such a solid (1e31 kg m^2 at 2 t/m^3) are still floats, in which
// the elements move.
constexpr double kLargestDiagonal = 1e6;
// A solid of 1 mm has this radius with a hundred million elements [m]. Moments of inertia (1e-27 kg m^2 at
// 2 t/m^3) and their inverses are floats down to there.
constexpr double kLeastRadius = 1e-6;
// Of springs and anchors [m^2]: below the rounding of the smallest faces, and far above the least float.
constexpr double kLeastArea = 1e-30;
// A cell holds most of its element; even one pressed into a needle's tip holds more of it than this share.
constexpr double kLeastCellShare = 1e-6;
// Of a quaternion in doubles: far above their rounding, and far below what a force would show.
constexpr double kUnitQuaternion = 1e-9;
constexpr double kSumTolerance = 1e-6;  // for sums of up to ten million doubles

AssetScale measureScale(const Asset& asset) {
  AssetScale scale{asset.bounds(), 0};
  scale.rounding = floatRounding(farthestOf(scale.bounds));
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(scale.rounding);
  scale.bounds = Eigen::AlignedBox3d(scale.bounds.min() - margin, scale.bounds.max() + margin);
  return scale;
}

void checkRadius(const Asset& asset, const AssetScale& scale) {
  const double diagonal = scale.bounds.diagonal().norm();
  if (!(diagonal <= kLargestDiagonal))
    refuseAsset("the bounds of the vertices have a diagonal of ", diagonal, " m; allowed: up to ",
                kLargestDiagonal);
  if (!(asset.radius >= kLeastRadius && 2 * asset.radius <= diagonal))
    refuseAsset("radius is ", asset.radius, " m; allowed: ", kLeastRadius, " to half the bounds' diagonal, ",
                diagonal / 2);
}

void checkElements(const Asset& asset, const AssetScale& scale) {
  const double ball = ballVolume(asset.radius);
  const double most = scale.bounds.volume() * (1 + kSumTolerance);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(asset.radius);
  const Eigen::AlignedBox3d grown(scale.bounds.min() - reach, scale.bounds.max() + reach);
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    checkPlace(asset.positions[i], "positions", i, "");
    if (!grown.contains(asset.positions[i]))
      refuseAsset("positions[", i, "] is (", asset.positions[i].transpose(),
                  "); allowed: within a radius of the "
                  "bounds of the vertices");
    if (!(asset.volumes[i] >= kLeastCellShare * ball && asset.volumes[i] <= most))
      refuseAsset("volumes[", i, "] is ", asset.volumes[i], " m^3; allowed: ", kLeastCellShare * ball, " to ",
                  most, ", a millionth of an element to the whole bounds");
    if (!(asset.gyrations[i] > 0) || !std::isfinite(asset.gyrations[i]))
      refuseAsset("gyrations[", i, "] is ", asset.gyrations[i], " m^2; allowed: above 0");
  }
  const double sum = asset.volume();
  const double least = double(asset.elementCount()) * ball / (1 + kSumTolerance);
  if (!(sum >= least && sum <= most))
    refuseAsset("volumes add up to ", sum, " m^3; allowed: ", least, " to ", most,
                ", the volume of the elements to that of the bounds");
}

void checkSharpness(const Asset& asset, const AssetScale& scale) {
  constexpr double kSlack = 1.5;  // the cook foretells spacing and bounds
  if (!isSharp(scale.bounds, asset.spacing(), kSlack))
    refuseAsset(
        "the vertices lie up to ", farthestOf(scale.bounds),
        " m from the frame's origin, where floats hold them to ", scale.rounding,
        " m; allowed: ", kSlack * kSharpness,
        " of the elements' spacing, or bounds about the origin: cook it again, which moves the frame");
}

void checkRest(const Asset& asset, const AssetScale& scale) {
  if (!asset.rest) return;
  const AssetRest& rest = *asset.rest;
  const double diagonal = scale.bounds.diagonal().norm();
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    const double moved = rest.displacements[i].norm();
    if (!(moved <= diagonal))
      refuseAsset("rest.displacements[", i, "] has length ", moved,
                  " m; allowed: up to the bounds' diagonal, ", diagonal);
    const double norm = rest.rotations[i].norm();
    if (!(std::abs(norm - 1) <= kUnitQuaternion))
      refuseAsset("rest.rotations[", i, "] has length ", norm, "; allowed: 1");
  }
}

}  // namespace

AssetScale checkNumbers(const Asset& asset) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(asset.origin[axis]) <= kLargestCoordinate))
      refuseAsset("origin.", "xyz"[axis], " is ", asset.origin[axis], " m; allowed: -", kLargestCoordinate,
                  " to ", kLargestCoordinate);
  for (std::size_t v = 0; v < asset.vertices.size(); ++v)
    checkPlace(asset.vertices[v].position, "vertices", v, ".position");
  const AssetScale scale = measureScale(asset);
  checkRadius(asset, scale);
  checkElements(asset, scale);
  checkSharpness(asset, scale);
  for (std::size_t s = 0; s < asset.springs.size(); ++s)
    checkArea(asset.springs[s].area, "springs", s, kLeastArea);
  for (std::size_t a = 0; a < asset.anchors.size(); ++a) {
    checkArea(asset.anchors[a].area, "anchors", a, kLeastArea);
    checkPlace(asset.anchors[a].point, "anchors", a, ".point");
  }
  checkRest(asset, scale);
  return scale;
}

}  // namespace rubble::base
