#include "edem/supports.h"

#include <algorithm>

namespace rubble::edem {
namespace {

// Of sequential impulses in a substep; what they leave the next one goes on from.
constexpr int kSweeps = 4;

Eigen::Vector3d turnsBy(const RigidProxy& proxy, const Eigen::Vector3d& twist) {
  return proxy.orientation *
         Eigen::Vector3d(proxy.inverseInertia.cwiseProduct(proxy.orientation.conjugate() * twist));
}

// Of a proxy and what a support of its holds it by.
struct Pair {
  RigidProxy& own;
  RigidProxy* other;  // null: it does not move
  const Support& support;

  Pair(std::span<RigidProxy> proxies, RigidProxy& proxy, const Support& s)
      : own(proxy), other(s.other == Support::kImmovable ? nullptr : &proxies[s.other]), support(s) {}

  // Of the point of the one relative to that of the other.
  Eigen::Vector3d velocity() const {
    Eigen::Vector3d v = own.velocity + own.spin.cross(support.at);
    if (other) v -= other->velocity + other->spin.cross(support.atOther);
    return v;
  }
  // What an impulse of 1 along a unit vector changes of that velocity along it.
  double mobility(const Eigen::Vector3d& way) const {
    double sum = own.inverseMass + way.dot(turnsBy(own, support.at.cross(way)).cross(support.at));
    if (other)
      sum += other->inverseMass + way.dot(turnsBy(*other, support.atOther.cross(way)).cross(support.atOther));
    return sum;
  }
  void push(const Eigen::Vector3d& impulse) {
    pushOne(own, support.at, impulse);
    if (other) pushOne(*other, support.atOther, -impulse);
  }

 private:
  static void pushOne(RigidProxy& proxy, const Eigen::Vector3d& at, const Eigen::Vector3d& impulse) {
    const Eigen::Vector3d twist = at.cross(impulse);
    proxy.velocity += proxy.inverseMass * impulse;
    proxy.spin += turnsBy(proxy, twist);
    proxy.supportImpulse += impulse;
    proxy.supportAngularImpulse += twist;
  }
};

void sweep(std::span<RigidProxy> proxies, RigidProxy& proxy, double step) {
  for (Support& s : proxy.supports) {
    Pair pair(proxies, proxy, s);
    // Bullet puts right what is in each other already.
    const double closing = -s.normal.dot(pair.velocity()) - std::max(0.0, s.gap) / step;
    const double pushed = std::max(0.0, s.pushed + closing / pair.mobility(s.normal));
    pair.push((pushed - s.pushed) * s.normal);
    s.pushed = pushed;
  }
}

void rub(std::span<RigidProxy> proxies, RigidProxy& proxy) {
  for (const Support& s : proxy.supports) {
    if (!(s.pushed > 0)) continue;
    Pair pair(proxies, proxy, s);
    const Eigen::Vector3d velocity = pair.velocity();
    const Eigen::Vector3d sliding = velocity - s.normal.dot(velocity) * s.normal;
    const double speed = sliding.norm();
    if (!(speed > 0)) continue;
    const Eigen::Vector3d way = sliding / speed;
    pair.push(-std::min(s.friction * s.pushed, speed / pair.mobility(way)) * way);
  }
}

}  // namespace

void holdProxies(std::span<RigidProxy> proxies, double step) {
  if (std::ranges::all_of(proxies, [](const RigidProxy& p) { return p.supports.empty(); })) return;
  for (RigidProxy& proxy : proxies)
    for (Support& s : proxy.supports) s.pushed = 0;
  for (int i = 0; i < kSweeps; ++i)
    for (RigidProxy& proxy : proxies) sweep(proxies, proxy, step);
  for (RigidProxy& proxy : proxies) rub(proxies, proxy);
  for (RigidProxy& proxy : proxies)
    for (Support& s : proxy.supports) s.gap += step * s.normal.dot(Pair(proxies, proxy, s).velocity());
}

}  // namespace rubble::edem
