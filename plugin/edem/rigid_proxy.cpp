#include "edem/rigid_proxy.h"

#include <algorithm>

namespace rubble::edem {

Eigen::AlignedBox3d RigidProxy::bounds() const {
  Eigen::AlignedBox3d all;
  const Eigen::Matrix3d turn = orientation.toRotationMatrix();
  for (const Collider& part : parts) {
    const Eigen::AlignedBox3d b = part.bounds();
    if (!b.sizes().allFinite()) return b;
    const Eigen::Vector3d centre = position + turn * b.center(), half = turn.cwiseAbs() * (0.5 * b.sizes());
    all.extend(Eigen::AlignedBox3d(centre - half, centre + half));
  }
  return all;
}

double RigidProxy::reach() const {
  double furthest = 0;
  for (const Collider& part : parts) {
    const Eigen::AlignedBox3d b = part.bounds();
    if (b.sizes().allFinite()) furthest = std::max(furthest, b.center().norm() + 0.5 * b.diagonal().norm());
  }
  return furthest;
}

}  // namespace rubble::edem
