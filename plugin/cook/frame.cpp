#include "cook/frame.h"

#include <algorithm>
#include <cmath>

#include "base/asset_check.h"

namespace rubble::cooking {
namespace {

// Of the elements that the options ask for; fewer, where so many do not fit, are farther apart [m].
double foretoldSpacing(const CheckedMesh& solid, const CookOptions& options) {
  const double count = options.elements > 0
                           ? double(options.elements)
                           : std::ceil(options.fill * solid.volume / base::ballVolume(options.radius));
  return std::cbrt(solid.volume / std::max(1.0, count));
}

}  // namespace

Eigen::Vector3d frameOrigin(const CheckedMesh& solid, const CookOptions& options) {
  if (base::isSharp(solid.bounds, foretoldSpacing(solid, options), 1)) return Eigen::Vector3d::Zero();
  const double grain = std::exp2(std::floor(std::log2(solid.diagonal())) - 2);
  return grain * (solid.bounds.center() / grain).array().round().matrix();
}

SurfaceMesh moved(const SurfaceMesh& mesh, const Eigen::Vector3d& origin) {
  SurfaceMesh result{mesh.vertices, mesh.triangles};
  for (Eigen::Vector3d& vertex : result.vertices) vertex -= origin;
  return result;
}

}  // namespace rubble::cooking
