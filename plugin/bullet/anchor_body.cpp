#include "bullet/anchor_body.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/rigid_proxies.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

namespace {

// Ticks of one stepSimulation over which a way is spread at most; what is further was put there.
constexpr double kMostTicks = 64;
// A dynamic body is at least this share as heavy as what anchors hold to it: the substeps follow it by its
// mass.
constexpr double kLeastMass = 0.02;

// In how many ticks it comes to where the application has put it.
double ticksTo(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, const btRigidBody& body,
               double dt) {
  const double turn = Eigen::AngleAxisd(to.linear() * from.linear().transpose()).angle();
  const double way = (to.translation() - from.translation()).norm() + turn;
  const double aTick = dt * double(body.getLinearVelocity().length() + body.getAngularVelocity().length());
  const double ticks = std::round(way / aTick);
  return ticks >= 1 && ticks <= kMostTicks ? ticks : 1;
}

}  // namespace

bool isFinite(const btRigidBody& body) {
  return toEigen(body.getWorldTransform()).matrix().allFinite() &&
         toEigen(body.getLinearVelocity()).allFinite() && toEigen(body.getAngularVelocity()).allFinite();
}

bool isRidden(const btRigidBody& body) {
  return !body.isStaticOrKinematicObject() && body.getActivationState() != DISABLE_SIMULATION;
}

void requireAnchorBody(btDiscreteDynamicsWorld& world, btRigidBody& body, double mass) {
  const btCollisionObjectArray& all = world.getCollisionObjectArray();
  if (all.findLinearSearch(&body) == all.size())
    throw Error("anchorBody: is not in the world; add it before what is anchored to it");
  if (DestructibleBody::upcast(&body))
    throw Error("anchorBody: is a destructible body; anchors hold to others");
  if (!isFinite(body)) throw Error("anchorBody: its place or velocity is not finite");
  const double least = kLeastMass * mass;
  if (isRidden(body) && !(double(body.getInvMass()) * least <= 1))
    throw Error("anchorBody: is of " + base::numberText(1 / double(body.getInvMass())) +
                " kg; for what it is to carry it needs " + base::numberText(least));
}

AnchorBody anchorTo(btRigidBody& body, const edem::Frame& frame) {
  AnchorBody anchor;
  anchor.body = &body;
  anchor.number = body.getBroadphaseHandle()->m_uniqueId;
  anchor.at = toEigen(body.getWorldTransform());
  holdAnew(anchor, frame);
  return anchor;
}

bool isThere(const btDiscreteDynamicsWorld& world, const AnchorBody& anchor) {
  const btCollisionObjectArray& all = world.getCollisionObjectArray();
  btCollisionObject* object = anchor.body;
  return all.findLinearSearch(object) < all.size() &&
         anchor.body->getBroadphaseHandle()->m_uniqueId == anchor.number;
}

edem::Twist motionAt(const btRigidBody& body, const Eigen::Vector3d& point) {
  if (!body.isKinematicObject() && body.isStaticObject()) return {};
  const Eigen::Vector3d arm = point - toEigen(body.getWorldTransform().getOrigin()),
                        spin = toEigen(body.getAngularVelocity());
  return {toEigen(body.getLinearVelocity()) + spin.cross(arm), spin};
}

edem::Frame follow(AnchorBody& anchor, double dt) {
  if (toEigen(anchor.body->getWorldTransform()).matrix().allFinite()) {
    const Eigen::Isometry3d to = toEigen(anchor.body->getWorldTransform());
    const double ticks = ticksTo(anchor.at, to, *anchor.body, dt);
    if (ticks > 1) {
      const Eigen::Quaterniond from(anchor.at.linear());
      const Eigen::Vector3d way = (to.translation() - anchor.at.translation()) / ticks;
      anchor.at.linear() =
          from.slerp(1 / ticks, Eigen::Quaterniond(to.linear())).normalized().toRotationMatrix();
      anchor.at.translation() += way;
    } else {
      anchor.at = to;
    }
  }
  const Eigen::Isometry3d frame = anchor.at * anchor.hold;
  return {frame.translation(), Eigen::Quaterniond(frame.linear()).normalized()};
}

edem::Frame frameOn(AnchorBody& anchor) {
  anchor.at = toEigen(anchor.body->getWorldTransform());
  const Eigen::Quaterniond turn(anchor.at.linear());
  const edem::Frame hold = holdOf(anchor);
  return {anchor.at.translation() + turn * hold.origin, (turn * hold.turn).normalized()};
}

edem::Frame holdOf(const AnchorBody& anchor) {
  return {anchor.hold.translation(), Eigen::Quaterniond(anchor.hold.linear()).normalized()};
}

void wakeTogether(btRigidBody& body, btRigidBody& base) {
  if (body.isActive() == base.isActive()) return;
  for (btRigidBody* one : {&body, &base})
    if (!one->isActive()) one->activate(true);
}

void waitTogether(btRigidBody& body, btRigidBody& base) {
  const btScalar still = std::min(body.getDeactivationTime(), base.getDeactivationTime());
  for (btRigidBody* one : {&body, &base}) {
    one->setDeactivationTime(still);
    if (one->getActivationState() == WANTS_DEACTIVATION && still < gDeactivationTime)
      one->setActivationState(ACTIVE_TAG);
  }
}

void holdAnew(AnchorBody& anchor, const edem::Frame& frame) {
  anchor.hold = anchor.at.inverse(Eigen::Isometry) * isometryOf(frame);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet

namespace rubble {
RUBBLE_ABI_BEGIN

void Destruction::Impl::setAnchorBody(DestructibleBody& body, btRigidBody* base, const edem::Twist& motion) {
  energyBalance.beginAnew();
  DestructibleBody::Impl& own = implOf(body);
  own.anchorBody = {};
  if (base) own.anchorBody = bullet::anchorTo(*base, solver->heldFrame(own.id));
  solver->setBase(own.id, motion);
}

void Destruction::Impl::carryAnchored(double dt) {
  for (DestructibleBody* body : elementBodies) {
    DestructibleBody::Impl& own = implOf(*body);
    bullet::AnchorBody& anchor = own.anchorBody;
    if (!anchor.body) continue;
    if (!bullet::isThere(world, anchor)) {
      anchor.body = nullptr;
      solver->carry(own.id, solver->heldFrame(own.id));
      if (def.log)
        def.log(LogLevel::Info, own.name +
                                    ": the body that its anchors hold to has left the world: they hold "
                                    "where they are");
      continue;
    }
    if (bullet::isRidden(*anchor.body)) {
      rideAnchored(*body);
      continue;
    }
    if (std::exchange(anchor.ridden, false))  // it goes on from where the copy was
      anchor.at = bullet::isometryOf(solver->heldFrame(own.id)) * anchor.hold.inverse(Eigen::Isometry);
    if (solver->carry(own.id, bullet::follow(anchor, dt))) body->activate(true);
  }
}

void Destruction::Impl::rideAnchored(DestructibleBody& body) {
  DestructibleBody::Impl& own = implOf(body);
  bullet::AnchorBody& anchor = own.anchorBody;
  anchor.ridden = solver->view(own.id).anchorsIntact > 0 && bullet::isFinite(*anchor.body);
  if (!anchor.ridden) {
    solver->carry(own.id, solver->heldFrame(own.id));
    return;
  }
  bullet::wakeTogether(body, *anchor.body);
  if (body.isActive())
    solver->ride(own.id, bullet::keyOf(*anchor.body), bullet::holdOf(anchor), bullet::frameOn(anchor));
}

// Fastest element of all bodies that ride on an object, and of `own` [m/s].
double Destruction::Impl::speedOn(const btCollisionObject& object, const DestructibleBody& own) const {
  double fastest = solver->maxSpeed(own.id());
  for (const DestructibleBody* body : elementBodies)
    if (implOf(*body).anchorBody.ridden && implOf(*body).anchorBody.is(object))
      fastest = std::max(fastest, solver->maxSpeed(body->id()));
  return fastest;
}

void Destruction::Impl::waitForAnchored() {
  for (DestructibleBody* body : elementBodies) {
    const bullet::AnchorBody& anchor = implOf(*body).anchorBody;
    if (anchor.body && anchor.ridden && body->isActive() && bullet::isThere(world, anchor) &&
        anchor.body->isActive())
      bullet::waitTogether(*body, *anchor.body);
  }
}

// What anchors hold stands or hangs on that body by them.
void Destruction::Impl::bearAnchored() {
  for (const DestructibleBody* body : elementBodies)
    for (std::size_t p = 0; implOf(*body).anchorBody.body && p < proxies.size(); ++p)
      if (implOf(*body).anchorBody.is(*touched[p].object)) proxies[p].bears.push_back(body->id());
}

RUBBLE_ABI_END
}  // namespace rubble
