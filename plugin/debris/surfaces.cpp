#include "debris/surfaces.h"

#include <string>

#include "rubble/error.h"

namespace rubble::debris {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
const DebrisSurface kStanding{};

void checkSurface(const DebrisSurface& s, std::uint32_t id) {
  const bool valid = isUsable(s.centre) && isUsable(s.velocity) && isUsable(s.spin) &&
                     isUsable(s.inverseMass) && s.inverseMass.minCoeff() >= 0 &&
                     (s.inverseInertia.array().abs() <= kLargest).all() &&
                     s.inverseInertia.diagonal().minCoeff() >= 0;
  if (!valid)
    throw Error("debris: the body of surface " + std::to_string(id) +
                " is not finite, or its inverse mass or inertia is out of range");
}

// What the body behind a surface is given about its own centre.
struct Received {
  Eigen::Vector3d linear, angular;
};
Received receivedBy(const DebrisSurface& s, const Impulse& lost) {
  return {-lost.linear, -lost.angularAbout(s.centre)};
}

// The velocities change in proportion to the impulse, so their mean does the work.
double workOn(const DebrisSurface& s, const Received& r) {
  return r.linear.dot(s.velocity + 0.5 * s.inverseMass.cwiseProduct(r.linear)) +
         r.angular.dot(s.spin + 0.5 * (s.inverseInertia * r.angular));
}

}  // namespace

void Surfaces::begin(const DebrisCollider& collider) {
  m_collider = &collider;
  for (const SurfaceImpulse& impulse : m_impulses) m_placeOf[impulse.surface] = kNone;
  m_motions.clear();
  m_impulses.clear();
  m_placeOf.resize(collider.surfaceCount(), kNone);
}

std::uint32_t Surfaces::place(std::uint32_t id) {
  std::uint32_t& place = m_placeOf[id];
  if (place != kNone) return place;
  const DebrisSurface motion = m_collider->surface(id);
  checkSurface(motion, id);
  place = std::uint32_t(m_motions.size());
  m_motions.push_back(motion);
  m_impulses.emplace_back().surface = id;
  return place;
}

const DebrisSurface& Surfaces::of(std::uint32_t id) {
  return id == kFixedSurface ? kStanding : m_motions[place(id)];
}

double Surfaces::workOf(std::uint32_t id, const Impulse& lost) {
  const DebrisSurface& s = of(id);
  return workOn(s, receivedBy(s, lost));
}

double Surfaces::give(std::uint32_t id, const Impulse& lost) {
  if (id == kFixedSurface) return 0;
  const std::uint32_t at = place(id);
  DebrisSurface& s = m_motions[at];
  const Received received = receivedBy(s, lost);
  const double work = workOn(s, received);
  s.velocity += s.inverseMass.cwiseProduct(received.linear);
  s.spin += s.inverseInertia * received.angular;
  SurfaceImpulse& impulse = m_impulses[at];
  impulse.linear -= lost.linear;
  impulse.angular -= lost.angular;
  impulse.work += work;
  return work;
}

}  // namespace rubble::debris
