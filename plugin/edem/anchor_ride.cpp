#include "edem/anchor_ride.h"

#include <algorithm>
#include <cassert>

#include "edem/frames.h"

namespace rubble::edem {
namespace {

// Inertia about an axis that a body cannot turn about, over its largest.
constexpr double kFixedInertia = 1e9;

// Where the far ends are by the copy, and how it moves them.
void take(const RigidProxy& proxy, AnchorBase& base) {
  base.at = {proxy.position + proxy.orientation * base.ride.hold.origin,
             (proxy.orientation * base.ride.hold.turn).normalized()};
  base.velocity = {proxy.velocity + proxy.spin.cross(base.at.origin - proxy.position), proxy.spin};
  base.ride.centre = proxy.position;
}

Eigen::Matrix3d inertiaOf(const RigidProxy& proxy) {
  const double free = proxy.inverseInertia.maxCoeff();
  const Eigen::Vector3d inertia = proxy.inverseInertia.unaryExpr(
      [&](double inverse) { return inverse > 0 ? 1 / inverse : kFixedInertia / (free > 0 ? free : 1); });
  const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
  return turn * inertia.asDiagonal() * turn.transpose();
}

// The same about another point.
Wrench moved(const Wrench& wrench, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {wrench.force, wrench.torque + (from - to).cross(wrench.force)};
}

Wrench against(const Wrench& wrench) {
  return {-wrench.force, -wrench.torque};
}

double power(const Wrench& wrench, const Twist& twist) {
  return wrench.force.dot(twist.linear) + wrench.torque.dot(twist.angular);
}

Twist difference(const Twist& a, const Twist& b) {
  return {a.linear - b.linear, a.angular - b.angular};
}

}  // namespace

template <class Real>
bool beginRide(Body<Real>& body, std::span<const RigidProxy> proxies) {
  AnchorBase& base = body.state.base;
  base.ride.place = AnchorRide::kNone;
  if (base.ride.key == 0 || body.state.asleep) return false;
  const auto found = std::find_if(proxies.begin(), proxies.end(),
                                  [&](const RigidProxy& proxy) { return proxy.key == base.ride.key; });
  if (found == proxies.end()) return false;
  base.ride.place = std::uint32_t(found - proxies.begin());
  base.ride.mass = found->isDynamic() ? 1 / found->inverseMass : 0;
  base.ride.inertia = inertiaOf(*found);
  base.way = base.start = base.end = base.mean = {};
  base.target.reset();
  const Twist before = base.velocity;
  take(*found, base);
  base.ride.lost = difference(before, base.velocity);
  writeFarEnds(body);
  return true;
}

template <class Real>
void pullRide(Body<Real>& body, double kick, RigidContacts<Real>& rigid, Books& books) {
  AnchorBase& base = body.state.base;
  if (body.state.anchorsIntact == 0) return;
  const Wrench &all = body.work.base, &damping = body.work.baseDamping;
  const auto onBody = [&](const Wrench& w) {
    return against(moved(w, base.at.origin, rigid.proxies()[base.ride.place].position));
  };
  rigid.pull(base.ride.place, onBody(all), onBody(damping));
  // Up to this instant the copy moved as the last tick left it.
  if (base.ride.lost.isZero()) return;
  books.bullet.work.add(0.5 * kick * power(all, base.ride.lost), 0);
  books.dissipated.add(-0.5 * kick * power(damping, base.ride.lost), 0);
  base.ride.lost = {};
}

template <class Real>
void goWithRide(Body<Real>& body, std::span<const RigidProxy> proxies) {
  take(proxies[body.state.base.ride.place], body.state.base);
  writeFarEnds(body);
}

template <class Real>
void endRide(Body<Real>& body, RigidContacts<Real>& rigid, Books& books) {
  AnchorBase& base = body.state.base;
  const Wrench damped = body.work.dampedByBase;
  if (!damped.force.isZero(0) || !damped.torque.isZero(0)) {
    const RigidProxy& proxy = rigid.proxies()[base.ride.place];
    const Wrench given = moved(damped, base.at.origin, proxy.position);
    const Twist before{proxy.velocity, proxy.spin};
    rigid.push(base.ride.place, against(given));
    const double work =
        0.5 * (power(given, before) + power(given, Twist{proxy.velocity, proxy.spin}));  // as it has lost
    books.bullet.push(1, given.force, proxy.position - books.centre, given.torque);
    books.bullet.work.add(work, 0);
    books.massDamped += work;
    take(proxy, base);
  }
  base.begin = base.at;
  base.end = base.mean = base.velocity;
  base.ride.key = 0;
  base.ride.place = AnchorRide::kNone;
}

template <class Real>
ElementRates rideRates(const Body<Real>& body, const RigidProxy& proxy) {
  const Eigen::Vector3d& turns = proxy.inverseInertia;
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  ElementRates rates;
  for (const std::uint32_t s : body.work.awakeSprings) {
    if (!body.isAnchor(s) || !body.state.intact[s]) continue;
    const Spring<Real>& spring = body.state.springs[s];
    const Eigen::Vector3d at = body.state.origin + body.work.position[spring.first] +
                               (Real(0.5) * spring.rest + spring.offset).template cast<double>();
    const Eigen::Vector3d r2 = (back * (at - proxy.position)).cwiseAbs2();
    // What an impulse there moves that place by at most: by the trace of [r]^T I^-1 [r], or by r^2.
    const double lever = std::min(r2.sum() * turns.maxCoeff(),
                                  turns.dot(Eigen::Vector3d(Eigen::Vector3d::Constant(r2.sum()) - r2)));
    const double mobility = proxy.inverseMass + lever;
    rates.stiffness += double(spring.stiffness) * mobility + double(spring.rotational) * turns.maxCoeff();
    rates.damping += double(spring.damping) * mobility + double(spring.rotationalDamping) * turns.maxCoeff();
  }
  return rates;
}

RigidMotion withBase(const RigidMotion& fragment, const AnchorBase& base) {
  RigidMotion m;
  m.mass = fragment.mass + base.ride.mass;
  const double share = base.ride.mass / m.mass;
  const Eigen::Vector3d velocity = base.velocityAt(base.ride.centre);
  m.centre = fragment.centre + share * (base.ride.centre - fragment.centre);
  m.velocity = fragment.velocity + share * (velocity - fragment.velocity);
  m.angular = fragment.angular + base.ride.inertia * base.velocity.angular;
  m.inertia = fragment.inertia + base.ride.inertia;
  const auto add = [&](double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& v) {
    const Eigen::Vector3d arm = centre - m.centre;
    m.angular += mass * arm.cross(v - m.velocity);
    m.inertia += mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  };
  add(fragment.mass, fragment.centre, fragment.velocity);
  add(base.ride.mass, base.ride.centre, velocity);
  m.spin = m.inertia.ldlt().solve(m.angular);
  return m;
}

template bool beginRide(Body<float>&, std::span<const RigidProxy>);
template bool beginRide(Body<double>&, std::span<const RigidProxy>);
template void pullRide(Body<float>&, double, RigidContacts<float>&, Books&);
template void pullRide(Body<double>&, double, RigidContacts<double>&, Books&);
template void goWithRide(Body<float>&, std::span<const RigidProxy>);
template void goWithRide(Body<double>&, std::span<const RigidProxy>);
template void endRide(Body<float>&, RigidContacts<float>&, Books&);
template void endRide(Body<double>&, RigidContacts<double>&, Books&);
template ElementRates rideRates(const Body<float>&, const RigidProxy&);
template ElementRates rideRates(const Body<double>&, const RigidProxy&);

}  // namespace rubble::edem
