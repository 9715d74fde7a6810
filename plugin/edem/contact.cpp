#include "edem/contact.h"

#include <algorithm>

namespace rubble::edem {
namespace {

// k_t / k_n and k_r / (k_n R^2). So small that no mode is faster than the normal one: in units of k_n / m
// those of a sphere on a plane have the frequencies^2 0.89 and 0.06 beside 1, of two spheres 1.4 and 0.13
// beside 2. Memory then costs no substep (tests/physics/contact_law_test.cpp).
constexpr double kTangentialShare = 0.2;
constexpr double kRollingShare = 0.1;

}  // namespace

ContactLaw<double> contactLaw(const ContactSide& a, const ContactSide& b) {
  const double moves = a.mobility + b.mobility;
  assert(moves > 0 && a.stiffness >= 0 && b.stiffness >= 0);
  const double ratio = 0.5 * (a.damping + b.damping);
  ContactLaw<double> law;
  const double sum = a.stiffness + b.stiffness;
  law.stiffness = sum > 0 ? 2 * a.stiffness * b.stiffness / sum : 0;
  law.damping = dashpot(ratio, law.stiffness, 1 / moves);
  law.tangentialDamping = law.damping;
  law.friction = a.friction < 0 || b.friction < 0 ? -1 : 0.5 * (a.friction + b.friction);
  if (!a.memory || !b.memory) return law;
  const double restitution = a.restitution * b.restitution;
  law.inelastic = std::max(0.0, 1 - restitution * restitution);

  law.tangential = kTangentialShare * law.stiffness;
  law.tangentialDamping = dashpot(ratio, law.tangential, 1 / (moves + a.turning + b.turning));
  // A flat side has no curvature of its own: R is the other's radius.
  const double curvature = (a.radius > 0 ? 1 / a.radius : 0) + (b.radius > 0 ? 1 / b.radius : 0);
  const double turning = (a.radius > 0 ? a.turning / (a.radius * a.radius) : 0) +
                         (b.radius > 0 ? b.turning / (b.radius * b.radius) : 0);
  if (!(curvature > 0) || !(turning > 0)) return law;
  const double radius = 1 / curvature;
  law.rolling = kRollingShare * law.stiffness * radius * radius;
  law.rollingDamping = dashpot(ratio, law.rolling, 1 / turning);
  law.rollingReach = 0.5 * (a.rollingFriction + b.rollingFriction) * radius;
  return law;
}

}  // namespace rubble::edem
