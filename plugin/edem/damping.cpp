#include "edem/damping.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "edem/anchor_ride.h"
#include "edem/rigid_motion.h"

namespace rubble::edem {
namespace {

template <class Real>
double kineticOf(const Body<Real>& body, std::size_t i) {
  return 0.5 * (body.constants->mass[i] * body.state.velocity[i].template cast<double>().squaredNorm() +
                body.constants->inertia[i] * body.state.spin[i].template cast<double>().squaredNorm());
}

}  // namespace

template <class Real>
void dampDeformation(Body<Real>& body, double rate, double dt, Books& books) {
  const std::vector<double> rates(body.elementCount(), rate);
  dampDeformation(body, std::span<const double>(rates), dt, books);
}

template <class Real>
void dampDeformation(Body<Real>& body, std::span<const double> rates, double dt, Books& books) {
  assert(rates.size() == body.elementCount() && dt >= 0);
  const AnchorBase& base = body.state.base;  // at rest where there is none
  auto motions = rigidMotions(body);
  std::vector<std::uint8_t> held(body.elementCount(), 0);
  for (const std::uint32_t i : body.work.awake)
    if (body.state.alive[i] && body.state.anchored[i]) held[body.state.fragment[i]] = 1;
  if (base.ride.moves())
    for (auto& [root, motion] : motions)
      if (held[root]) motion = withBase(motion, base);
  for (const std::uint32_t i : body.work.awake) {
    if (!body.state.alive[i]) continue;
    const double rate = rates[body.state.fragment[i]];
    assert(rate >= 0);
    if (!(rate > 0)) continue;
    const double lost = -std::expm1(-rate * dt);
    const bool isHeld = held[body.state.fragment[i]] != 0;
    const RigidMotion& m = motions.at(body.state.fragment[i]);
    const Eigen::Vector3d x = body.worldPosition(i);
    const bool byBase = isHeld && !base.ride.moves();
    const Eigen::Vector3d v = byBase ? base.velocityAt(x) : m.at(x);
    const Eigen::Vector3d w = byBase ? base.velocity.angular : m.spin;
    const double before = kineticOf(body, i);
    const Vec3<Real> velocity = body.state.velocity[i], spin = body.state.spin[i];
    body.state.velocity[i] += (lost * (v - velocity.template cast<double>())).template cast<Real>();
    body.state.spin[i] += (lost * (w - spin.template cast<double>())).template cast<Real>();
    const double taken = before - kineticOf(body, i);
    books.massDamped += taken;
    books.kinetic -= taken;
    if (!isHeld) continue;  // the others of the fragment have it
    const Eigen::Vector3d push =
        body.constants->mass[i] * (body.state.velocity[i] - velocity).template cast<double>();
    const Eigen::Vector3d turn =
        body.constants->inertia[i] * (body.state.spin[i] - spin).template cast<double>();
    if (base.ride.on()) {  // what it takes of that, and its work, are booked when it does (endRide)
      body.work.dampedByBase.force += push;
      body.work.dampedByBase.torque += (x - base.at.origin).cross(push) + turn;
    } else {
      books.anchors.push(1, push, x - books.centre, turn);
    }
    if (base.given && !base.ride.on()) {
      const double work = push.dot(v) + turn.dot(w);
      books.anchors.work.add(work, 0);
      books.massDamped += work;
    }
    books.linear += push;
    books.angular += (x - books.centre).cross(push) + turn;
  }
}

template <class Real>
void brake(Body<Real>& body, std::uint32_t i, double share, Books& books) {
  assert(share >= 0 && share <= 1);
  const double before = kineticOf(body, i);
  const Vec3<Real> velocity = body.state.velocity[i], spin = body.state.spin[i];
  body.state.velocity[i] *= Real(1 - share);
  body.state.velocityCarry[i] *= Real(1 - share);
  body.state.spin[i] *= Real(1 - share);
  const double taken = before - kineticOf(body, i);
  const Eigen::Vector3d momentum =
      body.constants->mass[i] * (velocity - body.state.velocity[i]).template cast<double>();
  const Eigen::Vector3d angular =
      (body.worldPosition(i) - books.centre).cross(momentum) +
      body.constants->inertia[i] * (spin - body.state.spin[i]).template cast<double>();
  books.slept += taken;
  books.sleptLinear += momentum;
  books.sleptAngular += angular;
  books.kinetic -= taken;
  books.linear -= momentum;
  books.angular -= angular;
}

template <class Real>
void bookSlept(Body<Real>& body, Books& books) {
  for (std::uint32_t i = 0; i < body.elementCount(); ++i)
    if (body.state.alive[i]) brake(body, i, 1, books);
}

template void dampDeformation(Body<float>&, double, double, Books&);
template void dampDeformation(Body<double>&, double, double, Books&);
template void dampDeformation(Body<float>&, std::span<const double>, double, Books&);
template void dampDeformation(Body<double>&, std::span<const double>, double, Books&);
template void brake(Body<float>&, std::uint32_t, double, Books&);
template void brake(Body<double>&, std::uint32_t, double, Books&);
template void bookSlept(Body<float>&, Books&);
template void bookSlept(Body<double>&, Books&);

}  // namespace rubble::edem
