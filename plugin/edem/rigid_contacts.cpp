#include "edem/rigid_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "edem/edge_points.h"
#include "edem/fragment_motion.h"

namespace rubble::edem {
namespace {

// A point of an edge stays with the cell that it was in until it is deeper in another by this, over h. Points
// lie on the borders of cells by rows, and where two cells tremble each change of cells would tell.
constexpr double kStays = 0.01;

RigidPose poseNow(const RigidProxy& proxy) {
  return {proxy.position, proxy.velocity, proxy.spin, proxy.orientation};
}

// Of its surface, beside a drift [m/s].
double speedOf(const RigidProxy& proxy, const Eigen::Vector3d& drift) {
  return (proxy.velocity - drift).norm() + proxy.spin.norm() * proxy.reach();
}

void setPose(RigidProxy& proxy, const RigidPose& pose) {
  proxy.position = pose.position;
  proxy.velocity = pose.velocity;
  proxy.spin = pose.spin;
  proxy.orientation = pose.orientation;
}

}  // namespace

template <class Real>
void RigidContacts<Real>::beginTick(std::span<RigidProxy> proxies) {
  keepContacts();
  m_proxies = proxies;
  std::swap(m_before, m_states);
  m_states.assign(proxies.size(), {});
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    RigidProxy& proxy = proxies[p];
    RigidState& state = m_states[p];
    state.key = proxy.key != 0 ? proxy.key : p + 1;
    const auto before = std::find_if(m_before.begin(), m_before.end(),
                                     [&](const RigidState& s) { return s.key == state.key; });
    proxy.given = proxy.givenNext = proxy.surplus = 0;
    if (before != m_before.end()) {
      state.left = before->left;
      state.moved = true;
      state.still = !proxy.isDynamic() && proxy.velocity.isZero(0) && proxy.spin.isZero(0) &&
                    proxy.position == before->left.position &&
                    proxy.orientation.coeffs() == before->left.orientation.coeffs();
      state.pressed = before->size;
      state.surplusNext = before->surplusNext;
      state.corners = std::move(before->corners);
    }
    proxy.impulse.setZero();
    proxy.angularImpulse.setZero();
    proxy.contactPoint.setZero();
    proxy.contactWeight = 0;
    proxy.touched.clear();
  }
}

template <class Real>
void RigidContacts<Real>::keepContacts() {
  for (const RigidContact& c : m_contacts)
    if (c.touching || c.memory.range > 0 || c.faces.deepest > 0)
      m_kept.push_back({m_states[c.proxy].key, m_ids[c.body], c.element, c.memory, c.faces, c.touching});
  m_contacts.clear();
}

template <class Real>
void RigidContacts<Real>::remember(RigidContact& candidate) {
  const Kept wanted{m_states[candidate.proxy].key, m_ids[candidate.body], candidate.element, {}, {}, false};
  const auto found = std::lower_bound(m_kept.begin(), m_kept.end(), wanted,
                                      [](const Kept& a, const Kept& b) { return a.name() < b.name(); });
  if (found == m_kept.end() || found->name() != wanted.name()) return;
  candidate.touching = found->touching;
  candidate.memory = found->memory;
  candidate.faces = found->faces;
  found->taken = true;
}

// What did not come back into the lists has ended, unless its body or element sleeps.
template <class Real>
void RigidContacts<Real>::endContacts(Bodies bodies) {
  const auto asleep = [&](const Kept& k) {
    return std::any_of(bodies.begin(), bodies.end(), [&k](const auto& b) {
      return b->id == k.body && (b->state.asleep || b->state.sleeping[k.element]);
    });
  };
  std::erase_if(m_kept, [&](const Kept& k) {
    if (!k.taken && asleep(k)) return false;
    if (!k.taken) m_lost += k.memory.energy;
    return true;
  });
}

template <class Real>
double RigidContacts<Real>::endContactsOf(std::uint32_t id) {
  double energy = 0;
  std::erase_if(m_contacts, [&](const RigidContact& c) {
    if (m_ids[c.body] != id) return false;
    energy += c.memory.energy;
    return true;
  });
  std::erase_if(m_kept, [&](const Kept& k) {
    if (k.body != id) return false;
    energy += k.memory.energy;
    return true;
  });
  // It may come back under the same name, elsewhere.
  for (RigidState& state : m_states) state.corners.forget(id);
  m_elastic -= energy;
  return energy;
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
      if (!bodies[b]->state.asleep) listNear(p, b, *bodies[b], lists);
  }
  endContacts(bodies);
  m_sides.clear();
  for (const auto& body : bodies) m_sides.push_back(body->constants->contact);
  for (RigidContact& c : m_contacts) c.exposed = -1;
  weigh(bodies);
}

// From the listing on, an element may move a whole skin (from one side of its listed place to the other) and
// the proxy half.
template <class Real>
double RigidContacts<Real>::away(const PairLists<Real>& lists) {
  return 1.5 * lists.skin();
}

template <class Real>
template <class Visit>
void RigidContacts<Real>::visitNear(std::uint32_t p, std::uint32_t place, const Body<Real>& body,
                                    bool sleeping, const PairLists<Real>& lists, Visit&& visit) const {
  const RigidProxy& proxy = m_proxies[p];
  if (std::find(proxy.spared.begin(), proxy.spared.end(), body.id) != proxy.spared.end()) return;
  const ElementGrid& own = lists.grid(place);
  const double reach = body.reach() + away(lists);
  const auto grown = [](const Eigen::AlignedBox3d& box, double by) {
    return Eigen::AlignedBox3d(box.min().array() - by, box.max().array() + by);
  };
  Eigen::AlignedBox3d box = grown(proxy.bounds(), reach + 0.5 * lists.skin());
  if (!box.intersects(own.bounds)) return;
  // Grown again, for the box of a single element or of a flat layer has no volume for rounding to miss.
  box = grown(box.intersection(own.bounds), 0.25 * lists.skin());

  const bool bears = std::find(proxy.bears.begin(), proxy.bears.end(), body.id) != proxy.bears.end();
  const auto consider = [&](std::uint32_t i) {
    if (!body.state.alive[i] || bool(body.state.sleeping[i]) != sleeping) return;
    if (body.state.anchored[i] && proxy.isStatic()) return;  // it stands on that by its anchor
    if (bears && body.work.motions[body.work.motionOf[i]].fixed) return;
    const Eigen::Vector3d x = body.state.origin + body.work.position[i];
    const double near = body.constants->cells ? body.constants->cells->reach[i] + away(lists) : reach;
    const double distance = nearest(proxy, x, near).distance;
    if (distance < near) visit(i, x, distance);
  };
  const Vec3<double> low = box.min() - body.state.origin, high = box.max() - body.state.origin;
  const double gridCells = own.grid.cellsIn(low, high);
  if (!sleeping && gridCells > double(body.work.awake.size())) {
    for (const std::uint32_t i : body.work.awake) consider(i);
  } else if (gridCells > double(body.elementCount())) {
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) consider(i);
  } else {
    own.grid.visitBox(low, high, consider);
  }
}

template <class Real>
void RigidContacts<Real>::listNear(std::uint32_t p, std::uint32_t place, const Body<Real>& body,
                                   const PairLists<Real>& lists) {
  const RigidProxy& proxy = m_proxies[p];
  const std::size_t begin = m_contacts.size();
  visitNear(p, place, body, false, lists, [&](std::uint32_t i, const Eigen::Vector3d& x, double distance) {
    RigidContact candidate;
    candidate.proxy = p;
    candidate.body = place;
    candidate.element = i;
    if (body.constants->cells) {
      const Eigen::Vector3d at = proxy.orientation.conjugate() * (x - proxy.position);
      const double size = body.constants->cells->reach[i];
      candidate.edges = edgeWeights(proxy, *body.constants->cells, at, size, size + away(lists));
      candidate.balls = candidate.edges + ballWeights(proxy, at, size + away(lists));
      candidate.core = distance < body.constants->cells->core[i] + away(lists);
    }
    remember(candidate);
    m_contacts.push_back(candidate);
  });
  std::sort(m_contacts.begin() + std::ptrdiff_t(begin), m_contacts.end(),
            [](const RigidContact& a, const RigidContact& b) { return a.element < b.element; });
}

template <class Real>
void RigidContacts<Real>::visitDisturbed(Bodies bodies, const PairLists<Real>& lists,
                                         const VisitElement& visit) const {
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const Body<Real>& body = *bodies[b];
    if (body.state.sleepingCount == 0 || body.state.asleep) continue;
    const auto visitSleeping = [&](std::uint32_t i) {
      if (body.state.sleeping[i]) visit(b, i);
    };
    for (std::uint32_t p = 0; p < m_proxies.size(); ++p)
      if (!m_states[p].still)
        visitNear(p, b, body, true, lists,
                  [&](std::uint32_t i, const Eigen::Vector3d&, double) { visit(b, i); });
    for (const Kept& k : m_kept) {
      const auto isThere = [&k](const RigidState& s) { return s.key == k.key; };
      if (k.body == body.id && std::none_of(m_states.begin(), m_states.end(), isThere))
        visitSleeping(k.element);
    }
  }
}

template <class Real>
void RigidContacts<Real>::visitAtMoving(const VisitElement& visit) const {
  for (const RigidContact& c : m_contacts)
    if (c.touching && !m_states[c.proxy].still) visit(c.body, c.element);
}

template <class Real>
void RigidContacts<Real>::weigh(Bodies bodies) {
  bool same = true;
  for (RigidContact& c : m_contacts) {
    const Body<Real>& body = *bodies[c.body];
    if (!body.constants->cells) {
      same = same && c.weight == 1;
      c.weight = 1;
    } else if (c.exposed != body.state.exposure.area[c.element]) {
      same = false;
      weighFaces(c, body, m_proxies[c.proxy], m_faces);
    }
  }
  if (same && !m_contacts.empty()) return;
  for (RigidState& s : m_states) s.mobility = s.rate = s.edgeRate = s.edgeMost = 0;
  for (const RigidContact& c : m_contacts)
    addMobility(c, *bodies[c.body], m_proxies[c.proxy], m_states[c.proxy]);
  for (std::size_t p = 0; p < m_proxies.size(); ++p) addEdges(m_proxies[p], m_states[p]);
  soften(std::numeric_limits<double>::infinity());
}

template <class Real>
void RigidContacts<Real>::soften(double frequency2) {
  for (std::size_t p = 0; p < m_proxies.size(); ++p) setLaws(m_sides, m_proxies[p], frequency2, m_states[p]);
}

template <class Real>
bool RigidContacts<Real>::expired(double skin, std::span<const Drift> drifts) const {
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    const RigidProxy& proxy = m_proxies[p];
    const double angle = m_states[p].listedOrientation.angularDistance(proxy.orientation);
    const Eigen::Vector3d moved = proxy.position - m_states[p].listedPosition - drifts[p].moved;
    if (moved.norm() + angle * proxy.reach() > 0.5 * skin) return true;
  }
  return false;
}

// Which corners of the proxies press which elements in this substep.
template <class Real>
void RigidContacts<Real>::findAllCorners(Bodies bodies) {
  m_cornersLeft.clear();
  const auto moved = [](const RigidState& s) { return s.moved; };
  if (std::any_of(m_states.begin(), m_states.end(), moved)) {
    const auto swap = [&] {
      for (std::size_t p = 0; p < m_proxies.size(); ++p) {
        if (!m_states[p].moved) continue;
        const RigidPose now = poseNow(m_proxies[p]);
        setPose(m_proxies[p], std::exchange(m_states[p].left, now));
      }
    };
    swap();
    findAllCorners(bodies, m_cornersLeft);
    swap();
  }
  findAllCorners(bodies, m_corners);
}

template <class Real>
void RigidContacts<Real>::findAllCorners(Bodies bodies, CornerHits& corners) {
  corners.clear();
  for (const RigidContact& c : m_contacts) {
    if (!bodies[c.body]->constants->cells || !(c.balls > 0)) continue;
    findCorners(*bodies[c.body], c.element, m_proxies[c.proxy], m_faces);
    const Body<Real>& body = *bodies[c.body];
    const double favour = kStays * std::sqrt(body.constants->cells->unit);
    corners.add(c.proxy, placeOf(c), m_faces.hits(), favour, [&](const FaceHit& hit) {
      return m_states[c.proxy].corners.wasIn(hit.corner, body.id, c.element);
    });
  }
  corners.settle();
}

template <class Real>
bool RigidContacts<Real>::touch(RigidContact& c, const Body<Real>& body, const CornerHits& corners,
                                const Steps& steps, RestingLoads& resting, RigidTouch& out) {
  return touchRigid(c, body, {m_proxies[c.proxy], m_states[c.proxy]}, corners.of(placeOf(c)),
                    {steps, m_moved, m_faces, resting}, out);
}

// Takes what a contact does into this substep.
template <class Real>
void RigidContacts<Real>::add(const RigidTouch& touch, RigidContact& c, Body<Real>& body) {
  c.push = std::uint32_t(m_pushes.size());
  m_pushes.push_back({c.proxy, c.body, c.element, touch, 0});
  m_pushes.back().before = pushPower(m_pushes.back(), body);
  apply(m_pushes.back(), body, 1);
}

// Takes it out again, as it was.
template <class Real>
void RigidContacts<Real>::take(RigidContact& c, Body<Real>& body) {
  Push& push = m_pushes[c.push];
  apply(push, body, -1);
  push.touch = {};
  push.before = 0;
}

template <class Real>
void RigidContacts<Real>::apply(const Push& push, Body<Real>& body, double sign) {
  const auto to = [sign](const Eigen::Vector3d& v) -> Vec3<Real> { return (sign * v).cast<Real>(); };
  const RigidTouch& t = push.touch;
  body.work.force[push.element] += to(t.force);
  body.work.torque[push.element] += to(t.torque);
  body.work.dampingForce[push.element] += to(t.dampingForce);
  body.work.dampingTorque[push.element] += to(t.dampingTorque);
  RigidState& state = m_states[push.proxy];
  const Eigen::Vector3d arm = t.x - m_proxies[push.proxy].position;
  state.force -= sign * t.force;
  state.torque -= sign * (arm.cross(t.force) + t.torque);
  state.dampingForce -= sign * t.dampingForce;
  state.dampingTorque -= sign * (arm.cross(t.dampingForce) + t.dampingTorque);
  state.size += sign * t.force.norm();
  m_elastic += sign * t.energy;
}

// What an element gets of a push, by its velocity as it is [W].
template <class Real>
double RigidContacts<Real>::pushPower(const Push& push, const Body<Real>& body) const {
  return push.touch.force.dot(body.state.velocity[push.element].template cast<double>()) +
         push.touch.torque.dot(body.state.spin[push.element].template cast<double>());
}

// Between two ticks the host's own contacts and joints move a body. Its contacts end the last step where that
// left it; what they have in them then and now is the host's work.
template <class Real>
bool RigidContacts<Real>::touchMoved(RigidContact& c, const Body<Real>& body, const Steps& steps, double kick,
                                     RestingLoads& resting, Books& books, RigidTouch& out) {
  RigidProxy& proxy = m_proxies[c.proxy];
  const RigidPose now = poseNow(proxy);
  RigidTouch before;
  setPose(proxy, m_states[c.proxy].left);
  const bool touched = touch(c, body, m_cornersLeft, steps, resting, before);
  setPose(proxy, now);
  if (!touched) part(c.memory);
  c.touching = touched;
  const bool touches = touch(c, body, m_corners, {0, steps.next}, resting, out);
  out.slipped = before.slipped;
  const double work = out.energy - before.energy + 0.5 * kick * (out.power - before.power);
  books.bullet.work.add(work, 0);
  proxy.surplus -= work;
  if (!touches) part(c.memory);
  return touches;
}

template <class Real>
void RigidContacts<Real>::accumulate(Bodies bodies, const Steps& steps, double kick, RestingLoads& resting,
                                     Books& books) {
  for (RigidState& s : m_states) {
    s.force = s.torque = s.dampingForce = s.dampingTorque = Eigen::Vector3d::Zero();
    s.pressed = std::exchange(s.size, 0);
    s.corners.beginStep();
  }
  m_pushes.clear();
  findAllCorners(bodies);
  m_moved = steps.moved;
  m_elastic = 0;
  for (const Kept& k : m_kept) m_elastic += k.memory.energy;
  for (std::size_t p = 0; p < m_proxies.size(); ++p)
    m_proxies[p].surplus += std::exchange(m_states[p].surplusNext, 0);
  double slipped = std::exchange(m_lost, 0);
  for (RigidContact& c : m_contacts) {
    Body<Real>& body = *bodies[c.body];
    RigidProxy& proxy = m_proxies[c.proxy];
    // More of it may touch than the step was chosen for: as if several contacts had begun.
    if (body.constants->cells && body.state.exposure.area[c.element] > c.exposed)
      body.work.touchesBegun[c.element] = 2;
    RigidTouch t;
    const bool touched = c.touching;
    c.touching = m_states[c.proxy].moved ? touchMoved(c, body, steps, kick, resting, books, t)
                                         : touch(c, body, m_corners, steps, resting, t);
    c.memory.energy = t.energy;
    slipped += t.slipped;
    if (!c.touching) {
      if (touched) part(c.memory);
      continue;
    }
    if (!touched) ++body.work.touchesBegun[c.element];
    add(t, c, body);
    pushMotion(body.work.motions[body.work.motionOf[c.element]], t.x, t.force, t.torque);
    resting.push(t.resting, t.full);
    const double size = kick * t.force.norm();
    proxy.contactPoint += size * t.at;
    proxy.contactWeight += size;
    if (std::find(proxy.touched.begin(), proxy.touched.end(), body.id) == proxy.touched.end())
      proxy.touched.push_back(body.id);
  }
  for (std::uint32_t p = 0; p < m_states.size(); ++p)
    m_states[p].corners.visitGone([&](const CornerMemory& corner) {
      if (isListed(p, corner, bodies)) slipped += corner.lostOutside(steps.moved);
    });
  books.dissipated.add(-slipped, 0);
  for (RigidState& s : m_states) s.moved = false;
}

// Whether the element that a corner was in is still looked at: what left or sleeps has been booked.
template <class Real>
bool RigidContacts<Real>::isListed(std::uint32_t proxy, const CornerMemory& corner, Bodies bodies) const {
  return std::any_of(m_contacts.begin(), m_contacts.end(), [&](const RigidContact& c) {
    return c.proxy == proxy && c.element == corner.element && bodies[c.body]->id == corner.body &&
           bodies[c.body]->state.alive[c.element];
  });
}

template <class Real>
void RigidContacts<Real>::release(Bodies bodies, double kick, Books& books) {
  for (RigidContact& c : m_contacts) {
    Body<Real>& body = *bodies[c.body];
    if (!c.touching || !body.work.leaving[c.element]) continue;
    const RigidTouch before = m_pushes[c.push].touch;
    take(c, body);
    bookChange(before, {}, kick, books);
    c.touching = false;
    c.memory = {};
    c.faces = {};
  }
}

template <class Real>
void RigidContacts<Real>::expose(Bodies bodies, double step, double kick, RestingLoads& resting,
                                 Books& books) {
  for (RigidContact& c : m_contacts) {
    Body<Real>& body = *bodies[c.body];
    if (!c.touching || !body.constants->cells || c.faces.area == body.state.exposure.area[c.element])
      continue;
    const RigidTouch before = m_pushes[c.push].touch;
    take(c, body);
    if (c.balls > 0) {
      findCorners(body, c.element, m_proxies[c.proxy], m_faces);
      m_corners.renew(c.proxy, placeOf(c), m_faces.hits());
    }
    RigidTouch now;
    c.touching = touch(c, body, m_corners, {0, step}, resting, now);
    c.memory.energy = now.energy;
    if (c.touching)
      add(now, c, body);
    else
      part(c.memory);
    bookChange(before, now, kick, books);
  }
}

// The law of a contact has changed at this instant, because of a break: so has the energy in it, and up to
// here the force before has done its half.
template <class Real>
void RigidContacts<Real>::bookChange(const RigidTouch& before, const RigidTouch& now, double kick,
                                     Books& books) {
  books.elastic += now.energy - before.energy;
  books.fracture += before.energy - now.energy + 0.5 * kick * (before.power - now.power);
}

template <class Real>
void RigidContacts<Real>::integrate(Bodies bodies, double kick, double step, Books& books) {
  for (const Push& push : m_pushes) {
    m_proxies[push.proxy].surplus += 0.5 * kick * push.before;
    m_states[push.proxy].surplusNext += 0.5 * kick * pushPower(push, *bodies[push.body]);
  }
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    RigidProxy& proxy = m_proxies[p];
    const RigidState& state = m_states[p];
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
    if (proxy.mobility) {
      Eigen::Matrix<double, 6, 1> push;
      push << state.force, state.torque;
      for (const RigidProxy::Coupling& other : proxy.coupled) {
        const Eigen::Matrix<double, 6, 1> moved = kick * (other.mobility * push);
        m_proxies[other.proxy].velocity += moved.head<3>();
        m_proxies[other.proxy].spin += moved.tail<3>();
      }
      push = *proxy.mobility * push;
      proxy.velocity += kick * (push.head<3>() + proxy.acceleration);
      proxy.spin += kick * (push.tail<3>() + proxy.angularAcceleration);
    } else if (proxy.isDynamic()) {
      const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
      proxy.velocity += kick * (proxy.inverseMass * state.force + proxy.acceleration);
      proxy.spin += kick * (turn * (proxy.inverseInertia.asDiagonal() * (turn.transpose() * state.torque)) +
                            proxy.angularAcceleration);
    }
    const double givenNext = -power(state.force, state.torque);
    books.bullet.work.add(given, givenNext);
    proxy.given += given + givenNext;
    proxy.givenNext = givenNext;
    proxy.surplus -= given;
    m_states[p].surplusNext -= givenNext;
    books.dissipated.add(lost, power(state.dampingForce, state.dampingTorque));
    proxy.position += step * proxy.velocity;
    const double angle = proxy.spin.norm() * step;
    if (angle > 0)
      proxy.orientation =
          (Eigen::Quaterniond(Eigen::AngleAxisd(angle, proxy.spin.normalized())) * proxy.orientation)
              .normalized();
    m_states[p].left = poseNow(proxy);
  }
}

template <class Real>
double RigidContacts<Real>::overlapOf(std::size_t place) const {
  double deepest = 0;
  for (const RigidContact& c : m_contacts)
    if (c.body == place) deepest = std::max(deepest, c.faces.deepest);
  for (const RigidState& state : m_states)
    for (const CornerMemory& corner : state.corners.all())
      if (place < m_ids.size() && corner.body == m_ids[place])
        deepest = std::max(deepest, corner.pressed + corner.sunk);
  return deepest;
}

template <class Real>
double RigidContacts<Real>::maxSpeed(std::span<const Drift> drifts) const {
  double fastest = 0;
  for (std::size_t i = 0; i < m_proxies.size(); ++i)
    fastest = std::max(fastest, speedOf(m_proxies[i], drifts[i].velocity));
  return fastest;
}

template <class Real>
double RigidContacts<Real>::shortestPass(Bodies bodies, std::span<const Drift> drifts, double speed) const {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < m_contacts.size(); ++k) {
    const RigidContact& c = m_contacts[k];
    const bool same = k > 0 && m_contacts[k - 1].proxy == c.proxy && m_contacts[k - 1].body == c.body;
    if (same || bodies[c.body]->constants->cells) continue;
    const RigidProxy& proxy = m_proxies[c.proxy];
    const double fast = speed + speedOf(proxy, drifts[c.proxy].velocity);
    if (!(fast > 0)) continue;
    for (const Collider& part : proxy.parts) shortest = std::min(shortest, part.thickness() / fast);
  }
  return shortest;
}

template class RigidContacts<float>;
template class RigidContacts<double>;

}  // namespace rubble::edem
