// What the application does to a body through Bullet while its elements move it: velocities, impulses, forces
// and places that it sets act on all elements as one.
#include <LinearMath/btQuickprof.h>

#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

bool isFinite(const btRigidBody& body) {
  return toEigen(body.getWorldTransform()).matrix().allFinite() &&
         toEigen(body.getLinearVelocity()).allFinite() && toEigen(body.getAngularVelocity()).allFinite() &&
         toEigen(body.getTotalForce()).allFinite() && toEigen(body.getTotalTorque()).allFinite() &&
         toEigen(body.getGravity()).allFinite();
}

// Of the application: Bullet adds what gravity of the body's own does, unless the body slept [N].
btVector3 forceOn(const btRigidBody& body) {
  constexpr btScalar kRounding = btScalar(1e-5);   // of Bullet's product
  if (!(body.getInvMass() > 0)) return {0, 0, 0};  // all of it is crushed
  const btVector3& all = body.getTotalForce();
  const btVector3 weight = body.getGravity() / body.getInvMass() * body.getLinearFactor();
  const btVector3 force = all - weight;
  return all.isZero() || force.length() <= kRounding * weight.length() ? btVector3(0, 0, 0) : force;
}

// By which it moves what Bullet sees. Nothing is turned that was not.
Eigen::Isometry3d wayFrom(const btTransform& shown, const btTransform& place) {
  Eigen::Isometry3d way = Eigen::Isometry3d::Identity();
  if (!(place.getBasis() == shown.getBasis()))
    way.linear() = toEigen(place).linear() * toEigen(shown).linear().transpose();
  way.translation() = toEigen(place.getOrigin()) - way.linear() * toEigen(shown.getOrigin());
  return way;
}

}  // namespace

// Of the body's own [m/s^2], in place of the world's; the elements have it from here on.
std::optional<btVector3> Destruction::Impl::takeGravity(DestructibleBody& body) {
  const std::optional<btVector3> own = bullet::ownGravity(body, world.getGravity());
  std::optional<Eigen::Vector3d> felt;
  if (own) felt = toEigen(btVector3(*own * body.getLinearFactor()));
  if (solver->setGravity(body.id(), felt)) body.activate(true);
  return own;
}

void Destruction::Impl::takeHostMoves(double dt) {
  BT_PROFILE("Rubble take host moves");
  for (DestructibleBody* body : elementBodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (own.state != DestructibleBody::Impl::State::Elements || !isFinite(*body)) continue;
    takeGravity(*body);
    // Bullet stops what it puts to sleep, and lets no force act on it.
    const bool sleeps = solver->view(own.id).asleep && !body->isActive();
    if (sleeps) own.shownVelocity = own.shownSpin = {0, 0, 0};
    const btVector3 velocity = body->getLinearVelocity() - own.shownVelocity,
                    spin = body->getAngularVelocity() - own.shownSpin;
    const btVector3 force = forceOn(*body);
    const btTransform& place = body->getWorldTransform();
    const bool moved = !(place == own.shownPlace), set = !velocity.isZero() || !spin.isZero(),
               forced = !sleeps && (!force.isZero() || !body->getTotalTorque().isZero());
    if (!moved && !set && !forced) continue;
    body->activate(true);
    solver->setAsleep(own.id, false);
    if (moved) {
      energyBalance.beginAnew();
      solver->move(own.id, wayFrom(own.shownPlace, place));
      if (own.anchorBody.body) bullet::holdAnew(own.anchorBody, solver->heldFrame(own.id));
      own.shape->follow();
    }
    if (set || forced) {
      const edem::RigidMotion motion = solver->motion(own.id, own.shown.fragment);
      if (!(motion.mass > 0)) continue;
      Eigen::Vector3d dv = toEigen(velocity), dw = toEigen(spin);
      if (forced) {
        dv += dt / motion.mass * toEigen(force);
        dw += dt * motion.inertia.ldlt().solve(toEigen(body->getTotalTorque()));
      }
      solver->pushAll(own.id, own.shown.fragment, dv, dw);
    }
    // What it moves with from here on meets what is fast, too.
    own.speed = solver->maxSpeed(own.id);
    own.shape->refit(own.speed * dt);
  }
}

RUBBLE_ABI_END
}  // namespace rubble
