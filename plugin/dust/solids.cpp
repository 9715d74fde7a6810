#include "dust/solids.h"

#include <algorithm>
#include <cmath>

namespace rubble::dust {

namespace {

using shared::vec4;

bool usable(const DustObstacle& o) {
  const bool sphere = o.kind == DustObstacle::Kind::Sphere;
  const float least = sphere ? o.halfExtents.x() : o.halfExtents.minCoeff();
  return o.position.allFinite() && o.velocity.allFinite() && o.spin.allFinite() &&
         o.halfExtents.allFinite() && least > 0 && o.orientation.coeffs().allFinite() &&
         o.orientation.norm() > 0.5f;
}

vec4 pack(const Eigen::Vector3f& v, float w) {
  return {v.x(), v.y(), v.z(), w};
}

shared::DustSolid describe(const DustObstacle& o, const Eigen::Matrix3f& rotation) {
  // Without squares that overflow: a huge velocity would be cut to none.
  const float speed = o.velocity.stableNorm();
  const float cut = speed > shared::kDustMaxSpeed ? shared::kDustMaxSpeed / speed : 1;
  const bool box = o.kind == DustObstacle::Kind::Box;
  return {pack(o.position, box ? 1.0f : 0.0f),
          pack(rotation.col(0), o.halfExtents.x()),
          pack(rotation.col(1), o.halfExtents.y()),
          pack(rotation.col(2), o.halfExtents.z()),
          pack(o.velocity * cut, 0),
          pack(o.spin, 0)};
}

}  // namespace

void gatherSolids(const Lattice& lattice, std::span<const DustObstacle> obstacles,
                  std::vector<SolidCells>& solids) {
  solids.clear();
  for (const DustObstacle& o : obstacles) {
    if (!usable(o)) continue;
    const Eigen::Matrix3f rotation = o.orientation.normalized().toRotationMatrix();
    const bool sphere = o.kind == DustObstacle::Kind::Sphere;
    const Eigen::Vector3f reach = sphere ? Eigen::Vector3f::Constant(o.halfExtents.x())
                                         : Eigen::Vector3f(rotation.cwiseAbs() * o.halfExtents);
    SolidCells s{describe(o, rotation), Eigen::Vector3i::Zero(), Eigen::Vector3i::Zero()};
    bool inside = true;
    for (int a = 0; a < 3; ++a) {
      const float low = (o.position[a] - reach[a] - lattice.origin[a]) / lattice.cell[a];
      const float high = (o.position[a] + reach[a] - lattice.origin[a]) / lattice.cell[a];
      const float end = float(lattice.n);
      inside = inside && low < end && high >= 0;
      s.first[a] = int(std::clamp(low, 0.0f, end - 1));
      s.last[a] = int(std::clamp(high, 0.0f, end - 1));
    }
    if (inside) solids.push_back(s);
  }
}

}  // namespace rubble::dust
