#include "edem/rigid_contacts.h"

#include <algorithm>
#include <cmath>

#include "edem/stable_step.h"

namespace rubble::edem {
namespace {

// Share of m / h^2 that a contact's stiffness may reach against a light rigid body of mass m. 1 lets a body
// of 1e-4 element masses gain energy a hundredfold, 0.02 none (plugin/README.md, "Rigid
// bodies in the substeps").
constexpr double kLightBodyShare = 0.02;

// Surface nearest to a world point over all parts of a proxy.
SurfacePoint nearestPart(const RigidProxy& proxy, const Eigen::Vector3d& world) {
  const Eigen::Vector3d local = proxy.orientation.conjugate() * (world - proxy.position);
  SurfacePoint best{std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitY()};
  for (const Collider& part : proxy.parts) {
    const SurfacePoint s = nearest(part, local);
    if (s.distance < best.distance) best = s;
  }
  best.normal = proxy.orientation * best.normal;
  return best;
}

}  // namespace

Eigen::AlignedBox3d RigidProxy::bounds() const {
  Eigen::AlignedBox3d all;
  const Eigen::Matrix3d turn = orientation.toRotationMatrix();
  for (const Collider& part : parts) {
    const Eigen::AlignedBox3d b = part.bounds();
    if (!b.sizes().allFinite()) return b;
    const Eigen::Vector3d centre = position + turn * b.center(), half = turn.cwiseAbs() * (0.5 * b.sizes());
    all.extend(Eigen::AlignedBox3d(centre - half, centre + half));
  }
  return all;
}

double RigidProxy::reach() const {
  double furthest = 0;
  for (const Collider& part : parts) {
    const Eigen::AlignedBox3d b = part.bounds();
    if (b.sizes().allFinite()) furthest = std::max(furthest, b.center().norm() + 0.5 * b.diagonal().norm());
  }
  return furthest;
}

template <class Real>
void RigidContacts<Real>::beginTick(std::span<RigidProxy> proxies) {
  m_proxies = proxies;
  m_states.resize(proxies.size());
  m_candidates.clear();
  m_touches.clear();
  for (RigidProxy& p : proxies) {
    p.impulse.setZero();
    p.angularImpulse.setZero();
    p.contactPoint.setZero();
    p.contactWeight = 0;
    p.touched.clear();
  }
}

template <class Real>
void RigidContacts<Real>::build(std::span<const std::unique_ptr<Body<Real>>> bodies,
                                const PairLists<Real>& lists) {
  m_candidates.clear();
  for (std::uint32_t p = 0; p < m_proxies.size(); ++p) {
    const RigidProxy& proxy = m_proxies[p];
    m_states[p].listedPosition = proxy.position;
    m_states[p].listedOrientation = proxy.orientation;
    const Eigen::AlignedBox3d bounds = proxy.bounds();
    for (std::uint32_t b = 0; b < bodies.size(); ++b) {
      const Body<Real>& body = *bodies[b];
      if (body.asleep) continue;
      // From now on the element may move a whole skin (from one side of its listed place to the other) and
      // the proxy half.
      const double reach = double(body.radius) + 1.5 * lists.skin();
      const auto consider = [&](std::uint32_t i) {
        if (!body.alive[i]) return;
        const Eigen::Vector3d x = body.origin + body.position[i].template cast<double>();
        if (nearestPart(proxy, x).distance < reach) m_candidates.push_back({p, b, i});
      };
      const double listedReach = reach + 0.5 * lists.skin();
      Eigen::AlignedBox3d grown(bounds.min().array() - listedReach, bounds.max().array() + listedReach);
      if (!grown.intersects(lists.grid(b).bounds)) continue;
      grown = grown.intersection(lists.grid(b).bounds);
      const Vec3<Real> low = (grown.min() - body.origin).template cast<Real>();
      const Vec3<Real> high = (grown.max() - body.origin).template cast<Real>();
      const Grid<Real>& grid = lists.grid(b).grid;
      if (grid.cellsIn(low, high) > double(body.elementCount())) {
        for (std::uint32_t i = 0; i < body.elementCount(); ++i) consider(i);
      } else {
        grid.visitBox(low, high, consider);
      }
    }
  }
}

template <class Real>
bool RigidContacts<Real>::expired(double skin) const {
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    const RigidProxy& proxy = m_proxies[p];
    const double angle = m_states[p].listedOrientation.angularDistance(proxy.orientation);
    if ((proxy.position - m_states[p].listedPosition).norm() + angle * proxy.reach() > 0.5 * skin)
      return true;
  }
  return false;
}

template <class Real>
double RigidContacts<Real>::contactStiffness(const RigidProxy& proxy, const Body<Real>& body,
                                             double step) const {
  if (!proxy.isDynamic()) return body.contactStiffness;
  return std::min(body.contactStiffness, kLightBodyShare / (proxy.inverseMass * step * step));
}

template <class Real>
bool RigidContacts<Real>::touch(RigidProxy& proxy, Body<Real>& body, std::uint32_t element, double kick,
                                Touch& out, Eigen::Vector3d& at) const {
  if (!body.alive[element]) return false;
  const Eigen::Vector3d x = body.origin + body.position[element].template cast<double>();
  const SurfacePoint surface = nearestPart(proxy, x);
  double range = double(body.radius);
  Real& own = body.groundRange[element];
  if (!proxy.isDynamic()) {
    if (own == Real(kHeldByAnchor)) return false;
    const Real distance = Real(std::clamp(surface.distance, 0.0, range));
    own = own == Real(kJustReleased) ? distance : std::max(own, distance);
    range = double(own);
  }
  const double overlap = range - surface.distance;
  if (!(overlap > 0)) return false;

  at = x - surface.normal * (surface.distance + 0.5 * overlap);
  const Eigen::Vector3d arm = at - x;
  const Eigen::Vector3d velocity =
      body.velocity[element].template cast<double>() + body.spin[element].template cast<double>().cross(arm);
  const Eigen::Vector3d surfaceVelocity = proxy.velocity + proxy.spin.cross(at - proxy.position);
  const double reduced = 1 / (double(body.inverseMass[element]) + proxy.inverseMass);
  ContactLaw<double> law;
  law.stiffness = contactStiffness(proxy, body, kick);
  law.damping = dashpot(body.material.contactDamping, law.stiffness, reduced);
  law.friction = body.model.coulombFriction ? proxy.friction * body.material.friction : -1.0;
  const ContactForce<double> force =
      contactForce<double>(law, overlap, surface.normal, velocity - surfaceVelocity);
  out.element = element;
  out.force = force.elastic + force.damping;
  out.torque = arm.cross(out.force);
  return true;
}

template <class Real>
void RigidContacts<Real>::accumulate(std::span<const std::unique_ptr<Body<Real>>> bodies, double kick,
                                     Books& books) {
  m_touches.clear();
  for (ProxyState& s : m_states) s.force = s.torque = Eigen::Vector3d::Zero();
  for (const Candidate& c : m_candidates) {
    Body<Real>& body = *bodies[c.body];
    RigidProxy& proxy = m_proxies[c.proxy];
    Touch t;
    Eigen::Vector3d at;
    if (!touch(proxy, body, c.element, kick, t, at)) continue;
    t.body = c.body;
    // The element gets the force in its own scalar; what is booked and given to the rigid body is exactly
    // that.
    const Vec3<Real> force = t.force.template cast<Real>(), torque = t.torque.template cast<Real>();
    t.force = force.template cast<double>();
    t.torque = torque.template cast<double>();
    body.force[c.element] += force;
    body.torque[c.element] += torque;
    m_touches.push_back(t);

    const Eigen::Vector3d x = body.origin + body.position[c.element].template cast<double>();
    m_states[c.proxy].force -= t.force;
    m_states[c.proxy].torque -= (x - proxy.position).cross(t.force) + t.torque;
    const double size = kick * t.force.norm();
    proxy.contactPoint += size * at;
    proxy.contactWeight += size;
    if (std::find(proxy.touched.begin(), proxy.touched.end(), body.id) == proxy.touched.end())
      proxy.touched.push_back(body.id);
    books.bullet.push(kick, t.force, x - books.centre, t.torque);
    books.bullet.work.add(0.5 * kick *
                              (t.force.dot(body.velocity[c.element].template cast<double>()) +
                               t.torque.dot(body.spin[c.element].template cast<double>())),
                          0);
  }
}

template <class Real>
void RigidContacts<Real>::bookSecondHalf(std::span<const std::unique_ptr<Body<Real>>> bodies, double kick,
                                         Books& books) const {
  for (const Touch& t : m_touches) {
    const Body<Real>& body = *bodies[t.body];
    books.bullet.work.add(0, 0.5 * kick *
                                 (t.force.dot(body.velocity[t.element].template cast<double>()) +
                                  t.torque.dot(body.spin[t.element].template cast<double>())));
  }
}

template <class Real>
void RigidContacts<Real>::integrate(double kick, double step) {
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    RigidProxy& proxy = m_proxies[p];
    const ProxyState& state = m_states[p];
    proxy.impulse += kick * state.force;
    proxy.angularImpulse += kick * state.torque;
    if (proxy.isDynamic()) {
      const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
      proxy.velocity += kick * (proxy.inverseMass * state.force + proxy.acceleration);
      proxy.spin += kick * (turn * (proxy.inverseInertia.asDiagonal() * (turn.transpose() * state.torque)) +
                            proxy.angularAcceleration);
    }
    proxy.position += step * proxy.velocity;
    const double angle = proxy.spin.norm() * step;
    if (angle > 0)
      proxy.orientation =
          (Eigen::Quaterniond(Eigen::AngleAxisd(angle, proxy.spin.normalized())) * proxy.orientation)
              .normalized();
  }
}

template <class Real>
void RigidContacts<Real>::addRates(const Body<Real>& body, std::uint32_t place, double step,
                                   std::span<ElementRates> rates) const {
  for (const Candidate& c : m_candidates) {
    if (c.body != place) continue;
    const RigidProxy& proxy = m_proxies[c.proxy];
    const double k = contactStiffness(proxy, body, step);
    const double inverse = double(body.inverseMass[c.element]);
    rates[c.element].stiffness += k * inverse;
    rates[c.element].damping +=
        dashpot(body.material.contactDamping, k, 1 / (inverse + proxy.inverseMass)) * inverse;
  }
}

template <class Real>
double RigidContacts<Real>::maxSpeed() const {
  double fastest = 0;
  for (const RigidProxy& p : m_proxies)
    fastest = std::max(fastest, p.velocity.norm() + p.spin.norm() * p.reach());
  return fastest;
}

template class RigidContacts<float>;
template class RigidContacts<double>;

}  // namespace rubble::edem
