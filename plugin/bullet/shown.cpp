#include "bullet/shown.h"

#include <algorithm>
#include <array>
#include <map>

#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

std::uint32_t heaviestFragment(const edem::BodyView& view) {
  std::map<std::uint32_t, double> masses;
  for (std::size_t i = 0; i < view.alive.size(); ++i)
    if (view.alive[i]) masses[view.fragment[i]] += view.mass[i];
  const auto lighter = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto heaviest = std::max_element(masses.begin(), masses.end(), lighter);
  return heaviest == masses.end() ? kNoElement : heaviest->first;
}

// To Bullet's joints an anchored body is as heavy as the world.
void holdAnchored(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  const bool fixed = own.jointed && own.shown.anchored;
  if (fixed && !own.fixed) {
    own.freeLinear = body.getLinearFactor();
    own.freeAngular = body.getAngularFactor();
    body.setLinearFactor({0, 0, 0});
    body.setAngularFactor({0, 0, 0});
  } else if (own.fixed && !fixed && (own.jointed || !own.held)) {
    body.setLinearFactor(own.freeLinear);
    body.setAngularFactor(own.freeAngular);
  } else {
    return;
  }
  own.fixed = fixed;
}

}  // namespace

// A body in one piece has the frame that it has as a whole, so that what is fixed in that stays where it is;
// what has lost something has its origin in its centre of mass.
btTransform Destruction::Impl::placeOfShown(DestructibleBody& body, const edem::RigidMotion& motion) const {
  DestructibleBody::Impl& own = implOf(body);
  bullet::Shown& shown = own.shown;
  const edem::BodyView view = solver->view(own.id);
  const std::array damage = {view.broken, view.crushed, view.absentElements};
  if (shown.damage != damage) {
    shown.damage = damage;
    shown.turning = view.fragments > 1 ? heaviestFragment(view) : kNoElement;
  }
  const bool complete = view.fragments == 1 && view.crushed == 0 && view.absentElements == 0;
  const edem::Placement at =
      solver->placement(own.id, shown.fragment != kNoElement ? shown.fragment : shown.turning);
  shown.anchored = at.anchored;
  shown.frame = own.whole.frame;
  if (!complete || !own.whole.shape) shown.frame.translation() = at.restCentre;
  Eigen::Isometry3d place = at.place * shown.frame;
  if (!complete) place.translation() = motion.centre;
  return toBullet(place);
}

// Bullet sees a body of elements where they are, with the mass and the motion of all of them together.
void Destruction::Impl::showElements() {
  for (DestructibleBody* body : elementBodies) showElements(*body);
}

void Destruction::Impl::showElements(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  const edem::BodyView view = solver->view(own.id);
  const bool asShown = view.asleep || (view.lies() && own.lay) || !failure.empty();
  const edem::RigidMotion motion = asShown ? edem::RigidMotion() : solver->motion(own.id, own.shown.fragment);
  const Eigen::Isometry3d frame = own.shown.frame;
  if (motion.mass > 0) own.shownPlace = placeOfShown(body, motion);
  if (own.jointed && !(frame.matrix() == own.shown.frame.matrix()))
    moveJointFrames(body, toBullet(own.shown.frame.inverse(Eigen::Isometry) * frame));
  own.shownVelocity = toBullet(motion.velocity);
  own.shownSpin = toBullet(motion.spin);
  bullet::showInBullet(body, own.shownPlace, own.shownVelocity, own.shownSpin);
  if (!(motion.mass > 0)) return;
  holdAnchored(body);
  // By the diagonal, in the body's axes, of what impulses turn it by.
  const Eigen::Matrix3d axes = toEigen(own.shownPlace).linear();
  const Eigen::Vector3d turns = (axes.transpose() * motion.inertia.inverse() * axes).diagonal();
  body.setMassProps(btScalar(motion.mass), toBullet(Eigen::Vector3d(turns.cwiseInverse())));
  body.updateInertiaTensor();
}

RUBBLE_ABI_END
}  // namespace rubble
