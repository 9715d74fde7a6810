// Which fragments the application's joints hold.
#include <algorithm>
#include <limits>
#include <map>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/coupler_constraint.h"
#include "bullet/joint_frames.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toEigen;

std::uint32_t nearestElement(const edem::Solver& solver, std::uint32_t body, const Eigen::Vector3d& at) {
  const auto alive = solver.view(body).alive;
  std::uint32_t nearest = kNoElement;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < alive.size(); ++i) {
    if (!alive[i]) continue;
    const double away = (solver.position(body, i) - at).squaredNorm();
    if (away < least) {
      least = away;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

// What the world has now; what is known from the last tick stays known.
void Destruction::Impl::gatherJoints() {
  std::swap(joints, lastJoints);
  joints.clear();
  for (DestructibleBody* body : bodies) implOf(*body).jointed = false;
  for (int i = 0; i < world.getNumConstraints(); ++i) {
    btTypedConstraint* joint = world.getConstraint(i);
    if (!joint->isEnabled() || dynamic_cast<bullet::CouplerConstraint*>(joint)) continue;
    bullet::HeldJoint held;
    held.joint = joint;
    held.ends[0].body = upcastElements(&joint->getRigidBodyA());
    held.ends[1].body = upcastElements(&joint->getRigidBodyB());
    if (!held.ends[0].body && !held.ends[1].body) continue;
    for (const bullet::HeldJoint& last : lastJoints) {
      if (last.joint != joint) continue;
      for (int e = 0; e < 2; ++e)
        if (held.ends[e].body == last.ends[e].body) held.ends[e] = last.ends[e];
    }
    for (bullet::JointEnd& end : held.ends)
      if (end.body) implOf(*end.body).jointed = true;
    joints.push_back(held);
  }
  for (DestructibleBody* body : bodies) {
    const DestructibleBody::Impl& own = implOf(*body);
    if (!body->isWhole() && (own.jointed || own.shown.fragment != kNoElement)) takeFragment(*body);
  }
}

bool Destruction::Impl::hasJoint(const btTypedConstraint* joint) const {
  for (int i = 0; i < world.getNumConstraints(); ++i)
    if (world.getConstraint(i) == joint) return true;
  return false;
}

// A body is being deleted, perhaps within a tick.
void Destruction::Impl::forgetJointsOf(const DestructibleBody& body) {
  for (auto* all : {&joints, &lastJoints})
    for (bullet::HeldJoint& held : *all) {
      if (held.ends[0].body != &body && held.ends[1].body != &body) continue;
      if (held.lent && hasJoint(held.joint)) held.joint->setJointFeedback(nullptr);
      held = {};
    }
}

// Bullet sees of a body that a joint holds the fragment which is held. Places do not change, frames do.
void Destruction::Impl::takeFragment(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  const std::uint32_t before = own.shown.fragment;
  chooseFragment(body);
  if (own.shown.fragment == before || solver->view(own.id).asleep) return;
  const btTransform place = body.getWorldTransform();
  const edem::RigidMotion motion = solver->motion(own.id, own.shown.fragment);
  if (!(motion.mass > 0)) return;
  const btTransform now = placeOfShown(body, motion);
  own.shownPlace = now;
  body.setWorldTransform(now);
  moveJointFrames(body, now.inverse() * place);
}

// The heaviest that a joint holds. Of two joints that hold what has parted the other lets go: Bullet has one
// body for them.
void Destruction::Impl::chooseFragment(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  const edem::BodyView view = solver->view(own.id);
  std::map<std::uint32_t, double> masses;
  for (bullet::HeldJoint& held : joints)
    for (int e = 0; e < 2; ++e) {
      bullet::JointEnd& end = held.ends[e];
      if (end.body != &body) continue;
      if (end.element == kNoElement || !view.alive[end.element])
        end.element = nearestElement(
            *solver, own.id, toEigen(body.getWorldTransform()) * bullet::pivotOf(*held.joint, e == 0));
      if (end.element != kNoElement) masses[view.fragment[end.element]] = 0;
    }
  own.shown.fragment = kNoElement;
  if (view.fragments <= 1 || masses.empty()) return;
  for (std::size_t i = 0; i < view.alive.size(); ++i)
    if (const auto found = masses.find(view.fragment[i]); view.alive[i] && found != masses.end())
      found->second += view.mass[i];
  const auto lighter = [](const auto& a, const auto& b) { return a.second < b.second; };
  own.shown.fragment = std::max_element(masses.begin(), masses.end(), lighter)->first;
  if (masses.size() == 1) return;
  for (bullet::HeldJoint& held : joints)
    for (bullet::JointEnd& end : held.ends)
      if (end.body == &body && end.element != kNoElement &&
          view.fragment[end.element] != own.shown.fragment) {
        held.joint->setEnabled(false);
        end.impulse = {};
        if (def.log)
          def.log(LogLevel::Info, own.name + ": a joint lets go of a fragment, for another holds a heavier");
      }
}

void Destruction::Impl::moveJointFrames(DestructibleBody& body, const btTransform& by) {
  for (bullet::HeldJoint& held : joints)
    for (int e = 0; e < 2; ++e) {
      if (held.ends[e].body != &body) continue;
      if (const auto frame = bullet::frameOf(*held.joint, e == 0))
        bullet::setFrameOf(*held.joint, e == 0, by * *frame);
    }
}

RUBBLE_ABI_END
}  // namespace rubble
