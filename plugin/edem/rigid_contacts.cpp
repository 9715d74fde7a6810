#include "edem/rigid_contacts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "edem/fragment_motion.h"
#include "edem/step_length.h"

namespace rubble::edem {
namespace {

// A light rigid body at many elements is faster than they are: up to this multiple of their frequency^2 the
// substep follows it, beyond it its contacts are made softer.
constexpr double kLightBodyRate = 4;
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
void RigidContacts<Real>::beginTick(std::span<RigidProxy> proxies, Books& books) {
  keepContacts();
  m_proxies = proxies;
  std::swap(m_before, m_states);
  m_states.assign(proxies.size(), {});
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    RigidProxy& proxy = proxies[p];
    ProxyState& state = m_states[p];
    state.key = proxy.key != 0 ? proxy.key : p + 1;
    const auto before = std::find_if(m_before.begin(), m_before.end(),
                                     [&](const ProxyState& s) { return s.key == state.key; });
    proxy.given = proxy.surplus = 0;
    if (before != m_before.end()) {
      before->shift = state.shift = proxy.position - before->position;
      const Eigen::AngleAxisd turn(proxy.orientation * before->orientation.conjugate());
      before->turn = state.turn = turn.angle() * turn.axis();
      state.shifted = true;
      state.pressed = before->size;
      state.surplusNext = before->surplusNext;
      bookShift(*before, proxy, books);
    }
    proxy.impulse.setZero();
    proxy.angularImpulse.setZero();
    proxy.contactPoint.setZero();
    proxy.contactWeight = 0;
    proxy.touched.clear();
  }
}

// Between two ticks the host's own contacts and joints move a body. What that does to the springs of its
// contacts is work of the host: half of it at the forces before, half at those after.
template <class Real>
void RigidContacts<Real>::bookShift(const ProxyState& state, RigidProxy& proxy, Books& books) const {
  const Eigen::Vector3d force = state.force - state.dampingForce, torque = state.torque - state.dampingTorque;
  const double work = -0.5 * (force.dot(state.shift) + torque.dot(state.turn));
  books.bullet.work.add(work, 0);
  proxy.surplus -= work;
}

template <class Real>
void RigidContacts<Real>::keepContacts() {
  for (const Candidate& c : m_candidates)
    if (c.touching || c.memory.range > 0)
      m_kept.push_back({m_states[c.proxy].key, m_ids[c.body], c.element, c.memory, c.energy, c.touching});
  m_candidates.clear();
}

template <class Real>
void RigidContacts<Real>::remember(Candidate& candidate) {
  const Kept wanted{m_states[candidate.proxy].key, m_ids[candidate.body], candidate.element, {}, 0, false};
  const auto found = std::lower_bound(m_kept.begin(), m_kept.end(), wanted,
                                      [](const Kept& a, const Kept& b) { return a.name() < b.name(); });
  if (found == m_kept.end() || found->name() != wanted.name()) return;
  candidate.touching = found->touching;
  candidate.memory = found->memory;
  candidate.energy = found->energy;
  found->taken = true;
}

// What did not come back into the lists has ended, unless its body sleeps.
template <class Real>
void RigidContacts<Real>::endContacts(Bodies bodies) {
  const auto asleep = [&](std::uint32_t id) {
    return std::any_of(bodies.begin(), bodies.end(),
                       [id](const auto& b) { return b->id == id && b->asleep; });
  };
  std::erase_if(m_kept, [&](const Kept& k) {
    if (!k.taken && asleep(k.body)) return false;
    if (!k.taken) m_lost += k.energy;
    return true;
  });
}

template <class Real>
void RigidContacts<Real>::build(Bodies bodies, const PairLists<Real>& lists) {
  keepContacts();
  std::sort(m_kept.begin(), m_kept.end(), [](const Kept& a, const Kept& b) { return a.name() < b.name(); });
  m_ids.clear();
  for (const auto& body : bodies) m_ids.push_back(body->id);
  for (std::uint32_t p = 0; p < m_proxies.size(); ++p) {
    m_states[p].listedPosition = m_proxies[p].position;
    m_states[p].listedOrientation = m_proxies[p].orientation;
    for (std::uint32_t b = 0; b < bodies.size(); ++b)
      if (!bodies[b]->asleep) listNear(p, b, *bodies[b], lists);
  }
  endContacts(bodies);
  weigh(bodies);
}

template <class Real>
void RigidContacts<Real>::listNear(std::uint32_t p, std::uint32_t place, const Body<Real>& body,
                                   const PairLists<Real>& lists) {
  const RigidProxy& proxy = m_proxies[p];
  const ElementGrid& own = lists.grid(place);
  // From now on the element may move a whole skin (from one side of its listed place to the other) and the
  // proxy half.
  const double reach = double(body.radius) + 1.5 * lists.skin();
  const auto grown = [](const Eigen::AlignedBox3d& box, double by) {
    return Eigen::AlignedBox3d(box.min().array() - by, box.max().array() + by);
  };
  Eigen::AlignedBox3d box = grown(proxy.bounds(), reach + 0.5 * lists.skin());
  if (!box.intersects(own.bounds)) return;
  // Grown again, for the box of a single element or of a flat layer has no volume for rounding to miss.
  box = grown(box.intersection(own.bounds), 0.25 * lists.skin());

  const std::size_t begin = m_candidates.size();
  const auto consider = [&](std::uint32_t i) {
    if (!body.alive[i]) return;
    if (body.anchored[i] && proxy.isStatic()) return;  // it stands on that by its anchor
    const Eigen::Vector3d x = body.origin + body.position[i];
    if (nearestPart(proxy, x).distance >= reach) return;
    Candidate candidate{p, place, i, false, {}, 0};
    remember(candidate);
    m_candidates.push_back(candidate);
  };
  const Vec3<double> low = box.min() - body.origin, high = box.max() - body.origin;
  if (own.grid.cellsIn(low, high) > double(body.elementCount())) {
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) consider(i);
  } else {
    own.grid.visitBox(low, high, consider);
  }
  std::sort(m_candidates.begin() + std::ptrdiff_t(begin), m_candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.element < b.element; });
}

// The mobility of each rigid body at its candidates, and the laws of contacts with it. An impulse J at a
// point r from the centre moves that point by at most (1/m + r^2 / I) J.
template <class Real>
void RigidContacts<Real>::weigh(Bodies bodies) {
  m_sides.clear();
  for (const auto& body : bodies) m_sides.push_back(body->contact);
  for (ProxyState& s : m_states) s.mobility = s.rate = 0;
  for (const Candidate& c : m_candidates) {
    const RigidProxy& proxy = m_proxies[c.proxy];
    if (!proxy.isDynamic()) continue;
    const Body<Real>& body = *bodies[c.body];
    const Eigen::Vector3d x = body.origin + body.position[c.element];
    const double mobility =
        proxy.inverseMass + (x - proxy.position).squaredNorm() * proxy.inverseInertia.maxCoeff();
    m_states[c.proxy].mobility += mobility;
    m_states[c.proxy].rate += mobility * body.contact.stiffness;
  }
  soften(std::numeric_limits<double>::infinity());
}

template <class Real>
void RigidContacts<Real>::soften(double frequency2) {
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    ProxyState& state = m_states[p];
    const double allowed = kLightBodyRate * frequency2;
    const double share = state.rate > allowed ? allowed / state.rate : 1;
    state.laws.clear();
    state.rates = {share * state.rate, 0};
    for (ContactSide side : m_sides) {
      const double friction = side.friction < 0 ? side.friction : side.friction * m_proxies[p].friction;
      side.stiffness *= share;
      ContactSide rigid = side;
      rigid.mobility = state.mobility;
      rigid.turning = rigid.radius = 0;
      rigid.restitution = m_proxies[p].restitution;
      state.laws.push_back(contactLaw(side, rigid));
      state.laws.back().friction = friction;
      const ContactLaw<double>& law = state.laws.back();
      state.rates.damping =
          std::max(state.rates.damping, state.mobility * std::max(law.damping, law.tangentialDamping));
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
bool RigidContacts<Real>::touch(Candidate& c, const Body<Real>& body, const Steps& steps, Touch& out) const {
  const std::uint32_t i = c.element;
  if (!body.alive[i]) return false;
  const RigidProxy& proxy = m_proxies[c.proxy];
  out.x = body.origin + body.position[i];
  const SurfacePoint surface = nearestPart(proxy, out.x);
  const double radius = double(body.radius);
  if (surface.distance >= radius) {
    c.memory.range = 0;
    if (!c.touching) return false;
  }
  out.at = out.x - 0.5 * (surface.distance + radius) * surface.normal;
  const Eigen::Vector3d arm = out.at - out.x;
  const Eigen::Vector3d spin = body.spin[i].template cast<double>();
  ContactMotion<double> motion;
  motion.normal = surface.normal;
  motion.approach = body.velocity[i].template cast<double>() + spin.cross(arm) - proxy.velocity -
                    proxy.spin.cross(out.at - proxy.position);
  motion.spin = spin - proxy.spin;
  // Shifted by a radius, so that distances and ranges stay above 0 down to a radius below the surface;
  // deeper, a contact is seen anew in every step and gives next to no force.
  if (surface.distance < radius) {
    c.memory.range = contactRange(c.memory.range, surface.distance + radius, 2 * radius,
                                  motion.approach.norm(), steps.moved);
    motion.overlap = c.memory.range - surface.distance - radius;
  }
  const ContactLaw<double>& law = m_states[c.proxy].laws[c.body];
  if (!(motion.overlap > 0)) {
    if (c.touching) out.slipped = lostAtParting(law, motion.approach, motion.spin, steps.moved, c.memory);
    return false;
  }
  const double speed = -motion.approach.dot(motion.normal);
  if (steps.moved > 0) c.memory.onset = c.touching ? 1 : onsetShare(motion.overlap, speed, steps.moved);
  motion.share = touchShare(motion.overlap, speed, steps.next, c.memory.onset);
  const FragmentMotion& fragment = body.motions[body.motionOf[i]];
  const double parting =
      (fragment.velocityAt(out.at) - proxy.velocity - proxy.spin.cross(out.at - proxy.position))
          .dot(motion.normal);
  motion.withheld = withheld(
      law.inelastic, parting,
      steps.next * (fragment.pressed * fragment.inverseMass + m_states[c.proxy].pressed * proxy.inverseMass));

  const ContactLoad<double> load = contactLoad(law, motion, steps.moved, c.memory);
  // The element gets the load in its own scalar; what is booked and given to the rigid body is exactly that.
  const auto rounded = [](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return v.cast<Real>().template cast<double>();
  };
  out.force = rounded(load.elastic + load.damping);
  out.torque = rounded(arm.cross(load.elastic + load.damping) + load.elasticTorque + load.dampingTorque);
  out.dampingForce = rounded(load.damping);
  out.dampingTorque = rounded(arm.cross(load.damping) + load.dampingTorque);
  out.energy = load.energy;
  out.slipped = load.slipped;
  out.power = load.elastic.dot(motion.approach) + load.elasticTorque.dot(motion.spin);
  return true;
}

template <class Real>
void RigidContacts<Real>::add(const Touch& t, const Candidate& c, Body<Real>& body, double sign) {
  const auto to = [sign](const Eigen::Vector3d& v) -> Vec3<Real> { return (sign * v).cast<Real>(); };
  body.force[c.element] += to(t.force);
  body.torque[c.element] += to(t.torque);
  body.dampingForce[c.element] += to(t.dampingForce);
  body.dampingTorque[c.element] += to(t.dampingTorque);
  ProxyState& state = m_states[c.proxy];
  const Eigen::Vector3d arm = t.x - m_proxies[c.proxy].position;
  state.force -= sign * t.force;
  state.torque -= sign * (arm.cross(t.force) + t.torque);
  state.dampingForce -= sign * t.dampingForce;
  state.dampingTorque -= sign * (arm.cross(t.dampingForce) + t.dampingTorque);
  state.size += sign * t.force.norm();
  Push& push = m_pushes.emplace_back(c.proxy, c.body, c.element, sign * t.force, sign * t.torque);
  push.before = pushPower(push, body);
}

// What an element gets of a push, by its velocity as it is [W].
template <class Real>
double RigidContacts<Real>::pushPower(const Push& push, const Body<Real>& body) const {
  return push.force.dot(body.velocity[push.element].template cast<double>()) +
         push.torque.dot(body.spin[push.element].template cast<double>());
}

template <class Real>
void RigidContacts<Real>::accumulate(Bodies bodies, const Steps& steps, double kick, Books& books) {
  for (ProxyState& s : m_states) {
    s.force = s.torque = s.dampingForce = s.dampingTorque = Eigen::Vector3d::Zero();
    s.pressed = std::exchange(s.size, 0);
  }
  m_pushes.clear();
  m_elastic = 0;
  for (const Kept& k : m_kept) m_elastic += k.energy;
  for (std::size_t p = 0; p < m_proxies.size(); ++p)
    m_proxies[p].surplus += std::exchange(m_states[p].surplusNext, 0);
  double slipped = std::exchange(m_lost, 0);
  for (Candidate& c : m_candidates) {
    Body<Real>& body = *bodies[c.body];
    RigidProxy& proxy = m_proxies[c.proxy];
    Touch t;
    if (!touch(c, body, steps, t)) {
      if (c.touching) {
        slipped += t.slipped;
        part(c.memory);
        c.touching = false;
        c.energy = 0;
      }
      continue;
    }
    if (!std::exchange(c.touching, true)) ++body.touchesBegun[c.element];
    c.energy = t.energy;
    m_elastic += t.energy;
    slipped += t.slipped;
    add(t, c, body, 1);
    pushMotion(body, c.element, t.x, t.force, t.torque);
    const double size = kick * t.force.norm();
    proxy.contactPoint += size * t.at;
    proxy.contactWeight += size;
    if (std::find(proxy.touched.begin(), proxy.touched.end(), body.id) == proxy.touched.end())
      proxy.touched.push_back(body.id);
  }
  books.dissipated.add(-slipped, 0);
  for (std::size_t p = 0; p < m_proxies.size(); ++p)
    if (std::exchange(m_states[p].shifted, false)) bookShift(m_states[p], m_proxies[p], books);
}

template <class Real>
void RigidContacts<Real>::release(Bodies bodies, double step, double kick, Books& books) {
  for (Candidate& c : m_candidates) {
    Body<Real>& body = *bodies[c.body];
    if (!c.touching || !body.leaving[c.element]) continue;
    Touch t;
    if (!touch(c, body, {0, step}, t)) continue;
    add(t, c, body, -1);
    m_elastic -= t.energy;
    books.elastic -= t.energy;
    books.fracture += t.energy + 0.5 * kick * t.power;
    c = {c.proxy, c.body, c.element, false, {}, 0};
  }
}

template <class Real>
void RigidContacts<Real>::integrate(Bodies bodies, double kick, double step, Books& books) {
  for (const Push& push : m_pushes) {
    m_proxies[push.proxy].surplus += 0.5 * kick * push.before;
    m_states[push.proxy].surplusNext += 0.5 * kick * pushPower(push, *bodies[push.body]);
  }
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    RigidProxy& proxy = m_proxies[p];
    const ProxyState& state = m_states[p];
    proxy.impulse += kick * state.force;
    proxy.angularImpulse += kick * state.torque;
    // What the elements and the contacts' springs get is what the rigid body does, by its own motion: a body
    // that does not move gives nothing.
    const auto power = [&](const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
      return 0.5 * kick * (force.dot(proxy.velocity) + torque.dot(proxy.spin));
    };
    const double given = -power(state.force, state.torque),
                 lost = power(state.dampingForce, state.dampingTorque);
    books.bullet.linear -= kick * state.force;
    books.bullet.angular -= kick * ((proxy.position - books.centre).cross(state.force) + state.torque);
    books.bullet.size += kick * state.size;
    if (proxy.isDynamic()) {
      const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
      proxy.velocity += kick * (proxy.inverseMass * state.force + proxy.acceleration);
      proxy.spin += kick * (turn * (proxy.inverseInertia.asDiagonal() * (turn.transpose() * state.torque)) +
                            proxy.angularAcceleration);
    }
    const double givenNext = -power(state.force, state.torque);
    books.bullet.work.add(given, givenNext);
    proxy.given += given + givenNext;
    proxy.surplus -= given;
    m_states[p].surplusNext -= givenNext;
    books.dissipated.add(lost, power(state.dampingForce, state.dampingTorque));
    proxy.position += step * proxy.velocity;
    const double angle = proxy.spin.norm() * step;
    if (angle > 0)
      proxy.orientation =
          (Eigen::Quaterniond(Eigen::AngleAxisd(angle, proxy.spin.normalized())) * proxy.orientation)
              .normalized();
    m_states[p].position = proxy.position;
    m_states[p].orientation = proxy.orientation;
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
