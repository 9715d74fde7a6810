#include "bullet/thaw.h"

#include <algorithm>
#include <cmath>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Share of the tensile strength that a blow's stress may reach.
constexpr double kStressShare = 0.5;
// Bullet's shape touches before the elements' spheres do: how far an element's surface may be away, in radii
// and in ways of this tick.
constexpr double kReachRadii = 1.6, kReachWays = 1.2;

// An element at x that nears the surface of `proxy` with the velocity and the acceleration `relative`.
bool reaches(const edem::RigidProxy& proxy, const Eigen::Vector3d& x, const Eigen::Vector3d& relative,
             const Eigen::Vector3d& acceleration, double radius, double least, double dt) {
  const edem::SurfacePoint s = edem::nearest(proxy, x);
  const double speed = -relative.dot(s.normal), gained = std::max(0.0, -acceleration.dot(s.normal));
  // What falls from rest is faster where it arrives; what rests already is not.
  const double gap = std::max(0.0, s.distance - radius);
  const double closing =
      speed < 0 ? speed : std::min(speed + gained * dt, std::sqrt(speed * speed + 2 * gained * gap));
  return closing > least && s.distance - kReachRadii * radius < kReachWays * closing * dt;
}

// A light partner's blow is over before sound has crossed an element.
double leastSpeed(double strikingSpeed, double inverseMass, double elementMass) {
  return strikingSpeed * std::sqrt(std::max(1.0, 2 * elementMass * inverseMass));
}

}  // namespace

double strikingSpeed(const Material& material) {
  return kStressShare * material.tensileStrength / std::sqrt(material.youngsModulus * material.density);
}

bool strikes(const edem::Solver& solver, std::uint32_t body, const RigidMotion& own,
             const edem::RigidProxy& partner, double strikingSpeed, double dt) {
  const edem::BodyView view = solver.view(body);
  const double radius = solver.radius(body);
  const RigidMotion other{partner.position, partner.velocity, partner.spin};
  for (std::size_t i = 0; i < view.alive.size(); ++i) {
    const double least = leastSpeed(strikingSpeed, partner.inverseMass, view.mass[i]);
    const Eigen::Vector3d x = solver.position(body, i);
    if (reaches(partner, x, own.at(x) - other.at(x), own.acceleration - partner.acceleration, radius, least,
                dt))
      return true;
  }
  return false;
}

bool elementsStrike(const edem::Solver& solver, std::uint32_t striking, const edem::RigidProxy& own,
                    double strikingSpeed, double dt) {
  const edem::BodyView view = solver.view(striking);
  const double radius = solver.radius(striking);
  const RigidMotion motion{own.position, own.velocity, own.spin};
  for (std::size_t i = 0; i < view.alive.size(); ++i) {
    if (!view.alive[i]) continue;
    const Eigen::Vector3d x = solver.position(striking, i);
    if (reaches(own, x, solver.velocity(striking, i) - motion.at(x), Eigen::Vector3d::Zero(), radius,
                strikingSpeed, dt))
      return true;
  }
  return false;
}

bool pointsStrike(std::span<const StrikingPoint> points, double margin, const edem::RigidProxy& own,
                  double elementMass, double strikingSpeed, double dt) {
  const RigidMotion motion{own.position, own.velocity, own.spin};
  return std::ranges::any_of(points, [&](const StrikingPoint& p) {
    const double least = leastSpeed(strikingSpeed, p.inverseMass, elementMass);
    return reaches(own, p.at, p.velocity - motion.at(p.at), Eigen::Vector3d::Zero(), margin, least, dt);
  });
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
