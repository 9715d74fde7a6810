#include "cook/box_distance.h"

#include <cmath>

namespace rubble::cooking {

bool BoxDistance::isBox(const CheckedMesh& mesh) {
  constexpr double kRounding = 1e-12;  // of a volume summed over the triangles
  return std::abs(mesh.volume - mesh.bounds.volume()) <= kRounding * mesh.bounds.volume();
}

Distance BoxDistance::exact(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d fromCentre = place - m_box.center();
  const Eigen::Vector3d beyond = fromCentre.cwiseAbs() - m_box.sizes() / 2;  // negative inside the face pair
  const Eigen::Vector3d side = fromCentre.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
  const Eigen::Vector3d outside = beyond.cwiseMax(0.0);
  const double distance = outside.norm();
  if (distance > 0) return {distance, outside.cwiseProduct(side) / distance};
  int nearest = 0;
  const double depth = beyond.maxCoeff(&nearest);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  gradient[nearest] = side[nearest];
  return {depth, gradient};
}

}  // namespace rubble::cooking
