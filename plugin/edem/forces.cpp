// The springs of a substep: their forces, and which of them break.
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
  const Eigen::Vector3d arm = body.origin - books.centre + body.position[i];
  books.anchors.push(signedKick, force.template cast<double>(), arm, torque.template cast<double>());
}

}  // namespace

template <class Real>
void beginSubstep(Body<Real>& body) {
  for (const std::uint32_t i : body.awake) {
    body.position[i] = body.rest[i] + body.displacement[i].template cast<double>();
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
  double elastic = body.energyAsleep;
  for (const std::uint32_t s : body.awakeSprings) {
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
      body.overloaded.push_back(s);
      body.overloadMode.push_back(mode);
    }
  }
  return elastic;
}

template <class Real>
void markCrushed(Body<Real>& body) {
  for (const std::uint32_t i : body.awake) {
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
        body.origin + body.position[spring.first] + load.armFirst.template cast<double>();
    report.broken.push_back({body.id, s, body.overloadMode[k], energy, at});
    if (body.isAnchor(s)) {
      bookAnchor(body, s, load, -kick, books);
      --body.anchorsIntact;
      bool held = false;
      for (std::uint32_t q = body.springOffsets[spring.first]; q < body.springOffsets[spring.first + 1]; ++q)
        held = held || (body.isAnchor(body.springsOf[q]) && body.intact[body.springsOf[q]]);
      if (!held) body.anchored[spring.first] = 0;
    } else {
      const Real distance = Real((body.position[spring.second] - body.position[spring.first]).norm());
      body.range[s] = std::fmin(Real(2) * body.radius, distance);
      if (body.cells) exposeBroken(*body.cells, body.intact, spring.first, spring.second, body.exposure);
      if (!body.model.contactBesideSpring) lists.addBroken(place, {spring.first, spring.second, s});
    }
  }
}

template void beginSubstep(Body<float>&);
template void beginSubstep(Body<double>&);
template double accumulateSprings(Body<float>&, double, bool, Books&);
template double accumulateSprings(Body<double>&, double, bool, Books&);
template void markCrushed(Body<float>&);
template void markCrushed(Body<double>&);
template void applyBreaks(Body<float>&, std::uint32_t, double, PairLists<float>&, Books&, TickReport&);
template void applyBreaks(Body<double>&, std::uint32_t, double, PairLists<double>&, Books&, TickReport&);

}  // namespace rubble::edem
