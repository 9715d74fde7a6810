#include "edem/rigid_proxy.h"

#include <algorithm>
#include <limits>

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

SurfacePoint nearest(const RigidProxy& proxy, const Eigen::Vector3d& world, double reach) {
  const Eigen::Vector3d local = proxy.orientation.conjugate() * (world - proxy.position);
  SurfacePoint best{std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitY()};
  for (const Collider& part : proxy.parts) {
    const SurfacePoint s = nearest(part, local, reach);
    if (s.distance < best.distance) best = s;
  }
  best.normal = proxy.orientation * best.normal;
  return best;
}

}  // namespace rubble::edem
