// Gravity, and planes and balls for debris to fall on.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "debris/debris_collider.h"
#include "debris/flight.h"
#include "debris/spawn.h"

namespace rubble::test {

inline constexpr double kGravity = 9.81;  ///< [m/s^2]
inline const Eigen::Vector3d kDown(0, -kGravity, 0);
inline constexpr double kTick = 1.0 / 240;  ///< [s]

struct TestPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();
  double offset = 0;  ///< normal . x on the plane [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double inverseMass = 0;
  std::uint32_t surface = debris::kFixedSurface;
};

/// A ball that hits may push and turn.
struct TestBall {
  debris::DebrisSurface body{};
  double radius = 0;  ///< [m]
  std::uint32_t surface = debris::kFixedSurface;

  debris::Motion motion() const {
    return debris::motionOf(1 / body.inverseMass.x(), 1 / body.inverseInertia(0, 0), body.centre,
                            body.velocity, body.spin);
  }
};

class Surroundings : public debris::DebrisCollider {
 public:
  Surroundings() = default;
  explicit Surroundings(std::vector<TestPlane> some) : planes(std::move(some)) {}

  std::vector<TestPlane> planes;
  std::vector<TestBall> balls;
  std::vector<std::uint32_t> supports;  ///< as they were noted
  std::uint32_t surfaces = 0;
  Eigen::AlignedBox3d swept;
  std::size_t sweeps = 0;

  void begin(const Eigen::AlignedBox3d& box) override {
    swept = box;
    sweeps = 0;
  }
  std::uint32_t surfaceCount() const override { return surfaces; }
  debris::DebrisSurface surface(std::uint32_t id) const override {
    debris::DebrisSurface body{};
    for (const TestPlane& plane : planes) {
      if (plane.surface != id) continue;
      body.velocity = plane.velocity;
      body.inverseMass.setConstant(plane.inverseMass);
    }
    for (const TestBall& ball : balls)
      if (ball.surface == id) body = ball.body;
    return body;
  }
  void noteSupport(std::uint32_t id) override { supports.push_back(id); }

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
      hit.surface = plane.surface;
    }
    for (const TestBall& ball : balls) first = std::min(first, sweepBall(ball, from, to, radius, first, hit));
    return first <= 1;
  }

 private:
  static double sweepBall(const TestBall& ball, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                          double radius, double first, debris::DebrisHit& hit) {
    const Eigen::Vector3d along = to - from, out = from - ball.body.centre;
    const double reach = ball.radius + radius;
    const double a = along.squaredNorm(), b = out.dot(along), c = out.squaredNorm() - reach * reach;
    const double root = b * b - a * c;
    if (b >= 0 || root < 0) return 2;
    const double fraction = std::max(0.0, (-b - std::sqrt(root)) / a);
    if (fraction > 1 || fraction >= first) return 2;
    hit.fraction = fraction;
    hit.normal = (out + fraction * along).normalized();
    hit.point = ball.body.centre + ball.radius * hit.normal;
    hit.surface = ball.surface;
    return fraction;
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
