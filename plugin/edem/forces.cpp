// The springs of a substep: their forces, and which of them break.
#include <cassert>
#include <cmath>

#include "edem/frames.h"
#include "edem/stages.h"

namespace rubble::edem {
namespace {

// Adds (sign 1) or takes back (sign -1) what a spring does to its elements.
template <class Real>
void addSpring(const Body<Real>& body, std::size_t s, const SpringLoad<Real>& load, Real sign,
               BodyWork<Real>& work) {
  const Spring<Real>& spring = body.state.springs[s];
  const Vec3<Real> elastic = sign * load.elastic, damping = sign * load.damping;
  const Vec3<Real> all = elastic + damping;
  const Vec3<Real> elasticTorque = sign * load.elasticTorque, dampingTorque = sign * load.dampingTorque;
  const auto add = [&](std::uint32_t i, const Vec3<Real>& f, const Vec3<Real>& fd, const Vec3<Real>& arm,
                       Real side) {
    work.force[i] += f;
    work.dampingForce[i] += fd;
    work.torque[i] += arm.cross(all) + side * (elasticTorque + dampingTorque);
    work.dampingTorque[i] += arm.cross(damping) + side * dampingTorque;
  };
  add(spring.first, all, damping, load.armFirst, Real(1));
  if (!body.isAnchor(s)) add(spring.second, -all, -damping, load.armSecond, Real(-1));
}

// The anchor's impulse on its element, about the books' centre.
template <class Real>
void bookAnchor(const Body<Real>& body, std::size_t s, const SpringLoad<Real>& load, double signedKick,
                Books& books) {
  const std::uint32_t i = body.state.springs[s].first;
  const Vec3<Real> force = load.elastic + load.damping;
  const Vec3<Real> torque = load.armFirst.cross(force) + load.elasticTorque + load.dampingTorque;
  const Eigen::Vector3d arm = body.state.origin - books.centre + body.work.position[i];
  books.anchors.push(signedKick, force.template cast<double>(), arm, torque.template cast<double>());
}

// What the base gives at the far end of an anchor, for its work.
template <class Real>
void addBase(const Body<Real>& body, std::size_t s, const SpringLoad<Real>& load, double sign,
             BodyWork<Real>& work) {
  if (!body.state.base.given) return;
  const Vec3<Real> force = load.elastic + load.damping;
  const Vec3<Real> torque = load.armFirst.cross(force) + load.elasticTorque + load.dampingTorque;
  const Vec3<Real> lostTorque = load.armFirst.cross(load.damping) + load.dampingTorque;
  const Eigen::Vector3d arm =
      body.state.origin - body.state.base.at.origin + work.position[body.state.springs[s].first];
  const Eigen::Vector3d all = sign * force.template cast<double>(),
                        lost = sign * load.damping.template cast<double>();
  work.base.force += all;
  work.base.torque += arm.cross(all) + sign * torque.template cast<double>();
  work.baseDamping.force += lost;
  work.baseDamping.torque += arm.cross(lost) + sign * lostTorque.template cast<double>();
}

}  // namespace

template <class Real>
void beginSubstep(const BodyState<Real>& state, BodyWork<Real>& work) {
  for (const std::uint32_t i : work.awake) {
    work.position[i] = work.rest[i] + state.displacement[i].template cast<double>();
    work.force[i].setZero();
    work.torque[i].setZero();
    work.dampingForce[i].setZero();
    work.dampingTorque[i].setZero();
    work.load[i] = 0;
  }
  work.base = work.baseDamping = work.dampedByBase = {};
  work.overloaded.clear();
  work.overloadMode.clear();
  work.crushing.clear();
}

template <class Real>
double accumulateSprings(const Body<Real>& body, BodyWork<Real>& work, double kick, bool breaking,
                         Books& books) {
  assert(std::isfinite(kick) && kick >= 0);
  assert(body.state.intact.size() == body.state.springs.size() && work.force.size() == body.elementCount());
  double elastic = body.state.energyAsleep;
  for (const std::uint32_t s : work.awakeSprings) {
    if (!body.state.intact[s]) continue;
    const Spring<Real>& spring = body.state.springs[s];
    assert(spring.first < body.elementCount() && spring.second < body.elementCount());
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    const Real energy = load.stretchEnergy + load.rotationEnergy;
    elastic += double(energy);
    // Eq. (3): each spring counts for both its elements (DEVIATION, default: with the energy of k_rot).
    work.load[spring.first] += energy;
    if (body.isAnchor(s)) {
      if (!body.state.base.ride.on()) bookAnchor(body, s, load, kick, books);
      addBase(body, s, load, 1, work);
    } else {
      work.load[spring.second] += energy;
    }
    addSpring(body, s, load, Real(1), work);
    BreakMode mode{};
    if (breaking && breaks(body.constants->criterion, spring, load, mode)) {
      work.overloaded.push_back(s);
      work.overloadMode.push_back(mode);
    }
  }
  return elastic;
}

template <class Real>
void markCrushed(const Body<Real>& body, BodyWork<Real>& work) {
  for (const std::uint32_t i : work.awake) {
    if (!body.state.alive[i] || !(work.load[i] > body.constants->crushEnergy[i])) continue;
    work.leaving[i] = 1;
    work.crushing.push_back(i);
  }
  if (work.crushing.empty()) return;
  std::vector<std::uint8_t>& listed = work.springListed;
  for (const std::uint32_t s : work.overloaded) listed[s] = 1;
  for (const std::uint32_t i : work.crushing) {
    for (std::uint32_t k = body.constants->springOffsets[i]; k < body.constants->springOffsets[i + 1]; ++k) {
      const std::uint32_t s = body.constants->springsOf[k];
      if (!body.state.intact[s] || listed[s]) continue;
      listed[s] = 1;
      work.overloaded.push_back(s);
      work.overloadMode.push_back(BreakMode::Crushed);
    }
  }
  for (const std::uint32_t s : work.overloaded) listed[s] = 0;
}

template <class Real>
void applyBreaks(Body<Real>& body, std::uint32_t place, double kick, PairLists<Real>& lists, Books& books,
                 TickReport& report) {
  assert(std::isfinite(kick) && kick >= 0);
  assert(body.work.overloadMode.size() == body.work.overloaded.size());
  for (std::size_t k = 0; k < body.work.overloaded.size(); ++k) {
    const std::uint32_t s = body.work.overloaded[k];
    assert(s < body.state.springs.size() && body.state.intact[s]);
    const Spring<Real>& spring = body.state.springs[s];
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    addSpring(body, s, load, Real(-1), body.work);
    body.state.intact[s] = 0;
    ++body.state.brokenCount;
    const double energy = double(load.stretchEnergy) + double(load.rotationEnergy);
    books.elastic -= energy;
    books.fracture += energy + 0.5 * kick * double(load.power);

    const Eigen::Vector3d at =
        body.state.origin + body.work.position[spring.first] + load.armFirst.template cast<double>();
    report.broken.push_back({body.id, s, body.work.overloadMode[k], energy, at});
    if (body.isAnchor(s)) {
      if (!body.state.base.ride.on()) bookAnchor(body, s, load, -kick, books);
      addBase(body, s, load, -1, body.work);
      --body.state.anchorsIntact;
      bool held = false;
      for (std::uint32_t q = body.constants->springOffsets[spring.first];
           q < body.constants->springOffsets[spring.first + 1]; ++q)
        held = held || (body.isAnchor(body.constants->springsOf[q]) &&
                        body.state.intact[body.constants->springsOf[q]]);
      if (!held) body.state.anchored[spring.first] = 0;
    } else {
      const Real distance =
          Real((body.work.position[spring.second] - body.work.position[spring.first]).norm());
      body.state.range[s] = std::fmin(Real(2) * body.constants->radius, distance);
      if (body.constants->cells)
        exposeBroken(*body.constants->cells, body.state.intact, spring.first, spring.second,
                     body.state.exposure);
      if (!body.constants->model.contactBesideSpring)
        lists.addBroken(place, {spring.first, spring.second, s});
    }
  }
}

template <class Real>
void moveBase(Body<Real>& body, double kick, double step, Books& books) {
  AnchorBase& base = body.state.base;
  if (!base.given) return;
  const auto power = [&](const Wrench& load) {
    return 0.5 * kick * (load.force.dot(base.velocity.linear) + load.torque.dot(base.velocity.angular));
  };
  const double given = power(body.work.base), lost = power(body.work.baseDamping);
  advance(base, step);
  writeFarEnds(body);
  books.anchors.work.add(given, power(body.work.base));
  // Dashpots lose by how the ends move beside each other; integrate has booked the elements' part.
  books.dissipated.add(-lost, -power(body.work.baseDamping));
}

template void beginSubstep(const BodyState<float>&, BodyWork<float>&);
template void beginSubstep(const BodyState<double>&, BodyWork<double>&);
template double accumulateSprings(const Body<float>&, BodyWork<float>&, double, bool, Books&);
template double accumulateSprings(const Body<double>&, BodyWork<double>&, double, bool, Books&);
template void markCrushed(const Body<float>&, BodyWork<float>&);
template void markCrushed(const Body<double>&, BodyWork<double>&);
template void applyBreaks(Body<float>&, std::uint32_t, double, PairLists<float>&, Books&, TickReport&);
template void moveBase(Body<float>&, double, double, Books&);
template void moveBase(Body<double>&, double, double, Books&);
template void applyBreaks(Body<double>&, std::uint32_t, double, PairLists<double>&, Books&, TickReport&);

}  // namespace rubble::edem
