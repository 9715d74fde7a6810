// The force stages of a substep: springs and element contacts.
#include <cassert>
#include <cmath>

#include "edem/stages.h"

namespace rubble::edem {
namespace {

// Adds (sign 1) or takes back (sign -1) what a spring does to its elements.
template <class Real>
void addSpring(Body<Real>& body, std::size_t s, const SpringLoad<Real>& load, Real sign) {
  const Spring<Real>& spring = body.springs[s];
  const Vec3<Real> elastic = sign * load.elastic, damping = sign * load.damping;
  const Vec3<Real> all = elastic + damping;
  const Vec3<Real> elasticTorque = sign * load.elasticTorque, dampingTorque = sign * load.dampingTorque;
  const auto add = [&](std::uint32_t i, const Vec3<Real>& f, const Vec3<Real>& fd, const Vec3<Real>& arm,
                       Real side) {
    body.force[i] += f;
    body.dampingForce[i] += fd;
    body.torque[i] += arm.cross(all) + side * (elasticTorque + dampingTorque);
    body.dampingTorque[i] += arm.cross(damping) + side * dampingTorque;
  };
  add(spring.first, all, damping, load.armFirst, Real(1));
  if (!body.isAnchor(s)) add(spring.second, -all, -damping, load.armSecond, Real(-1));
}

// The anchor's impulse on its element, about the books' centre.
template <class Real>
void bookAnchor(const Body<Real>& body, std::size_t s, const SpringLoad<Real>& load, double signedKick,
                Books& books) {
  const std::uint32_t i = body.springs[s].first;
  const Vec3<Real> force = load.elastic + load.damping;
  const Vec3<Real> torque = load.armFirst.cross(force) + load.elasticTorque + load.dampingTorque;
  const Eigen::Vector3d arm = body.origin - books.centre + body.position[i].template cast<double>();
  books.anchors.push(signedKick, force.template cast<double>(), arm, torque.template cast<double>());
}

// One touching pair. Forces on the second element.
template <class Real>
struct PairTouch {
  bool touches = false;
  ContactForce<Real> force;
  Vec3<Real> armFirst, armSecond;  // centre -> contact point [m]
  Real energy = 0;                 // elastic [J]
  Real power = 0;                  // of the elastic force [W]
};

// Contact distance D of a pair, law 2: own to joined pairs and to pairs overlapping at rest, and
// growing with their distance.
template <class Real>
Real contactDistance(const PairEntry& entry, Body<Real>& a, const Body<Real>& b, Real distance) {
  const Real free = a.radius + b.radius;
  if (entry.pair == kNoPair) return free;
  Real& range = a.range[entry.pair];
  if (distance > range) range = std::fmin(distance, free);
  return range;
}

template <class Real>
PairTouch<Real> touchPair(const PairEntry& entry, const Vec3<Real>& offset, Body<Real>& a, Body<Real>& b) {
  PairTouch<Real> touch;
  const std::uint32_t i = entry.first, j = entry.second;
  assert(i < a.elementCount() && j < b.elementCount());
  if (!a.alive[i] || !b.alive[j]) return touch;
  const Vec3<Real> between = (b.position[j] - a.position[i]) + offset;
  const Real distance2 = between.squaredNorm();
  const Real free = a.radius + b.radius;
  if (distance2 >= free * free) {
    if (entry.pair != kNoPair) a.range[entry.pair] = free;
    return touch;
  }
  const Real distance = std::sqrt(distance2);
  const Real overlap = contactDistance(entry, a, b, distance) - distance;
  if (!(overlap > Real(0)) || !(distance > Real(0))) return touch;
  touch.touches = true;
  const Vec3<Real> normal = between / distance;
  touch.armFirst = between * (a.radius / free);
  touch.armSecond = -between * (b.radius / free);
  const Vec3<Real> approach =
      b.velocity[j] + b.spin[j].cross(touch.armSecond) - a.velocity[i] - a.spin[i].cross(touch.armFirst);
  // Different materials touch with the mean law.
  const ContactLaw<Real> law{Real(0.5) * (a.contact.stiffness + b.contact.stiffness),
                             Real(0.5) * (a.contact.damping + b.contact.damping),
                             Real(0.5) * (a.contact.friction + b.contact.friction)};
  touch.force = contactForce(law, overlap, normal, approach);
  touch.energy = Real(0.5) * law.stiffness * overlap * overlap;
  touch.power = touch.force.elastic.dot(approach);
  return touch;
}

template <class Real>
void addTouch(const PairTouch<Real>& touch, Body<Real>& a, std::uint32_t i, Body<Real>& b, std::uint32_t j,
              Real sign) {
  const Vec3<Real> damping = sign * touch.force.damping;
  const Vec3<Real> all = sign * touch.force.elastic + damping;
  a.force[i] -= all;
  b.force[j] += all;
  a.dampingForce[i] -= damping;
  b.dampingForce[j] += damping;
  // The elastic part is along the arms and turns nothing.
  const Vec3<Real> torqueFirst = -touch.armFirst.cross(damping),
                   torqueSecond = touch.armSecond.cross(damping);
  a.torque[i] += torqueFirst;
  b.torque[j] += torqueSecond;
  a.dampingTorque[i] += torqueFirst;
  b.dampingTorque[j] += torqueSecond;
}

template <class Real>
Vec3<Real> offsetBetween(const Body<Real>& a, const Body<Real>& b) {
  return (b.origin - a.origin).template cast<Real>();
}

}  // namespace

template <class Real>
void beginSubstep(Body<Real>& body) {
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.position[i] = body.rest[i] + body.displacement[i];
    body.force[i].setZero();
    body.torque[i].setZero();
    body.dampingForce[i].setZero();
    body.dampingTorque[i].setZero();
    body.load[i] = 0;
  }
  body.overloaded.clear();
  body.overloadMode.clear();
  body.crushing.clear();
}

template <class Real>
double accumulateSprings(Body<Real>& body, double kick, bool breaking, Books& books) {
  assert(std::isfinite(kick) && kick >= 0);
  assert(body.intact.size() == body.springs.size() && body.force.size() == body.elementCount());
  double elastic = 0;
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    if (!body.intact[s]) continue;
    const Spring<Real>& spring = body.springs[s];
    assert(spring.first < body.elementCount() && spring.second < body.elementCount());
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    const Real energy = load.stretchEnergy + load.rotationEnergy;
    elastic += double(energy);
    // Eq. (3): each spring counts for both its elements (DEVIATION, default: with the energy of k_rot).
    body.load[spring.first] += energy;
    if (body.isAnchor(s)) {
      bookAnchor(body, s, load, kick, books);
    } else {
      body.load[spring.second] += energy;
    }
    addSpring(body, s, load, Real(1));
    BreakMode mode{};
    if (breaking && breaks(body.criterion, spring, load, mode)) {
      body.overloaded.push_back(std::uint32_t(s));
      body.overloadMode.push_back(mode);
    }
  }
  return elastic;
}

template <class Real>
double accumulateContacts(const PairList& list, Body<Real>& a, Body<Real>& b) {
  const Vec3<Real> offset = offsetBetween(a, b);
  double elastic = 0;
  for (const PairEntry& entry : list.entries) {
    const PairTouch<Real> touch = touchPair(entry, offset, a, b);
    if (!touch.touches) continue;
    elastic += double(touch.energy);
    addTouch(touch, a, entry.first, b, entry.second, Real(1));
  }
  return elastic;
}

template <class Real>
void releaseContacts(const PairList& list, Body<Real>& a, Body<Real>& b, double kick, Books& books) {
  const Vec3<Real> offset = offsetBetween(a, b);
  for (const PairEntry& entry : list.entries) {
    if (!a.leaving[entry.first] && !b.leaving[entry.second]) continue;
    const PairTouch<Real> touch = touchPair(entry, offset, a, b);
    if (!touch.touches) continue;
    addTouch(touch, a, entry.first, b, entry.second, Real(-1));
    books.elastic -= double(touch.energy);
    books.fracture += double(touch.energy) + 0.5 * kick * double(touch.power);
  }
}

template <class Real>
void markCrushed(Body<Real>& body) {
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    if (!body.alive[i] || !(body.load[i] > body.crushEnergy[i])) continue;
    body.leaving[i] = 1;
    body.crushing.push_back(i);
  }
  if (body.crushing.empty()) return;
  std::vector<std::uint8_t>& listed = body.springListed;
  for (const std::uint32_t s : body.overloaded) listed[s] = 1;
  for (const std::uint32_t i : body.crushing) {
    for (std::uint32_t k = body.springOffsets[i]; k < body.springOffsets[i + 1]; ++k) {
      const std::uint32_t s = body.springsOf[k];
      if (!body.intact[s] || listed[s]) continue;
      listed[s] = 1;
      body.overloaded.push_back(s);
      body.overloadMode.push_back(BreakMode::Crushed);
    }
  }
  for (const std::uint32_t s : body.overloaded) listed[s] = 0;
}

template <class Real>
void applyBreaks(Body<Real>& body, std::uint32_t place, double kick, PairLists<Real>& lists, Books& books,
                 TickReport& report) {
  assert(std::isfinite(kick) && kick >= 0);
  assert(body.overloadMode.size() == body.overloaded.size());
  for (std::size_t k = 0; k < body.overloaded.size(); ++k) {
    const std::uint32_t s = body.overloaded[k];
    assert(s < body.springs.size() && body.intact[s]);
    const Spring<Real>& spring = body.springs[s];
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    addSpring(body, s, load, Real(-1));
    body.intact[s] = 0;
    ++body.brokenCount;
    const double energy = double(load.stretchEnergy) + double(load.rotationEnergy);
    books.elastic -= energy;
    books.fracture += energy + 0.5 * kick * double(load.power);

    const Eigen::Vector3d at =
        body.origin + (body.position[spring.first] + load.armFirst).template cast<double>();
    report.broken.push_back({body.id, s, body.overloadMode[k], energy, at});
    if (body.isAnchor(s)) {
      bookAnchor(body, s, load, -kick, books);
      --body.anchorsIntact;
      bool held = false;
      for (std::uint32_t q = body.springOffsets[spring.first]; q < body.springOffsets[spring.first + 1]; ++q)
        held = held || (body.isAnchor(body.springsOf[q]) && body.intact[body.springsOf[q]]);
      if (!held) body.groundRange[spring.first] = Real(kJustReleased);
    } else {
      const Real distance = (body.position[spring.second] - body.position[spring.first]).norm();
      body.range[s] = std::fmin(Real(2) * body.radius, distance);
      if (!body.model.contactBesideSpring) lists.addBroken(place, {spring.first, spring.second, s});
    }
  }
}

template void beginSubstep(Body<float>&);
template void beginSubstep(Body<double>&);
template double accumulateSprings(Body<float>&, double, bool, Books&);
template double accumulateSprings(Body<double>&, double, bool, Books&);
template double accumulateContacts(const PairList&, Body<float>&, Body<float>&);
template double accumulateContacts(const PairList&, Body<double>&, Body<double>&);
template void releaseContacts(const PairList&, Body<float>&, Body<float>&, double, Books&);
template void releaseContacts(const PairList&, Body<double>&, Body<double>&, double, Books&);
template void markCrushed(Body<float>&);
template void markCrushed(Body<double>&);
template void applyBreaks(Body<float>&, std::uint32_t, double, PairLists<float>&, Books&, TickReport&);
template void applyBreaks(Body<double>&, std::uint32_t, double, PairLists<double>&, Books&, TickReport&);

}  // namespace rubble::edem
