#include "debris/contact.h"

#include <Eigen/LU>
#include <algorithm>

namespace rubble::debris {

namespace {

// Change of the velocity between piece and surface, for a change `velocity` of the piece's own by an impulse
// at its place: (1 + m K) velocity, with K the surface's inverse mass there.
Eigen::Vector3d relativeChange(const Particle& p, const DebrisSurface& s, const Eigen::Vector3d& velocity) {
  if (s.isHeld()) return velocity;
  const Eigen::Vector3d arm = p.position - s.centre;
  const Eigen::Vector3d turn = s.inverseInertia * arm.cross(velocity);
  return velocity + p.mass * (s.inverseMass.cwiseProduct(velocity) + turn.cross(arm));
}

}  // namespace

Eigen::Vector3d velocityAfterHit(const Particle& p, const Eigen::Vector3d& velocity,
                                 const Eigen::Vector3d& normal, double restitution, const DebrisSurface& s) {
  const Eigen::Vector3d relative = velocity - s.velocityAt(p.position);
  const double approach = -relative.dot(normal);
  if (!(approach > 0)) return velocity;
  const Eigen::Vector3d response = relativeChange(p, s, normal);
  const double push = (1 + restitution) * approach / response.dot(normal);
  // The push may turn the surface, so that it slides otherwise than before.
  const Eigen::Vector3d pushed = relative + push * response;
  const Eigen::Vector3d sliding = pushed - pushed.dot(normal) * normal;
  const double slip = sliding.norm();
  if (!(slip > 0)) return velocity + push * normal;
  const double stop = slip * slip / relativeChange(p, s, sliding).dot(sliding);
  const double grip = std::min(p.friction * push / slip, stop);
  return velocity + push * normal - grip * sliding;
}

Eigen::Vector3d spinAfterHit(const Particle& p, double restitution, const DebrisSurface& s) {
  const Eigen::Vector3d lost = (1 - restitution) * (p.spin - s.spin);
  if (s.inverseInertia.isZero(0)) return p.spin - lost;
  const Eigen::Matrix3d both = Eigen::Matrix3d::Identity() + p.inertia * s.inverseInertia;
  return p.spin - both.inverse() * lost;
}

}  // namespace rubble::debris
