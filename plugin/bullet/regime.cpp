// Bodies that are Bullet's until they are struck.
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBody.h>
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <utility>

#include "bullet/body_states.h"
#include "bullet/convert.h"
#include "bullet/couplers.h"
#include "bullet/multibody_links.h"
#include "bullet/swept_bodies.h"
#include "bullet/thaw.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

// What Bullet integrates of a body's velocity in a tick besides gravity, which the substeps apply.
btVector3 forcedVelocity(const btRigidBody& body, const btVector3& gravity, btScalar dt) {
  return dt * (body.getInvMass() * body.getTotalForce() * body.getLinearFactor() -
               gravity * body.getLinearFactor());
}

// visit(a, b) for all pairs of objects whose bounds overlap.
template <class Visit>
void visitPairs(btOverlappingPairCache& cache, Visit&& visit) {
  const btBroadphasePair* pairs = cache.getOverlappingPairArrayPtr();
  for (int p = 0; p < cache.getNumOverlappingPairs(); ++p)
    visit(*static_cast<btCollisionObject*>(pairs[p].m_pProxy0->m_clientObject),
          *static_cast<btCollisionObject*>(pairs[p].m_pProxy1->m_clientObject));
}

// Points that Bullet has found with the body: its solver must not see them any more.
void clearManifolds(btDispatcher& dispatcher, const btCollisionObject& object) {
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (manifold.getBody0() == &object || manifold.getBody1() == &object) manifold.clearManifold();
  }
}

// Of a whole body whose elements may stand out of its shape by their radius.
Eigen::AlignedBox3d reachedBox(const DestructibleBody& body, double way) {
  btVector3 low, high;
  body.getCollisionShape()->getAabb(body.getWorldTransform(), low, high);
  const Eigen::Vector3d grow = Eigen::Vector3d::Constant(way + 2 * body.asset()->radius);
  return {toEigen(low) - grow, toEigen(high) + grow};
}

}  // namespace

void Destruction::Impl::beWhole(DestructibleBody& body, const DestructibleBodyDef& bodyDef) {
  DestructibleBody::Impl& own = implOf(body);
  if (own.anchorBody.body) {
    if (def.log)
      def.log(LogLevel::Info, own.name + ": stays elements: its anchors hold to a body that may move");
    return;
  }
  const edem::BodyView view = solver->view(own.id);
  own.whole = wholeShapes.of(own.asset, view.mass, view.inertia);
  own.held = bodyDef.anchored && !own.asset->anchors.empty();
  const char* reason = own.whole.shape ? nullptr : "few convex parts do not fit its solid";
  if (!reason && !solver->park(own.id).has_value()) reason = "it is not one piece";
  if (reason) {
    if (def.log) def.log(LogLevel::Info, own.name + ": is elements from the start: " + reason);
    return;
  }
  own.gauge = std::make_unique<bullet::LoadGauge>(
      bullet::sectionsOf(*own.asset, own.whole.frame, own.whole.elementCentre, view.mass, view.inertia),
      own.material, own.model);
  own.state = DestructibleBody::Impl::State::Whole;
  own.reach = own.whole.shape->getAngularMotionDisc();
  own.strikingSpeed = bullet::strikingSpeed(own.material);
  bullet::beNewRigid(body, bodyDef.transform * toBullet(own.whole.frame));
  if (!def.sleep) body.setActivationState(DISABLE_DEACTIVATION);
  if (own.held) return;
  body.setLinearVelocity(bodyDef.velocity);
  body.setAngularVelocity(bodyDef.spin);
  bullet::limitGyroscopicTerm(body, double(world.getSolverInfo().m_timeStep));
}

void Destruction::Impl::placeWhole(DestructibleBody& body) {
  const Eigen::Isometry3d place = toEigen(body.getWorldTransform()) * implOf(body).whole.frame.inverse();
  solver->place(implOf(body).id, place);
}

bool Destruction::Impl::isStruck(DestructibleBody& body, btCollisionObject& other, double dt) {
  const int kind = other.getInternalType();
  if (kind == btCollisionObject::CO_GHOST_OBJECT) return false;  // presses no elements
  const double least = implOf(body).strikingSpeed;
  const DestructibleBody* elements = upcastElements(&other);
  const double bound = bullet::closingSpeed(body, other, dt).end;
  if (!(bound > least) || !bullet::mayTouch(world, body, other)) return false;
  placeWhole(body);
  if (elements) return bullet::elementsStrike(*solver, elements->id(), proxyMaker.make(body, {}), least, dt);
  if (const btSoftBody* soft = btSoftBody::upcast(&other)) {
    return bullet::pointsStrike(bullet::strikingNodes(*soft, body),
                                double(soft->getCollisionShape()->getMargin()), proxyMaker.make(body, {}),
                                implOf(body).whole.mass / double(solver->view(body.id()).elements()), least,
                                dt);
  }
  const Eigen::AlignedBox3d reached = reachedBox(body, bound * dt);
  edem::RigidProxy partner = proxyMaker.make(other, std::span(&reached, 1));
  if (const auto* link = btMultiBodyLinkCollider::upcast(&other)) bullet::take(*link, dt, partner);
  const bullet::RigidMotion own{toEigen(body.getWorldTransform().getOrigin()),
                                toEigen(body.getLinearVelocity()), toEigen(body.getAngularVelocity()),
                                double(body.getInvMass()) * toEigen(body.getTotalForce())};
  return !partner.parts.empty() && bullet::strikes(*solver, body.id(), own, partner, least, dt);
}

// Before Bullet solves the contacts of this tick.
void Destruction::Impl::thawStruck(double dt) {
  if (coupledWholes == 0) return;
  BT_PROFILE("Rubble thaw struck");
  std::vector<DestructibleBody*> struck;
  bool anyMet = false;
  for (DestructibleBody* body : wholeBodies) {
    if (implOf(*body).struck && struck.size() < std::max(1u, def.maxThaws)) struck.push_back(body);
    anyMet = anyMet || implOf(*body).met;
  }
  const auto look = [&](btCollisionObject& object, btCollisionObject& other) {
    DestructibleBody* body = DestructibleBody::upcast(&object);
    if (!body || !body->isWhole() || !implOf(*body).met ||
        std::find(struck.begin(), struck.end(), body) != struck.end())
      return;
    if (isStruck(*body, other, dt)) struck.push_back(body);
  };
  const auto lookBoth = [&](btCollisionObject& a, btCollisionObject& b) {
    if (!a.hasContactResponse() || !b.hasContactResponse() || (!a.isActive() && !b.isActive())) return;
    look(a, b);
    look(b, a);
  };
  if (anyMet) visitPairs(*world.getPairCache(), lookBoth);
  std::sort(struck.begin(), struck.end(),
            [](const DestructibleBody* a, const DestructibleBody* b) { return a->id() < b->id(); });
  failSpoiled(struck);
  if (!failure.empty()) return;
  for (DestructibleBody* body : struck) thaw(*body, dt);
  if (anyMet) pushOut.limit(world, dt);
}

// The elements take over in this very tick; Bullet's part of the body follows when its tick is over.
void Destruction::Impl::thaw(DestructibleBody& body, double dt) {
  DestructibleBody::Impl& own = implOf(body);
  placeWhole(body);
  const std::optional<btVector3> gravity = takeGravity(body);
  const btVector3 velocity =
      body.getLinearVelocity() + forcedVelocity(body, gravity.value_or(world.getGravity()), btScalar(dt));
  const Eigen::Matrix3d turn = toEigen(body.getWorldTransform()).linear();
  const Eigen::Vector3d spin =
      toEigen(body.getAngularVelocity()) +
      dt * toEigen(btVector3(body.getInvInertiaTensorWorld() * body.getTotalTorque()));
  // About the elements' own centre: what Bullet calls the body's centre may be beside it.
  const Eigen::Vector3d arm = turn * own.whole.elementCentre;
  const Eigen::Vector3d angular =
      turn * (toEigen(own.whole.inertia).asDiagonal() * (turn.transpose() * spin)) -
      arm.cross(own.whole.mass * toEigen(velocity));
  energyBalance.beginAnew();
  solver->unpark(own.id, toEigen(velocity), own.held ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : angular);
  setState(body, DestructibleBody::Impl::State::Thawing);
  couple(body);
  own.shown = {};
  own.shown.frame = own.whole.frame;
  own.struck = false;
  own.restTime = 0;
  if (own.thawLoad > 0) beginEasing(body);
  own.speed = solver->maxSpeed(own.id);
  own.shape->refit(own.speed * dt);
  body.activate(true);
  clearManifolds(*world.getDispatcher(), body);
  visitPairs(*world.getPairCache(), [&](btCollisionObject& a, btCollisionObject& b) {
    if (&a != &body && &b != &body) return;
    btCollisionObject& other = &a == &body ? b : a;
    if (!other.hasContactResponse() || other.getInternalType() == btCollisionObject::CO_GHOST_OBJECT) return;
    if (btSoftBody* soft = btSoftBody::upcast(&other))
      softContacts.takeOver(body, *soft, dt);
    else
      own.near.push_back(&other);
  });
  // Nor may Bullet's own sweeps of this tick stop anything at it.
  own.flags = body.getCollisionFlags();
  bullet::limitGyroscopicTerm(body, 0);
  body.setCollisionFlags(own.flags | btCollisionObject::CF_NO_CONTACT_RESPONSE);
}

// Algorithms are of the shape that it had. Ghosts have pairs of their own beside the world's.
void Destruction::Impl::cleanPairs(DestructibleBody& body) {
  btBroadphaseProxy* handle = body.getBroadphaseHandle();
  world.getPairCache()->cleanProxyFromPairs(handle, world.getDispatcher());
  for (int i = 0; i < world.getNumCollisionObjects(); ++i)
    if (auto* ghost = dynamic_cast<btPairCachingGhostObject*>(world.getCollisionObjectArray()[i]))
      ghost->getOverlappingPairCache()->cleanProxyFromPairs(handle, world.getDispatcher());
}

// Now that Bullet has moved what was in its solver.
void Destruction::Impl::finishThaws() {
  for (DestructibleBody* body : elementBodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (own.state != DestructibleBody::Impl::State::Thawing) continue;
    own.state = DestructibleBody::Impl::State::Elements;
    body->setCollisionFlags(own.flags);
    own.settings = bullet::settingsOf(*body, world.getGravity());
    bullet::beElements(*body);
    cleanPairs(*body);
    world.updateSingleAabb(body);
  }
}

void Destruction::Impl::placeWholes() {
  for (DestructibleBody* body : wholeBodies) placeWhole(*body);
}

RUBBLE_ABI_END
}  // namespace rubble
