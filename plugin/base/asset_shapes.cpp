#include <algorithm>
#include <cmath>

#include "base/asset_check.h"

namespace rubble::base {
namespace {

// Of volumes, gyrations and areas, beside the rounding of the vertices: floats hold the areas.
constexpr double kShapeTolerance = 1e-5;
// An anchor's point lies on the surface and its element within [r]; less would make its spring stiffer than
// any other.
constexpr double kLeastAnchorDistance = 1e-3;

// What the triangles of one cell say of it.
struct CellShape {
  Eigen::AlignedBox3d box;  // grown by the rounding [m]
  double volume = 0;        // enclosed [m^3]
  double outerArea = 0, innerArea = 0;
  double volumeSlack = 0, areaSlack = 0;  // what the rounding of the vertices may have changed
};

CellShape measure(const Asset& asset, const AssetScale& scale, std::size_t i) {
  const Cell& cell = asset.cells[i];
  const Eigen::Vector3d origin = asset.positions[i];
  CellShape shape;
  const std::uint32_t count = cell.outerTriangles + cell.innerTriangles;
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      const CellCorner& corner = asset.corners[asset.triangles[cell.firstTriangle + t][c]];
      p[c] = asset.vertices[corner.vertex].position.cast<double>() - origin;
      shape.box.extend(p[c]);
    }
    const Eigen::Vector3d across = (p[1] - p[0]).cross(p[2] - p[0]);
    shape.volume += p[0].dot(across) / 6;
    (t < cell.outerTriangles ? shape.outerArea : shape.innerArea) += across.norm() / 2;
  }
  // Moving the vertices of a triangle by e turns edges l into l + 2 e at most, which adds 2 e (l + e) to its
  // area; a surface that moves by e sweeps e times its area.
  const double e = scale.rounding;
  shape.areaSlack = 2 * e * double(count) * (shape.box.diagonal().norm() + e);
  shape.volumeSlack = e * (shape.outerArea + shape.innerArea + shape.areaSlack);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(e);
  shape.box = Eigen::AlignedBox3d(shape.box.min() + origin - margin, shape.box.max() + origin + margin);
  return shape;
}

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

void checkFaces(const Asset& asset, const CellShape& shape, std::size_t i) {
  double outer = 0, inner = 0;
  const Cell& cell = asset.cells[i];
  for (std::uint32_t f = cell.firstFace; f < cell.firstFace + cell.faceCount; ++f) {
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

void checkCellShapes(const Asset& asset, const AssetScale& scale) {
  std::size_t anchor = 0;
  for (std::size_t i = 0; i < asset.elementCount(); ++i) {
    const CellShape shape = measure(asset, scale, i);
    checkElement(asset, shape, i);
    checkFaces(asset, shape, i);
    for (; anchor < asset.anchors.size() && asset.anchors[anchor].element == i; ++anchor)
      checkAnchor(asset, shape, anchor);
  }
}

}  // namespace rubble::base
