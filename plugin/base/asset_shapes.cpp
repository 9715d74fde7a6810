#include <algorithm>
#include <cmath>

#include "base/asset_cell_walk.h"

namespace rubble::base {
namespace {

// Of volumes, gyrations and areas, beside the rounding of the vertices: floats hold the areas.
constexpr double kShapeTolerance = 1e-5;
// An anchor's point lies on the surface and its element within [r]; less would make its spring stiffer than
// any other.
constexpr double kLeastAnchorDistance = 1e-3;

void checkElement(const Asset& asset, const CellShape& shape, std::size_t i) {
  const double volume = asset.volumes[i];
  if (!(std::abs(volume - shape.volume) <= kShapeTolerance * volume + shape.volumeSlack))
    refuseAsset("volumes[", i, "] is ", volume, " m^3; allowed: what its cell's triangles enclose, ",
                shape.volume, " +- ", kShapeTolerance * volume + shape.volumeSlack);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(asset.radius);
  if (!Eigen::AlignedBox3d(shape.box.min() - reach, shape.box.max() + reach).contains(asset.positions[i]))
    refuseAsset("positions[", i, "] is (", asset.positions[i].transpose(),
                "); allowed: within a radius of its "
                "cell's bounds");
  // A third of the trace of the inertia is two thirds of the mean square distance from the centroid. That is
  // least in a ball, 3/5 R^2, and in a box with the diagonal D at most D^2/4.
  const double least = 0.4 * std::pow(volume / ballVolume(1), 2.0 / 3.0) * (1 - kShapeTolerance);
  const double most = shape.box.diagonal().squaredNorm() / 6 * (1 + kShapeTolerance);
  if (!(asset.gyrations[i] >= least && asset.gyrations[i] <= most))
    refuseAsset("gyrations[", i, "] is ", asset.gyrations[i], " m^2; allowed: ", least, " to ", most,
                ", a ball of its volume to its cell's bounds");
}

void checkFace(const Asset& asset, std::uint32_t f, std::size_t cell) {
  const CellFace& face = asset.faces[f];
  if (face.neighbour != kNoElement && face.neighbour >= asset.cells.size())
    refuseAsset("faces[", f, "].neighbour is ", face.neighbour, "; allowed: 0 to ", asset.cells.size() - 1);
  if (face.neighbour == cell)
    refuseAsset("faces[", f, "].neighbour is ", cell, ", its own cell; allowed: another one");
  checkArea(double(face.area), "faces", f, 0);
  checkUnit(face.normal, "faces", f);
  checkPlace(face.centroid, "faces", f, ".centroid");
}

void checkFaces(const Asset& asset, const CellShape& shape, std::size_t i) {
  double outer = 0, inner = 0;
  const Cell& cell = asset.cells[i];
  for (std::uint32_t f = cell.firstFace; f < cell.firstFace + cell.faceCount; ++f) {
    checkFace(asset, f, i);
    const CellFace& face = asset.faces[f];
    const bool isOuter = face.neighbour == kNoElement;
    double& sum = isOuter ? outer : inner;
    sum += double(face.area);
    const double most =
        (isOuter ? shape.outerArea : shape.innerArea) * (1 + kShapeTolerance) + shape.areaSlack;
    if (!(sum <= most))
      refuseAsset("faces[", f, "].area is ", face.area, " m^2, with those before it in cell ", i, ' ', sum,
                  "; allowed: what the cell's ", isOuter ? "outer" : "inner", " triangles have, ", most);
    if (!shape.box.contains(face.centroid.cast<double>()))
      refuseAsset("faces[", f, "].centroid is (", face.centroid.transpose(),
                  "); allowed: within the bounds of its "
                  "cell ",
                  i);
  }
}

void checkAnchor(const Asset& asset, const CellShape& shape, std::size_t a) {
  const AssetAnchor& anchor = asset.anchors[a];
  const double most = shape.outerArea * (1 + kShapeTolerance) + shape.areaSlack;
  if (!(anchor.area <= most))
    refuseAsset("anchors[", a, "].area is ", anchor.area,
                " m^2; allowed: up to what its cell's outer triangles have, ", most);
  const double distance = (anchor.point - asset.positions[anchor.element]).norm();
  if (!shape.box.contains(anchor.point) || !(distance >= kLeastAnchorDistance * asset.radius))
    refuseAsset("anchors[", a, "].point is (", anchor.point.transpose(),
                "); allowed: within the bounds of cell ", anchor.element, ", ", kLeastAnchorDistance,
                " of the radius away from its element");
}

}  // namespace

void checkCells(const Asset& asset, CellWalk& walk, std::uint32_t first, std::uint32_t end) {
  const auto isBefore = [](const AssetAnchor& anchor, std::uint32_t cell) { return anchor.element < cell; };
  auto anchor = std::size_t(std::lower_bound(asset.anchors.begin(), asset.anchors.end(), first, isBefore) -
                            asset.anchors.begin());
  for (std::uint32_t i = first; i < end; ++i) {
    const CellShape shape = walk.enter(i);
    checkElement(asset, shape, i);
    checkFaces(asset, shape, i);
    for (; anchor < asset.anchors.size() && asset.anchors[anchor].element == i; ++anchor)
      checkAnchor(asset, shape, anchor);
  }
}

void checkCells(const Asset& asset, const AssetScale& scale) {
  CellWalk walk(asset, scale.rounding);
  checkCells(asset, walk, 0, std::uint32_t(asset.elementCount()));
  walk.finish();
}

}  // namespace rubble::base
