// Planes for debris to fall on.
#pragma once

#include <algorithm>
#include <vector>

#include "debris/debris_collider.h"
#include "debris/flight.h"
#include "debris/spawn.h"

namespace rubble::test {

struct TestPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();
  double offset = 0;  ///< normal . x on the plane [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double inverseMass = 0;
  std::uint32_t surface = debris::kFixedSurface;
};

class Surroundings : public debris::DebrisCollider {
 public:
  Surroundings() = default;
  explicit Surroundings(std::vector<TestPlane> some) : planes(std::move(some)) {}

  std::vector<TestPlane> planes;
  std::uint32_t surfaces = 0;
  Eigen::AlignedBox3d swept;
  std::size_t sweeps = 0;

  void begin(const Eigen::AlignedBox3d& box) override {
    swept = box;
    sweeps = 0;
  }
  std::uint32_t surfaceCount() const override { return surfaces; }

  bool sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
             debris::DebrisHit& hit) override {
    ++sweeps;
    double first = 2;
    for (const TestPlane& plane : planes) {
      const double above = plane.normal.dot(from) - plane.offset - radius;
      const double rise = plane.normal.dot(to - from);
      if (rise > 0 || above + rise >= 0) continue;
      const double fraction = above > 0 ? above / -rise : 0;
      if (fraction >= first) continue;
      first = fraction;
      const Eigen::Vector3d centre = from + fraction * (to - from);
      hit.fraction = fraction;
      hit.point = centre - (plane.normal.dot(centre) - plane.offset) * plane.normal;
      hit.normal = plane.normal;
      hit.surfaceVelocity = plane.velocity;
      hit.inverseMass = plane.inverseMass;
      hit.surface = plane.surface;
    }
    return first <= 1;
  }
};

/// A stone of radius R [m] and concrete's density.
inline debris::DebrisParcel stone(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                                  double radius = 0.005) {
  debris::DebrisParcel parcel;
  parcel.position = position;
  parcel.velocity = velocity;
  parcel.mass = 0.01;
  parcel.inertia = 1e-6;
  parcel.radius = radius;
  parcel.collisionRadius = radius;
  parcel.density = 2400;
  parcel.friction = 0.6;
  parcel.scale = 0.5;
  return parcel;
}

inline debris::DebrisParcel stone(double height) {
  return stone(Eigen::Vector3d(0, height, 0), Eigen::Vector3d::Zero());
}

/// Vacuum: closed forms hold without drag.
inline constexpr debris::Air kVacuum{0, 0};

}  // namespace rubble::test
