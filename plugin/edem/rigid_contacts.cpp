#include "edem/rigid_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "edem/fragment_motion.h"
#include "edem/proxy_motion.h"

namespace rubble::edem {
namespace {

// A point of an edge stays with the cell that it was in until it is deeper in another by this, over h. Points
// lie on the borders of cells by rows, and where two cells tremble each change of cells would tell.
constexpr double kStays = 0.01;
// What comes into elements by less than this share of their radius, all springs together, rests on them.
constexpr double kBlow = 1e-3;
// The blow of what is lighter than an element is followed as if this many times as much pressed it as does,
// until so much does. All that is near it, as of others, may be far more, and where it is fast as that its
// blows are what shortens the substep.
constexpr double kGrows = 2;

}  // namespace

template <class Real>
void RigidContacts<Real>::beginTick(std::span<RigidProxy> proxies, double leap, double light) {
  m_lists.keep(m_states);
  m_proxies = proxies;
  std::swap(m_before, m_states);
  takeProxies(proxies, m_before, leap, light, m_states);
  for (const RigidState& state : m_states)
    if (state.leapt) m_lists.part(state.key);
}

template <class Real>
void RigidContacts<Real>::build(Bodies bodies, const PairLists<Real>& lists) {
  m_lists.build(bodies, lists, m_proxies, m_states);
  m_sides.clear();
  for (const auto& body : bodies) m_sides.push_back(body->constants->contact);
  for (RigidContact& c : m_lists.contacts()) c.exposed = -1;
  weigh(bodies);
}

template <class Real>
void RigidContacts<Real>::split(std::uint32_t id, std::span<const std::uint8_t> which, std::uint32_t newId) {
  m_lists.split(m_states, id, which, newId);
  for (RigidState& state : m_states) state.corners.split(id, which, newId);
}

template <class Real>
double RigidContacts<Real>::endContactsOf(std::uint32_t id) {
  const double energy = m_lists.end(id);
  // It may come back under the same name, elsewhere.
  for (RigidState& state : m_states) state.corners.forget(id);
  m_elastic -= energy;
  return energy;
}

template <class Real>
void RigidContacts<Real>::weigh(Bodies bodies) {
  bool same = true;
  for (RigidContact& c : m_lists.contacts()) {
    const Body<Real>& body = *bodies[c.body];
    if (!body.constants->cells) {
      same = same && c.weight == 1;
      c.weight = 1;
    } else if (c.exposed != body.state.exposure.area[c.element]) {
      same = false;
      weighFaces(c, body, m_proxies[c.proxy], m_faces);
    }
  }
  if (same && !m_lists.contacts().empty()) return;
  for (RigidState& s : m_states) s.mobility = s.rate = s.edgeRate = s.edgeMost = 0;
  for (RigidContact& c : m_lists.contacts())
    addMobility(c, *bodies[c.body], m_proxies[c.proxy], m_states[c.proxy]);
  for (std::size_t p = 0; p < m_proxies.size(); ++p) addEdges(m_proxies[p], m_states[p]);
  soften(std::numeric_limits<double>::infinity());
}

template <class Real>
void RigidContacts<Real>::soften(double frequency2) {
  for (std::size_t p = 0; p < m_proxies.size(); ++p)
    setLaws(m_sides, m_proxies[p], frequency2, m_share, m_states[p]);
}

template <class Real>
void RigidContacts<Real>::setShare(double share) {
  m_share = share;
  soften(std::numeric_limits<double>::infinity());
}

template <class Real>
double RigidContacts<Real>::elasticAwake() const {
  double energy = 0;
  for (const RigidContact& c : m_lists.contacts()) energy += c.memory.energy;
  return energy;
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
        const RigidPose now = poseOf(m_proxies[p]);
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
  for (const RigidContact& c : m_lists.contacts()) {
    if (!bodies[c.body]->constants->cells || c.apart || !(c.balls > 0)) continue;
    const auto& parts = m_proxies[c.proxy].parts;
    if (std::none_of(parts.begin(), parts.end(), hasCorners)) continue;
    findCorners(*bodies[c.body], c, m_proxies[c.proxy], m_faces);
    const Body<Real>& body = *bodies[c.body];
    const double favour = kStays * std::sqrt(body.constants->cells->unit);
    corners.add(c.proxy, m_lists.placeOf(c), m_faces.hits(), favour, [&](const FaceHit& hit) {
      return m_states[c.proxy].corners.wasIn(hit.corner, body.id, c.element);
    });
  }
  corners.settle();
}

template <class Real>
bool RigidContacts<Real>::touch(RigidContact& c, const Body<Real>& body, const CornerHits& corners,
                                const Steps& steps, RestingLoads& resting, RigidTouch& out) {
  const std::span<const CornerHit> own = corners.of(m_lists.placeOf(c));
  c.cornered = c.cornered || !own.empty();
  return touchRigid(c, body, {m_proxies[c.proxy], m_states[c.proxy]}, own, {steps, m_moved, m_faces, resting},
                    out);
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
  const RigidPose now = poseOf(proxy);
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
    s.anchorForce = s.anchorTorque = Eigen::Vector3d::Zero();
    s.pressed = std::exchange(s.size, 0);
    s.pressedRate = 0;
    s.corners.beginStep();
  }
  m_pushes.clear();
  for (RigidContact& c : m_lists.contacts())
    c.apart = bodies[c.body]->constants->cells && !m_states[c.proxy].moved &&
              isApart(c, *bodies[c.body], m_proxies[c.proxy]);
  findAllCorners(bodies);
  m_moved = steps.moved;
  m_elastic = m_lists.keptEnergy();
  for (std::size_t p = 0; p < m_proxies.size(); ++p)
    m_proxies[p].surplus += std::exchange(m_states[p].surplusNext, 0);
  double slipped = m_lists.takeLost();
  for (RigidContact& c : m_lists.contacts()) {
    Body<Real>& body = *bodies[c.body];
    RigidProxy& proxy = m_proxies[c.proxy];
    // More of it may touch than the step was chosen for: as if several contacts had begun.
    if (body.constants->cells && body.state.exposure.area[c.element] > c.exposed)
      body.work.touchesBegun[c.element] = 2;
    c.cornered = false;
    if (c.apart) {
      c.memory.energy = 0;
      continue;
    }
    RigidTouch t;
    const bool touched = c.touching;
    // What has been put there has come no way.
    const Steps own{m_states[c.proxy].leapt ? 0 : steps.moved, steps.next};
    c.touching = m_states[c.proxy].moved ? touchMoved(c, body, steps, kick, resting, books, t)
                                         : touch(c, body, m_corners, own, resting, t);
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
    RigidState& state = m_states[c.proxy];
    state.pressedRate += t.weight * c.mobility * state.laws[c.body].stiffness;
    const double size = kick * t.force.norm();
    proxy.contactPoint += size * t.at;
    proxy.contactWeight += size;
    if (std::find(proxy.touched.begin(), proxy.touched.end(), body.id) == proxy.touched.end())
      proxy.touched.push_back(body.id);
  }
  for (std::uint32_t p = 0; p < m_states.size(); ++p)
    m_states[p].corners.visitGone([&](const CornerMemory& corner) {
      // What left or sleeps has been booked.
      const RigidContact* c = m_lists.find(p, corner.body, corner.element);
      if (c && bodies[c->body]->state.alive[c->element]) slipped += corner.lostOutside(steps.moved);
    });
  books.dissipated.add(-slipped, 0);
  for (RigidState& s : m_states) s.moved = s.leapt = false;
}

template <class Real>
void RigidContacts<Real>::release(Bodies bodies, double kick, Books& books) {
  for (RigidContact& c : m_lists.contacts()) {
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
  for (RigidContact& c : m_lists.contacts()) {
    Body<Real>& body = *bodies[c.body];
    if (!c.touching || !body.constants->cells || c.faces.area == body.state.exposure.area[c.element])
      continue;
    const RigidTouch before = m_pushes[c.push].touch;
    take(c, body);
    if (c.balls > 0) {
      findCorners(body, c, m_proxies[c.proxy], m_faces);
      m_corners.renew(c.proxy, m_lists.placeOf(c), m_faces.hits());
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
void RigidContacts<Real>::pull(std::uint32_t p, const Wrench& all, const Wrench& damping) {
  RigidState& state = m_states[p];
  state.force += all.force;
  state.torque += all.torque;
  state.anchorForce += all.force;
  state.anchorTorque += all.torque;
  state.dampingForce += damping.force;
  state.dampingTorque += damping.torque;
  m_proxies[p].pulled = true;
}

template <class Real>
void RigidContacts<Real>::push(std::uint32_t p, const Wrench& impulse) {
  pushProxy(m_proxies[p], impulse);
  m_states[p].left = poseOf(m_proxies[p]);
}

template <class Real>
void RigidContacts<Real>::integrate(Bodies bodies, double kick, double step, Books& books) {
  for (const Push& push : m_pushes) {
    m_proxies[push.proxy].surplus += 0.5 * kick * push.before;
    m_states[push.proxy].surplusNext += 0.5 * kick * pushPower(push, *bodies[push.body]);
  }
  moveProxies(m_proxies, m_states, kick, step, books);
}

template <class Real>
double RigidContacts<Real>::overlapOf(std::uint32_t id) const {
  double deepest = 0;
  for (const RigidContact& c : m_lists.contacts())
    if (m_lists.idOf(c) == id) deepest = std::max(deepest, c.faces.deepest);
  for (const RigidState& state : m_states)
    for (const CornerMemory& corner : state.corners.all())
      if (corner.body == id) deepest = std::max(deepest, corner.pressed + corner.sunk);
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
double RigidContacts<Real>::blowFrequency2(Bodies bodies, std::span<const Drift> drifts) {
  m_blow2 = 0;
  const std::vector<RigidContact>& contacts = m_lists.contacts();
  for (auto c = contacts.begin(); c != contacts.end();) {
    const RigidProxy& proxy = m_proxies[c->proxy];
    RigidState& state = m_states[c->proxy];
    double energy = 0, lone = 0;
    double radius = std::numeric_limits<double>::infinity(), lightest = radius;
    for (const std::uint32_t place = c->proxy; c != contacts.end() && c->proxy == place; ++c) {
      energy += c->memory.energy;
      radius = std::min(radius, double(bodies[c->body]->constants->radius));
      lightest = std::min(lightest, bodies[c->body]->constants->lightest);
      lone = std::max(lone, std::max(1.0, c->lone) * c->mobility * state.laws[c->body].stiffness);
    }
    state.struck = false;
    if (!proxy.isDynamic()) continue;
    const bool light = proxy.inverseMass * lightest > 1;
    const double pressed = light ? std::max(kGrows * state.pressedRate, lone) : state.rates.stiffness,
                 frequency2 = std::min(state.rates.stiffness, pressed);
    // In the middle of a blow it stands, and the springs have its energy.
    const double speed = speedOf(proxy, drifts[std::size_t(&proxy - m_proxies.data())].velocity);
    const double rests = kBlow * radius;
    state.struck = speed * speed + 2 * proxy.inverseMass * energy > rests * rests * state.rates.stiffness;
    if (state.struck) m_blow2 = std::max(m_blow2, frequency2);
  }
  return m_blow2;
}

template <class Real>
bool RigidContacts<Real>::blowGrew() const {
  // Never as if more than all pressed: then it would be asked anew in every substep.
  return std::any_of(m_states.begin(), m_states.end(), [&](const RigidState& s) {
    return s.struck && std::min(s.pressedRate, s.rates.stiffness) > m_blow2;
  });
}

template <class Real>
double RigidContacts<Real>::shortestPass(Bodies bodies, std::span<const Drift> drifts, double speed) const {
  double shortest = std::numeric_limits<double>::infinity();
  const RigidContact* last = nullptr;
  for (const RigidContact& c : m_lists.contacts()) {
    const RigidContact* before = std::exchange(last, &c);
    const bool same = before && before->proxy == c.proxy && before->body == c.body;
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
