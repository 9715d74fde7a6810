#include "edem/round_surfaces.h"

#include <algorithm>
#include <cmath>

namespace rubble::edem {
namespace {

// A point in the plane through it and the axis: distance from the axis, place along it.
struct Meridian {
  explicit Meridian(const Eigen::Vector3d& p) : at(std::hypot(p.x(), p.z()), p.y()) {
    if (at.x() > 0) away = Eigen::Vector3d(p.x(), 0, p.z()) / at.x();
  }
  Eigen::Vector3d direction(const Eigen::Vector2d& d) const {
    return d.x() * away + d.y() * Eigen::Vector3d::UnitY();
  }
  Eigen::Vector2d at;
  Eigen::Vector3d away = Eigen::Vector3d::UnitX();  // on the axis any direction is one
};

Eigen::Vector2d nearestOnSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                 const Eigen::Vector2d& p) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  return length2 > 0 ? Eigen::Vector2d(a + std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) * ab) : a;
}

}  // namespace

SurfacePoint nearestOnCapsule(double radius, double half, const Eigen::Vector3d& p) {
  const Eigen::Vector3d away = p - Eigen::Vector3d(0, std::clamp(p.y(), -half, half), 0);
  const double length = away.norm();
  return {length - radius, length > 0 ? Eigen::Vector3d(away / length) : Eigen::Vector3d::UnitX()};
}

SurfacePoint nearestOnCylinder(double radius, double half, const Eigen::Vector3d& p) {
  const Meridian m(p);
  const double side = m.at.x() - radius, end = std::abs(m.at.y()) - half;
  const double up = m.at.y() < 0 ? -1 : 1;
  if (side <= 0 && end <= 0)
    return side > end ? SurfacePoint{side, m.away} : SurfacePoint{end, up * Eigen::Vector3d::UnitY()};
  const Eigen::Vector2d outside(std::max(side, 0.0), std::max(end, 0.0));
  const double distance = outside.norm();
  return {distance, m.direction({outside.x() / distance, up * outside.y() / distance})};
}

SurfacePoint nearestOnCone(double radius, double half, const Eigen::Vector3d& p) {
  const Meridian m(p);
  const Eigen::Vector2d apex(0, half), rim(radius, -half), middle(0, -half);
  const Eigen::Vector2d slant = Eigen::Vector2d(2 * half, radius).normalized();
  const double side = slant.dot(m.at - apex), end = -half - m.at.y();
  const SurfacePoint inside =
      side > end ? SurfacePoint{side, m.direction(slant)} : SurfacePoint{end, -Eigen::Vector3d::UnitY()};
  if (inside.distance <= 0) return inside;
  const Eigen::Vector2d onSide = m.at - nearestOnSegment(apex, rim, m.at),
                        onEnd = m.at - nearestOnSegment(middle, rim, m.at);
  const Eigen::Vector2d& away = onSide.squaredNorm() < onEnd.squaredNorm() ? onSide : onEnd;
  const double distance = away.norm();
  if (!(distance > 0)) return inside;
  return {distance, m.direction(away / distance)};
}

}  // namespace rubble::edem
