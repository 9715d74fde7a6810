#include "edem/rigid_touch.h"

#include <algorithm>
#include <cmath>

#include "edem/fragment_motion.h"

namespace rubble::edem {
namespace {

// Depth, over the reach of a cell, that the springs of its faces are pressed by at most: ten times as deep as
// it is thick.
constexpr double kMostReaches = 20;

// How a fragment moves against a rigid body at one of its elements, and what it withholds there.
struct Parting {
  Eigen::Vector3d centre, spin;  // of the element's centre [m/s], [rad/s]
  double jolt;                   // see withheld in fragment_motion.h [m/s]
  std::size_t resting;           // place among the resting loads
  double share;                  // of the force that rests
};

template <class Real>
Parting partingOf(const Body<Real>& body, std::uint32_t i, const Eigen::Vector3d& x, const RigidSide& side,
                  const TouchWork& work) {
  const RigidProxy& proxy = side.proxy;
  const FragmentMotion& fragment = body.work.motions[body.work.motionOf[i]];
  const std::size_t resting =
      work.resting.pairOf({rigidName(side.state.key), proxy.inverseMass, proxy.acceleration},
                          {fragmentName(body.id, body.state.fragment[i]), fragment.inverseMass,
                           body.state.gravity.value_or(work.resting.gravity())});
  return {
      fragment.velocityAt(x) - proxy.velocity - proxy.spin.cross(x - proxy.position),
      fragment.spin - proxy.spin,
      // What the contacts of both make of the speed in a substep.
      work.steps.next * (fragment.pressed * fragment.inverseMass + side.state.pressed * proxy.inverseMass),
      resting, work.resting.share(resting)};
}

// The load of a contact on an element at out.at.
template <class Real>
void finish(const ContactMotion<double>& motion, const ContactLoad<double>& load, RigidTouch& out) {
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
  out.slipped += load.slipped;
  out.power = load.elastic.dot(motion.approach) + load.elasticTorque.dot(motion.spin);
}

template <class Real>
bool touchSphere(RigidContact& c, const Body<Real>& body, const RigidSide& side, const TouchWork& work,
                 RigidTouch& out) {
  const std::uint32_t i = c.element;
  const RigidProxy& proxy = side.proxy;
  const Steps& steps = work.steps;
  out.x = body.state.origin + body.work.position[i];
  const SurfacePoint surface = nearest(proxy, out.x);
  const double radius = double(body.constants->radius);
  if (surface.distance >= radius) {
    c.memory.range = 0;
    if (!c.touching) return false;
  }
  out.at = out.x - 0.5 * (surface.distance + radius) * surface.normal;
  const Eigen::Vector3d arm = out.at - out.x;
  const Eigen::Vector3d spin = body.state.spin[i].template cast<double>();
  ContactMotion<double> motion;
  motion.normal = surface.normal;
  motion.approach = body.state.velocity[i].template cast<double>() + spin.cross(arm) - proxy.velocity -
                    proxy.spin.cross(out.at - proxy.position);
  motion.spin = spin - proxy.spin;
  // Shifted by a radius, so that distances and ranges stay above 0 down to a radius below the surface;
  // deeper, a contact is seen anew in every step and gives next to no force.
  if (surface.distance < radius) {
    c.memory.range = contactRange(c.memory.range, surface.distance + radius, 2 * radius,
                                  motion.approach.norm(), steps.moved);
    motion.overlap = c.memory.range - surface.distance - radius;
  }
  const ContactLaw<double>& law = side.state.laws[c.body];
  if (!(motion.overlap > 0)) {
    if (c.touching) out.slipped = lostAtParting(law, motion.approach, motion.spin, steps.moved, c.memory);
    return false;
  }
  const Parting parting = partingOf(body, i, out.at, side, work);
  out.resting = parting.resting;
  motion.withheld = withheld(law.inelastic, parting.centre.dot(motion.normal), parting.jolt, parting.share);
  const double speed = -motion.approach.dot(motion.normal);
  if (steps.moved > 0) c.memory.onset = c.touching ? 1 : onsetShare(motion.overlap, speed, steps.moved);
  const ContactYield<double> yield(law.stiffness, motion.overlap, steps.moved * speed, motion.withheld);
  c.memory.range -= yield.yielded;
  motion.overlap -= yield.yielded;
  motion.share = touchShare(motion.overlap, speed, steps.next, c.memory.onset);
  out.slipped = yield.lost;
  out.weight = 1;
  finish<Real>(motion, contactLoad(law, motion, steps.moved, c.memory), out);
  return true;
}

// What faces move by in a step, for the depth without force.
struct FaceStep {
  const ContactLaw<double>& law;
  const ElementMotion& motion;
  double moved;  // [s]
  double way;    // further than any point of the element comes [m]
  double most;   // deepest that springs are pressed [m]

  double nearer(const FaceHit& hit) const {
    return -moved * scalarDot(hit.normal, velocityAt(hit.at, motion.centre, motion.spin));
  }
  /// What its weight has grown by.
  double heavier(const FaceHit& hit) const {
    return -moved * (scalarDot(hit.turning, motion.spin) +
                     scalarDot(hit.sliding, velocityAt(hit.at, motion.centre, motion.spin)));
  }
  ContactYield<double> yieldOf(const FaceHit& hit, double sunk) const {
    return {hit.weight * law.stiffness, hit.depth - sunk, nearer(hit), hit.withheld};
  }
};

// Faces have one depth without force, so that all give way together, by y: what their springs lose on the
// way, sum K (x + D - y) y / 2 from the depths x to D, is what the withheld force gains on those that near,
// sum K way withheld (x + D - y) / 2, and on those that grow heavier. The same as ContactYield for one hit of
// one weight. Returns it [J].
double giveWay(std::span<FaceHit> hits, const FaceStep& step, FaceMemory& memory) {
  if (std::none_of(hits.begin(), hits.end(), [](const FaceHit& hit) { return hit.withheld > 0; })) return 0;
  double a = 0, b = 0, c = 0;  // a y^2 - b y + c = 0
  for (FaceHit& hit : hits) {
    const double depth = hit.depth - memory.sunk;
    if (!(depth > 0)) continue;
    const double way = hit.nearer = std::min(step.nearer(hit), depth), nears = std::max(0.0, way);
    a += hit.weight;
    b += hit.weight * (2 * depth - way + hit.withheld * nears);
    c += hit.withheld *
         (hit.weight * nears * (2 * depth - way) + std::max(0.0, step.heavier(hit)) * depth * depth);
  }
  if (!(c > 0)) return 0;
  const double yielded = 2 * c / (b + std::sqrt(std::max(0.0, b * b - 4 * a * c)));
  double lost = 0;
  for (const FaceHit& hit : hits) {
    const double depth = hit.depth - memory.sunk;
    if (!(depth > 0)) continue;
    const double left = std::max(0.0, depth - yielded);
    lost += 0.5 * step.law.stiffness * hit.weight * (depth - hit.nearer + left) * (depth - left);
  }
  memory.sunk += yielded;
  memory.yielded = yielded;
  return lost;
}

// What is pressed many times deeper than it is thick gives way. The forces of the weights' changes go with
// depth^2, and turn round where a face stands upright: deeper, no substep is short enough for them. What
// springs lose is as in giveWay. Returns it [J].
double yieldBeyond(std::span<const FaceHit> hits, double deepest, const FaceStep& step, FaceMemory& memory) {
  const double over = deepest - memory.sunk - step.most;
  if (!(over > 0) || !(step.moved > 0)) return 0;
  double lost = 0;
  for (const FaceHit& hit : hits) {
    const double depth = hit.depth - memory.sunk;
    if (!(depth > 0)) continue;
    const double left = std::max(0.0, depth - over), way = std::min(step.nearer(hit), depth + memory.yielded);
    lost += 0.5 * step.law.stiffness * hit.weight * (depth - left) * (depth + left - way);
  }
  memory.sunk += over;
  memory.yielded += over;
  return lost;
}

// The faces' depth without force: that in which they were first seen, or in which they are because they have
// just been exposed, for what they cannot have come in the last step; and that by which they gave way. It
// gives way as they leave. They have one of it, so that all give way together. Returns what the springs lost
// [J].
double sinkFaces(std::span<FaceHit> hits, double deepest, double exposed, const FaceStep& step,
                 FaceMemory& memory) {
  const bool fresh = memory.deepest <= 0 || memory.area != exposed;
  const double free = memory.deepest + step.way;
  if (fresh && deepest > free) memory.sunk += deepest - free;
  memory.area = exposed;
  memory.deepest = deepest;
  memory.sunk = std::min(memory.sunk, deepest);
  if (step.moved > 0) memory.yielded = 0;  // looked at again, it gave way by what it gave
  const double lost = giveWay(hits, step, memory);
  return lost + yieldBeyond(hits, deepest, step, memory);
}

// What a corner has come nearer to another element of the body in the last step, along the normal of its hit
// [m].
template <class Real>
double nearerTo(const Body<Real>& body, std::uint32_t element, const Eigen::Vector3d& at,
                const Eigen::Vector3d& normal, const RigidProxy& proxy, double moved) {
  const Eigen::Vector3d arm = at - body.state.origin - body.work.position[element];
  const Eigen::Vector3d velocity = body.state.velocity[element].template cast<double>() +
                                   body.state.spin[element].template cast<double>().cross(arm) -
                                   proxy.velocity - proxy.spin.cross(at - proxy.position);
  return -moved * normal.dot(velocity);
}

// Takes the depth without force off the hits in work.faces and adds those of corners, less theirs. Returns
// what the springs lost [J].
template <class Real>
double sink(RigidContact& c, const Body<Real>& body, std::span<const CornerHit> corners, const FaceStep& step,
            const PartingMotion& fragment, const RigidSide& side, const Eigen::Matrix3d& turn,
            FaceTouch& faces) {
  faces.withhold(step.law, fragment);
  double lost = sinkFaces(faces.hits(), faces.deepest(), body.state.exposure.area[c.element], step, c.faces);
  for (const CornerHit& h : corners) faces.add(h.hit);
  if (!corners.empty()) faces.withhold(step.law, fragment);
  const Eigen::Vector3d x = body.state.origin + body.work.position[c.element];
  faces.lift([&](FaceHit& hit) {
    if (hit.corner == CornerName{}) {
      hit.yielded = c.faces.yielded;
      return c.faces.sunk;
    }
    const double nearer = step.nearer(hit);
    const CornerMemory* last = side.state.corners.lastOf(hit.corner);
    const bool slides = last && last->body == body.id && last->element != c.element;
    CornerMemory& corner = side.state.corners.press(
        hit.corner,
        {body.id, c.element, hit.depth, step.way, nearer,
         slides ? nearerTo(body, last->element, x + turn * hit.at, turn * hit.normal, side.proxy, step.moved)
                : nearer,
         hit.weight * step.law.stiffness});
    corner.speed = step.moved > 0 ? nearer / step.moved : 0;
    lost += corner.lost;
    const ContactYield<double> yield = step.yieldOf(hit, corner.sunk);
    corner.sunk += yield.yielded;
    corner.pressed -= yield.yielded;
    if (step.moved > 0) corner.yielded = yield.yielded;
    hit.yielded = corner.yielded;
    lost += yield.lost;
    return corner.sunk;
  });
  return lost;
}

// All hits of an element as one contact.
ContactLoad<double> faceLoad(const FacePress& press, const ContactLaw<double>& law,
                             const Eigen::Matrix3d& turn, const ContactMotion<double>& motion, double moved,
                             ContactMemory<double>& memory) {
  const double twisting = law.friction < 0 ? -1 : law.friction * press.spread;
  ContactLoad<double> load = slidingLoad(law, motion, press.total, twisting, moved, memory);
  const Eigen::Vector3d arm = turn * press.at, pushed = turn * press.elastic, damped = turn * press.damping;
  load.elastic += pushed;
  load.damping += damped;
  load.elasticTorque += turn * press.elasticTorque - arm.cross(pushed);
  load.dampingTorque += turn * press.dampingTorque - arm.cross(damped);
  load.energy += press.energy;
  load.full = press.full;
  return load;
}

template <class Real>
bool touchFaces(RigidContact& c, const Body<Real>& body, const RigidSide& side,
                std::span<const CornerHit> corners, const TouchWork& work, RigidTouch& out) {
  const std::uint32_t i = c.element;
  const RigidProxy& proxy = side.proxy;
  const CellFaces& cells = *body.constants->cells;
  const double moved = work.steps.moved;
  out.x = body.state.origin + body.work.position[i];
  ElementPose pose;
  pose.at = proxy.orientation.conjugate() * (out.x - proxy.position);
  const double reach = std::max(cells.core[i], body.state.exposure.count[i] > 0 ? cells.reach[i] : 0);
  const auto stayClear = [&] {
    c.faces = {};
    c.clear = {work.faces.gap(), body.state.exposure.area[i], pose.at,
               proxy.orientation.conjugate() * body.orientation(i)};
  };
  if (work.faces.approach(proxy, pose.at, reach) >= reach && !c.touching) {
    stayClear();
    return false;
  }
  const Eigen::Matrix3d turn = body.orientation(i).toRotationMatrix();
  pose.turn = proxy.orientation.conjugate().toRotationMatrix() * turn;
  work.faces.find(cells, body.state.exposure, i, pose, c.balls > 0);
  // Of the element's points relative to the rigid body's: velocity + spin x arm.
  const Eigen::Vector3d velocity = body.state.velocity[i].template cast<double>() - proxy.velocity -
                                   proxy.spin.cross(out.x - proxy.position);
  ContactMotion<double> motion;
  motion.spin = body.state.spin[i].template cast<double>() - proxy.spin;
  const ElementMotion own{turn.transpose() * velocity, turn.transpose() * motion.spin,
                          body.constants->inertia[i] / body.constants->mass[i]};
  const ContactLaw<double>& law = side.state.laws[c.body];
  const Parting parting = partingOf(body, i, out.x, side, work);
  out.resting = parting.resting;
  if (!c.touching && corners.empty() && work.faces.hits().empty() && !(work.faces.deepest() > 0)) {
    stayClear();
    return false;
  }
  const PartingMotion fragment{turn.transpose() * parting.centre, turn.transpose() * parting.spin,
                               parting.jolt, parting.share};
  const double fastest = own.centre.norm() + own.spin.norm() * cells.reach[i];
  out.slipped = sink(c, body, corners, {law, own, moved, 2 * moved * fastest, kMostReaches * cells.reach[i]},
                     fragment, side, turn, work.faces);
  const FacePress press = facePress(work.faces.hits(), law, own, {work.moved, work.steps.next});
  if (!(press.weight > 0)) {
    out.slipped += lostAtParting(law, velocity, motion.spin, moved, c.memory);
    return false;
  }
  out.weight = press.stiffness;
  const Eigen::Vector3d arm = turn * press.at;
  out.at = out.x + arm;
  motion.normal = turn * press.normal;
  motion.approach = velocity + motion.spin.cross(arm);
  // Faces resist rolling by their shape; what is left is twisting, by their friction.
  motion.spin = motion.normal * motion.normal.dot(motion.spin);
  finish<Real>(motion, faceLoad(press, law, turn, motion, moved, c.memory), out);
  return true;
}

}  // namespace

template <class Real>
ElementPose poseOf(const Body<Real>& body, std::uint32_t element, const RigidProxy& proxy) {
  const Eigen::Vector3d x = body.state.origin + body.work.position[element];
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  return {back * (x - proxy.position), (back * body.orientation(element)).toRotationMatrix()};
}

// A turn by an angle takes no point further than 2 sin(angle / 2) of its distance from the centre.
template <class Real>
bool isApart(const RigidContact& contact, const Body<Real>& body, const RigidProxy& proxy) {
  const std::uint32_t i = contact.element;
  const Clearance& clear = contact.clear;
  const double left = clear.gap - kCornerSlack * std::sqrt(body.constants->cells->unit);
  if (!(left > 0) || contact.touching || contact.cornered || clear.area != body.state.exposure.area[i])
    return false;
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  const double moved =
      (back * (body.state.origin + body.work.position[i] - proxy.position) - clear.at).norm();
  if (!(moved < left)) return false;
  const double turned = 2 * (back * body.orientation(i) * clear.turn.conjugate()).vec().norm();
  return moved + turned * body.constants->cells->reach[i] < left;
}

template <class Real>
void findCorners(const Body<Real>& body, const RigidContact& contact, const RigidProxy& proxy,
                 FaceTouch& faces) {
  const std::uint32_t element = contact.element;
  const ElementPose pose = poseOf(body, element, proxy);
  const double reach = body.state.exposure.count[element] > 0 ? body.constants->cells->reach[element] : 0;
  faces.approach(proxy, pose.at, reach);
  faces.findCorners(*body.constants->cells, body.state.exposure, element, pose, contact.cornered);
}

template <class Real>
bool touchRigid(RigidContact& contact, const Body<Real>& body, const RigidSide& side,
                std::span<const CornerHit> corners, const TouchWork& work, RigidTouch& out) {
  if (!body.state.alive[contact.element]) return false;
  return body.constants->cells ? touchFaces(contact, body, side, corners, work, out)
                               : touchSphere(contact, body, side, work, out);
}

template ElementPose poseOf(const Body<float>&, std::uint32_t, const RigidProxy&);
template ElementPose poseOf(const Body<double>&, std::uint32_t, const RigidProxy&);
template bool isApart(const RigidContact&, const Body<float>&, const RigidProxy&);
template bool isApart(const RigidContact&, const Body<double>&, const RigidProxy&);
template void findCorners(const Body<float>&, const RigidContact&, const RigidProxy&, FaceTouch&);
template void findCorners(const Body<double>&, const RigidContact&, const RigidProxy&, FaceTouch&);
template bool touchRigid(RigidContact&, const Body<float>&, const RigidSide&, std::span<const CornerHit>,
                         const TouchWork&, RigidTouch&);
template bool touchRigid(RigidContact&, const Body<double>&, const RigidSide&, std::span<const CornerHit>,
                         const TouchWork&, RigidTouch&);

}  // namespace rubble::edem
