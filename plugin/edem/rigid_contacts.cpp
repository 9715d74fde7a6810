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

// Bound from above of the largest eigenvalue of a matrix that has none below 0: the Frobenius norm of its
// fourth power, which is 6^(1/8) too large at most.
double largestEigenvalue(const Eigen::Matrix<double, 6, 6>& matrix) {
  const Eigen::Matrix<double, 6, 6> square = matrix * matrix, fourth = square * square;
  return std::pow(fourth.squaredNorm(), 0.125);
}

template <class Real>
ElementPose poseOf(const Body<Real>& body, std::uint32_t i, const RigidProxy& proxy) {
  const Eigen::Vector3d x = body.origin + body.position[i];
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  return {back * (x - proxy.position), (back * body.orientation(i)).toRotationMatrix()};
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
    ProxyState& state = m_states[p];
    state.key = proxy.key != 0 ? proxy.key : p + 1;
    const auto before = std::find_if(m_before.begin(), m_before.end(),
                                     [&](const ProxyState& s) { return s.key == state.key; });
    proxy.given = proxy.surplus = 0;
    if (before != m_before.end()) {
      state.left = before->left;
      state.moved = true;
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
  for (const Candidate& c : m_candidates)
    if (c.touching || c.memory.range > 0 || c.faces.deepest > 0)
      m_kept.push_back(
          {m_states[c.proxy].key, m_ids[c.body], c.element, c.memory, c.energy, c.faces, c.touching});
  m_candidates.clear();
}

template <class Real>
void RigidContacts<Real>::remember(Candidate& candidate) {
  const Kept wanted{
      m_states[candidate.proxy].key, m_ids[candidate.body], candidate.element, {}, 0, {}, false};
  const auto found = std::lower_bound(m_kept.begin(), m_kept.end(), wanted,
                                      [](const Kept& a, const Kept& b) { return a.name() < b.name(); });
  if (found == m_kept.end() || found->name() != wanted.name()) return;
  candidate.touching = found->touching;
  candidate.memory = found->memory;
  candidate.energy = found->energy;
  candidate.faces = found->faces;
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
double RigidContacts<Real>::endContactsOf(std::uint32_t id) {
  double energy = 0;
  std::erase_if(m_candidates, [&](const Candidate& c) {
    if (m_ids[c.body] != id) return false;
    energy += c.energy;
    return true;
  });
  std::erase_if(m_kept, [&](const Kept& k) {
    if (k.body != id) return false;
    energy += k.energy;
    return true;
  });
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
      if (!bodies[b]->asleep) listNear(p, b, *bodies[b], lists);
  }
  endContacts(bodies);
  m_sides.clear();
  for (const auto& body : bodies) m_sides.push_back(body->contact);
  for (Candidate& c : m_candidates) c.exposed = -1;
  weigh(bodies);
}

template <class Real>
void RigidContacts<Real>::listNear(std::uint32_t p, std::uint32_t place, const Body<Real>& body,
                                   const PairLists<Real>& lists) {
  const RigidProxy& proxy = m_proxies[p];
  if (std::find(proxy.spared.begin(), proxy.spared.end(), body.id) != proxy.spared.end()) return;
  const ElementGrid& own = lists.grid(place);
  // From now on the element may move a whole skin (from one side of its listed place to the other) and the
  // proxy half.
  const double away = 1.5 * lists.skin(), reach = body.reach() + away;
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
    const double distance = nearest(proxy, x).distance;
    if (distance >= (body.cells ? body.cells->reach[i] + away : reach)) return;
    Candidate candidate;
    candidate.proxy = p;
    candidate.body = place;
    candidate.element = i;
    if (body.cells) {
      const Eigen::Vector3d at = proxy.orientation.conjugate() * (x - proxy.position);
      candidate.balls = ballWeights(proxy, at, body.cells->reach[i] + away);
      candidate.core = distance < body.cells->core[i] + away;
    }
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

// What of an element may touch at once: every point of its exposed faces that looks at the surface, the balls
// that are near, and its core. Faces that turn towards the surface count from the next tick.
template <class Real>
void RigidContacts<Real>::weighFaces(Candidate& c, const Body<Real>& body) {
  const std::uint32_t i = c.element;
  const CellFaces& cells = *body.cells;
  c.exposed = body.exposure.area[i];
  c.weight = c.mode = c.dampingWeight = 0;
  const double gyration = body.inertia[i] / body.mass[i];
  const auto add = [&](double weight, double lever2) {
    c.weight += weight;
    c.mode += weight * (1 + lever2 / gyration);
    c.dampingWeight += weight * std::sqrt(1 + lever2 / gyration);
  };
  if (c.core) add(1, 0);
  c.lone = 1;
  if (!(c.exposed > 0)) return;
  add(c.balls, cells.reach[i] * cells.reach[i]);
  const RigidProxy& proxy = m_proxies[c.proxy];
  const ElementPose pose = poseOf(body, i, proxy);
  m_faces.approach(proxy, pose.at, std::numeric_limits<double>::infinity());
  // Stiffness of the points against shifts and turns of the element, for a mass and an inertia of 1.
  Eigen::Matrix<double, 6, 6> stiff = Eigen::Matrix<double, 6, 6>::Zero(), damped = stiff;
  double pressed = 0;
  m_faces.visitFacing(cells, body.exposure, i, pose,
                      [&](double weight, const Eigen::Vector3d& normal, const Eigen::Vector3d& lever) {
                        Eigen::Matrix<double, 6, 1> way;
                        way << normal, lever / std::sqrt(gyration);
                        stiff += weight * way * way.transpose();
                        damped += weight / way.norm() * way * way.transpose();
                        pressed += weight;
                      });
  c.weight += pressed;
  c.mode += largestEigenvalue(stiff);
  c.dampingWeight += largestEigenvalue(damped);
  c.lone = std::max({c.lone, c.balls, pressed});
}

// The mobility of each rigid body at its candidates, and the laws of contacts with it. An impulse J at a
// point r from the centre moves that point by at most (1/m + r^2 / I) J.
template <class Real>
void RigidContacts<Real>::weigh(Bodies bodies) {
  bool same = true;
  for (Candidate& c : m_candidates) {
    const Body<Real>& body = *bodies[c.body];
    if (!body.cells) {
      same = same && c.weight == 1;
      c.weight = 1;
    } else if (c.exposed != body.exposure.area[c.element]) {
      same = false;
      weighFaces(c, body);
    }
  }
  if (same && !m_candidates.empty()) return;
  for (ProxyState& s : m_states) s.mobility = s.rate = 0;
  for (const Candidate& c : m_candidates) {
    if (!(c.weight > 0)) continue;
    const RigidProxy& proxy = m_proxies[c.proxy];
    if (!proxy.isDynamic()) continue;
    const Body<Real>& body = *bodies[c.body];
    const Eigen::Vector3d x = body.origin + body.position[c.element];
    // It touches the body at one of the body's points.
    const double reach = proxy.reach(), lever2 = std::min((x - proxy.position).squaredNorm(), reach * reach);
    const double mobility = proxy.inverseMass + lever2 * proxy.inverseInertia.maxCoeff();
    m_states[c.proxy].mobility += mobility;
    m_states[c.proxy].rate += c.weight * mobility * body.contact.stiffness;
  }
  soften(std::numeric_limits<double>::infinity());
}

template <class Real>
ElementRates RigidContacts<Real>::ratesOf(const Candidate& c, const Body<Real>& body,
                                          double& frequency2) const {
  const ContactLaw<double>& law = m_states[c.proxy].laws[c.body];
  const double moves = 1 / body.mass[c.element], turns = 1 / body.inertia[c.element];
  if (!body.cells) {
    frequency2 = law.stiffness * moves;
    return contactRates(law, moves, turns, double(body.radius));
  }
  if (!(c.weight > 0)) return {};
  frequency2 = c.lone * law.stiffness * moves;
  const double reach = body.cells->reach[c.element], sliding = moves + reach * reach * turns;
  return {
      law.stiffness * c.mode * moves + law.tangential * sliding + law.rolling * turns,
      law.damping * c.dampingWeight * moves + law.tangentialDamping * sliding + law.rollingDamping * turns};
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
bool RigidContacts<Real>::expired(double skin, std::span<const Drift> drifts) const {
  for (std::size_t p = 0; p < m_proxies.size(); ++p) {
    const RigidProxy& proxy = m_proxies[p];
    const double angle = m_states[p].listedOrientation.angularDistance(proxy.orientation);
    const Eigen::Vector3d moved = proxy.position - m_states[p].listedPosition - drifts[p].moved;
    if (moved.norm() + angle * proxy.reach() > 0.5 * skin) return true;
  }
  return false;
}

// Change of the speed of a fragment against a rigid body that the contacts of both make in a substep [m/s].
template <class Real>
double RigidContacts<Real>::joltOf(const FragmentMotion& fragment, std::uint32_t proxy, double step) const {
  return step *
         (fragment.pressed * fragment.inverseMass + m_states[proxy].pressed * m_proxies[proxy].inverseMass);
}

template <class Real>
std::size_t RigidContacts<Real>::restingOf(const Candidate& c, const Body<Real>& body,
                                           RestingLoads& resting) const {
  const RigidProxy& proxy = m_proxies[c.proxy];
  return resting.pairOf({rigidName(m_states[c.proxy].key), proxy.inverseMass, proxy.acceleration},
                        {fragmentName(body.id, body.fragment[c.element]),
                         body.motions[body.motionOf[c.element]].inverseMass, resting.gravity()});
}

// The load of a contact on an element at out.at.
template <class Real>
void RigidContacts<Real>::finish(const ContactMotion<double>& motion, const ContactLoad<double>& load,
                                 Touch& out) {
  const Eigen::Vector3d arm = out.at - out.x;
  // The element gets the load in its own scalar; what is booked and given to the rigid body is exactly that.
  const auto rounded = [](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return v.cast<Real>().template cast<double>();
  };
  out.full = load.full * motion.normal;
  out.force = rounded(load.elastic + load.damping);
  out.torque = rounded(arm.cross(load.elastic + load.damping) + load.elasticTorque + load.dampingTorque);
  out.dampingForce = rounded(load.damping);
  out.dampingTorque = rounded(arm.cross(load.damping) + load.dampingTorque);
  out.energy = load.energy;
  out.slipped = load.slipped;
  out.power = load.elastic.dot(motion.approach) + load.elasticTorque.dot(motion.spin);
}

template <class Real>
bool RigidContacts<Real>::touch(Candidate& c, const Body<Real>& body, const CornerHits& corners,
                                const Steps& steps, RestingLoads& resting, Touch& out) {
  const std::uint32_t i = c.element;
  if (!body.alive[i]) return false;
  if (body.cells) return touchFaces(c, body, corners, steps, resting, out);
  const RigidProxy& proxy = m_proxies[c.proxy];
  out.x = body.origin + body.position[i];
  const SurfacePoint surface = nearest(proxy, out.x);
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
  out.resting = restingOf(c, body, resting);
  motion.withheld =
      withheld(law.inelastic, parting, joltOf(fragment, c.proxy, steps.next), resting.share(out.resting));

  finish(motion, contactLoad(law, motion, steps.moved, c.memory), out);
  return true;
}

// Which corners of the proxies press which elements in this substep.
template <class Real>
void RigidContacts<Real>::findCorners(Bodies bodies) {
  m_cornersLeft.clear();
  const auto moved = [](const ProxyState& s) { return s.moved; };
  if (std::any_of(m_states.begin(), m_states.end(), moved)) {
    const auto swap = [&] {
      for (std::size_t p = 0; p < m_proxies.size(); ++p) {
        if (!m_states[p].moved) continue;
        const Motion now = motionOf(m_proxies[p]);
        setMotion(m_proxies[p], std::exchange(m_states[p].left, now));
      }
    };
    swap();
    findCorners(bodies, m_cornersLeft);
    swap();
  }
  findCorners(bodies, m_corners);
}

template <class Real>
void RigidContacts<Real>::findCorners(Bodies bodies, CornerHits& corners) {
  corners.clear();
  for (const Candidate& c : m_candidates) {
    if (!bodies[c.body]->cells || !(c.balls > 0)) continue;
    cornersOf(c, *bodies[c.body]);
    corners.add(c.proxy, placeOf(c), m_faces.hits());
  }
  corners.settle();
}

// Leaves them in m_faces.
template <class Real>
void RigidContacts<Real>::cornersOf(const Candidate& c, const Body<Real>& body) {
  const ElementPose pose = poseOf(body, c.element, m_proxies[c.proxy]);
  const double reach = body.exposure.count[c.element] > 0 ? body.cells->reach[c.element] : 0;
  m_faces.approach(m_proxies[c.proxy], pose.at, reach);
  m_faces.findCorners(*body.cells, body.exposure, c.element, pose);
}

// Takes the depth without force off the hits: that in which faces or corners were first seen, or in which
// faces are because they have just been exposed, for what they cannot have come in the last step of `moved`
// seconds. It gives way as they leave.
template <class Real>
void RigidContacts<Real>::sink(Candidate& c, const Body<Real>& body, const CornerHits& corners,
                               const ElementMotion& motion, double moved) {
  double deepest = 0;
  for (const FaceHit& hit : m_faces.hits()) deepest = std::max(deepest, hit.depth);
  FaceMemory& memory = c.faces;
  const bool fresh = memory.deepest <= 0 || memory.area != body.exposure.area[c.element];
  const double fastest = motion.centre.norm() + motion.spin.norm() * body.cells->reach[c.element];
  const double way = 2 * moved * fastest, free = memory.deepest + way;
  if (fresh && deepest > free) memory.sunk += deepest - free;
  memory.area = body.exposure.area[c.element];
  memory.deepest = deepest;
  memory.sunk = std::min(memory.sunk, deepest);
  for (const CornerHit& h : corners.of(placeOf(c))) m_faces.add(h.hit);
  m_faces.lift([&](const FaceHit& hit) {
    if (hit.corner == CornerName{}) return memory.sunk;
    const double approach = -hit.normal.dot(motion.centre + motion.spin.cross(hit.at));
    return sinkCorner(m_states[c.proxy], {hit.corner, body.id, c.element, hit.depth, 0}, way,
                      std::max(0.0, approach * moved));
  });
}

// A corner that slides from one cell into the next presses it as deep as it did, and by how much it has come
// nearer in the last step. One that was in none has come less than `way`.
template <class Real>
double RigidContacts<Real>::sinkCorner(ProxyState& state, CornerMemory corner, double way, double nearer) {
  const auto named = [&](const CornerMemory& m) { return m.name == corner.name; };
  const auto before = std::find_if(state.cornersBefore.begin(), state.cornersBefore.end(), named);
  const double depth = corner.pressed;
  double sunk = depth - way;
  if (before != state.cornersBefore.end())
    sunk = before->body == corner.body && before->element == corner.element
               ? before->sunk
               : depth - before->pressed - nearer;
  corner.sunk = std::clamp(sunk, 0.0, depth);
  corner.pressed = depth - corner.sunk;
  const auto now = std::find_if(state.corners.begin(), state.corners.end(), named);
  if (now == state.corners.end())
    state.corners.push_back(corner);
  else
    *now = corner;
  return corner.sunk;
}

template <class Real>
bool RigidContacts<Real>::touchFaces(Candidate& c, const Body<Real>& body, const CornerHits& corners,
                                     const Steps& steps, RestingLoads& resting, Touch& out) {
  const std::uint32_t i = c.element;
  const RigidProxy& proxy = m_proxies[c.proxy];
  const CellFaces& cells = *body.cells;
  out.x = body.origin + body.position[i];
  ElementPose pose;
  pose.at = proxy.orientation.conjugate() * (out.x - proxy.position);
  const double reach = body.exposure.count[i] > 0 ? cells.reach[i] : 0;
  const double distance = m_faces.approach(proxy, pose.at, reach);
  if (distance >= std::max(reach, cells.core[i]) && !c.touching) {
    c.faces = {};
    return false;
  }
  const Eigen::Matrix3d turn = body.orientation(i).toRotationMatrix();
  pose.turn = proxy.orientation.conjugate().toRotationMatrix() * turn;
  m_faces.find(cells, body.exposure, i, pose, c.balls > 0);
  // Of the element's points relative to the rigid body's: velocity + spin x arm.
  const Eigen::Vector3d velocity =
      body.velocity[i].template cast<double>() - proxy.velocity - proxy.spin.cross(out.x - proxy.position);
  ContactMotion<double> motion;
  motion.spin = body.spin[i].template cast<double>() - proxy.spin;
  const ElementMotion own{turn.transpose() * velocity, turn.transpose() * motion.spin,
                          body.inertia[i] / body.mass[i]};
  const ContactLaw<double>& law = m_states[c.proxy].laws[c.body];
  const FragmentMotion& fragment = body.motions[body.motionOf[i]];
  const Eigen::Vector3d parting =
      fragment.velocityAt(out.x) - proxy.velocity - proxy.spin.cross(out.x - proxy.position);
  out.resting = restingOf(c, body, resting);
  sink(c, body, corners, own, steps.moved);
  const FacePress press(m_faces.hits(), law, own,
                        {turn.transpose() * parting, turn.transpose() * (fragment.spin - proxy.spin),
                         joltOf(fragment, c.proxy, steps.next), resting.share(out.resting)},
                        {m_moved, steps.next});
  if (!(press.weight > 0)) {
    out.slipped = lostAtParting(law, velocity, motion.spin, steps.moved, c.memory);
    return false;
  }
  const Eigen::Vector3d arm = turn * press.at;
  out.at = out.x + arm;
  motion.normal = turn * press.normal;
  motion.approach = velocity + motion.spin.cross(arm);
  // Faces resist rolling by their shape; what is left is twisting, by their friction.
  motion.spin = motion.normal * motion.normal.dot(motion.spin);
  const double twisting = law.friction < 0 ? -1 : law.friction * press.spread;
  ContactLoad<double> load = slidingLoad(law, motion, press.total, twisting, steps.moved, c.memory);
  const Eigen::Vector3d pushed = turn * press.elastic, damped = turn * press.damping;
  load.elastic += pushed;
  load.damping += damped;
  load.elasticTorque += turn * press.elasticTorque - arm.cross(pushed);
  load.dampingTorque += turn * press.dampingTorque - arm.cross(damped);
  load.energy += press.energy;
  load.full = press.full;
  finish(motion, load, out);
  return true;
}

// Takes what a contact does into this substep.
template <class Real>
void RigidContacts<Real>::add(const Touch& touch, Candidate& c, Body<Real>& body) {
  c.push = std::uint32_t(m_pushes.size());
  m_pushes.push_back({c.proxy, c.body, c.element, touch, 0});
  m_pushes.back().before = pushPower(m_pushes.back(), body);
  apply(m_pushes.back(), body, 1);
}

// Takes it out again, as it was.
template <class Real>
void RigidContacts<Real>::take(Candidate& c, Body<Real>& body) {
  Push& push = m_pushes[c.push];
  apply(push, body, -1);
  push.touch = {};
  push.before = 0;
}

template <class Real>
void RigidContacts<Real>::apply(const Push& push, Body<Real>& body, double sign) {
  const auto to = [sign](const Eigen::Vector3d& v) -> Vec3<Real> { return (sign * v).cast<Real>(); };
  const Touch& t = push.touch;
  body.force[push.element] += to(t.force);
  body.torque[push.element] += to(t.torque);
  body.dampingForce[push.element] += to(t.dampingForce);
  body.dampingTorque[push.element] += to(t.dampingTorque);
  ProxyState& state = m_states[push.proxy];
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
  return push.touch.force.dot(body.velocity[push.element].template cast<double>()) +
         push.touch.torque.dot(body.spin[push.element].template cast<double>());
}

template <class Real>
typename RigidContacts<Real>::Motion RigidContacts<Real>::motionOf(const RigidProxy& proxy) {
  return {proxy.position, proxy.velocity, proxy.spin, proxy.orientation};
}

template <class Real>
void RigidContacts<Real>::setMotion(RigidProxy& proxy, const Motion& motion) {
  proxy.position = motion.position;
  proxy.velocity = motion.velocity;
  proxy.spin = motion.spin;
  proxy.orientation = motion.orientation;
}

// Between two ticks the host's own contacts and joints move a body. Its contacts end the last step where that
// left it; what they have in them then and now is the host's work.
template <class Real>
bool RigidContacts<Real>::touchMoved(Candidate& c, const Body<Real>& body, const Steps& steps, double kick,
                                     RestingLoads& resting, Books& books, Touch& out) {
  RigidProxy& proxy = m_proxies[c.proxy];
  const Motion now = motionOf(proxy);
  Touch before;
  setMotion(proxy, m_states[c.proxy].left);
  const bool touched = touch(c, body, m_cornersLeft, steps, resting, before);
  setMotion(proxy, now);
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
  for (ProxyState& s : m_states) {
    s.force = s.torque = s.dampingForce = s.dampingTorque = Eigen::Vector3d::Zero();
    s.pressed = std::exchange(s.size, 0);
    std::swap(s.cornersBefore, s.corners);
    s.corners.clear();
  }
  m_pushes.clear();
  findCorners(bodies);
  m_moved = steps.moved;
  m_elastic = 0;
  for (const Kept& k : m_kept) m_elastic += k.energy;
  for (std::size_t p = 0; p < m_proxies.size(); ++p)
    m_proxies[p].surplus += std::exchange(m_states[p].surplusNext, 0);
  double slipped = std::exchange(m_lost, 0);
  for (Candidate& c : m_candidates) {
    Body<Real>& body = *bodies[c.body];
    RigidProxy& proxy = m_proxies[c.proxy];
    // More of it may touch than the step was chosen for: as if several contacts had begun.
    if (body.cells && body.exposure.area[c.element] > c.exposed) body.touchesBegun[c.element] = 2;
    Touch t;
    const bool touched = c.touching;
    c.touching = m_states[c.proxy].moved ? touchMoved(c, body, steps, kick, resting, books, t)
                                         : touch(c, body, m_corners, steps, resting, t);
    c.energy = t.energy;
    slipped += t.slipped;
    if (!c.touching) {
      if (touched) part(c.memory);
      continue;
    }
    if (!touched) ++body.touchesBegun[c.element];
    add(t, c, body);
    pushMotion(body.motions[body.motionOf[c.element]], t.x, t.force, t.torque);
    resting.push(t.resting, t.full);
    const double size = kick * t.force.norm();
    proxy.contactPoint += size * t.at;
    proxy.contactWeight += size;
    if (std::find(proxy.touched.begin(), proxy.touched.end(), body.id) == proxy.touched.end())
      proxy.touched.push_back(body.id);
  }
  books.dissipated.add(-slipped, 0);
  for (ProxyState& s : m_states) s.moved = false;
}

template <class Real>
void RigidContacts<Real>::release(Bodies bodies, double kick, Books& books) {
  for (Candidate& c : m_candidates) {
    Body<Real>& body = *bodies[c.body];
    if (!c.touching || !body.leaving[c.element]) continue;
    const Touch before = m_pushes[c.push].touch;
    take(c, body);
    bookChange(before, {}, kick, books);
    c.touching = false;
    c.memory = {};
    c.faces = {};
    c.energy = 0;
  }
}

template <class Real>
void RigidContacts<Real>::expose(Bodies bodies, double step, double kick, RestingLoads& resting,
                                 Books& books) {
  for (Candidate& c : m_candidates) {
    Body<Real>& body = *bodies[c.body];
    if (!c.touching || !body.cells || c.faces.area == body.exposure.area[c.element]) continue;
    const Touch before = m_pushes[c.push].touch;
    take(c, body);
    if (c.balls > 0) {
      cornersOf(c, body);
      m_corners.renew(c.proxy, placeOf(c), m_faces.hits());
    }
    Touch now;
    c.touching = touch(c, body, m_corners, {0, step}, resting, now);
    c.energy = now.energy;
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
void RigidContacts<Real>::bookChange(const Touch& before, const Touch& now, double kick, Books& books) {
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
    m_states[p].left = motionOf(proxy);
  }
}

template <class Real>
double RigidContacts<Real>::overlapOf(std::size_t place) const {
  double deepest = 0;
  for (const Candidate& c : m_candidates)
    if (c.body == place) deepest = std::max(deepest, c.faces.deepest);
  for (const ProxyState& state : m_states)
    for (const CornerMemory& corner : state.corners)
      if (place < m_ids.size() && corner.body == m_ids[place])
        deepest = std::max(deepest, corner.pressed + corner.sunk);
  return deepest;
}

template <class Real>
double RigidContacts<Real>::maxSpeed(std::span<const Drift> drifts) const {
  double fastest = 0;
  for (std::size_t i = 0; i < m_proxies.size(); ++i) {
    const RigidProxy& p = m_proxies[i];
    fastest = std::max(fastest, (p.velocity - drifts[i].velocity).norm() + p.spin.norm() * p.reach());
  }
  return fastest;
}

template class RigidContacts<float>;
template class RigidContacts<double>;

}  // namespace rubble::edem
