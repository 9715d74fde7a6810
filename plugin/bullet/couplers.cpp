#include "bullet/couplers.h"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBody.h>

#include <mutex>
#include <utility>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/multibody_links.h"
#include "bullet/soft_contacts.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// What a point of an object is at most faster than its centre, by its spin [m/s].
double turning(const btCollisionObject& object, const btVector3& spin) {
  if (spin.fuzzyZero()) return 0;
  const DestructibleBody* body = DestructibleBody::upcast(&object);
  const bool whole = body && body->isWhole();
  return double(spin.length() *
                (whole ? implOf(*body).reach : object.getCollisionShape()->getAngularMotionDisc()));
}

// Velocity of an object's centre, as Bullet has it and at the end of the tick as far as forces go, and what
// its points are faster [m/s].
struct Sweep {
  btVector3 velocity{0, 0, 0}, end{0, 0, 0};
  double turning = 0;

  Sweep(const btCollisionObject& object, double dt) {
    if (const btRigidBody* body = btRigidBody::upcast(&object)) {
      if (object.isStaticObject() && !object.isKinematicObject()) return;
      velocity = body->getLinearVelocity();
      end = velocity + btScalar(dt) * body->getInvMass() * body->getTotalForce();
      turning = bullet::turning(object, body->getAngularVelocity());
    } else if (const auto* link = btMultiBodyLinkCollider::upcast(&object)) {
      const LinkMotion motion = motionOf(*link);
      velocity = end = toBullet(Eigen::Vector3d(motion.head<3>()));
      turning = bullet::turning(object, toBullet(Eigen::Vector3d(motion.tail<3>())));
    } else if (const btSoftBody* soft = btSoftBody::upcast(&object)) {
      turning = fastestNode(*soft);
    }
  }
};

}  // namespace

ClosingSpeed closingSpeed(const DestructibleBody& body, const btCollisionObject& other, double dt) {
  const Sweep sweep(body, dt);
  if (const DestructibleBody* elements = upcastElements(&other)) {
    const double most = sweep.turning + implOf(*elements).speed;
    return {most + double(sweep.velocity.length()), most + double(sweep.end.length())};
  }
  const Sweep partner(other, dt);
  const double most = sweep.turning + partner.turning;
  return {most + double((sweep.velocity - partner.velocity).length()),
          most + double((sweep.end - partner.end).length())};
}

RUBBLE_ABI_END
}  // namespace rubble::bullet

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

// For which a coupler stays that nothing has needed: taking it out is a search through Bullet's list.
constexpr int kIdleTicks = 30;

}  // namespace

// What strikes it would, or what has to be held back of Bullet's push-out.
bool Destruction::Impl::mayMatter(const DestructibleBody& body, const btCollisionObject& other) const {
  if (other.getInternalType() == btCollisionObject::CO_GHOST_OBJECT) return false;  // presses nothing
  const double dt = double(world.getDispatchInfo().m_timeStep);
  const btContactSolverInfo& info = world.getSolverInfo();
  const bullet::ClosingSpeed speed = bullet::closingSpeed(body, other, dt);
  return speed.end > implOf(body).strikingSpeed || speed.now > double(info.m_restitutionVelocityThreshold) ||
         pushOut.isAfterLonger(info, dt);
}

void Destruction::Impl::meet(DestructibleBody& body, const btCollisionObject& other) {
  if (!body.isWhole() || !mayMatter(body, other)) return;
  const std::scoped_lock lock(meeting);  // Bullet's narrowphase may run on several threads
  couple(body);
  implOf(body).met = true;
}

void Destruction::Impl::couple(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  own.idleTicks = 0;
  if (std::exchange(own.coupled, true)) return;
  world.addConstraint(own.coupler.get());
  if (body.isWhole()) ++coupledWholes;
}

void Destruction::Impl::uncouple(DestructibleBody& body) {
  if (!std::exchange(implOf(body).coupled, false)) return;
  world.removeConstraint(implOf(body).coupler.get());
  if (body.isWhole()) --coupledWholes;
}

void Destruction::Impl::uncoupleIdle() {
  if (coupledWholes == 0) return;
  for (DestructibleBody* body : wholeBodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (!own.coupled) continue;
    own.inSolver = false;
    if (!std::exchange(own.met, false) && !own.struck && ++own.idleTicks > kIdleTicks) uncouple(*body);
  }
}

RUBBLE_ABI_END
}  // namespace rubble
