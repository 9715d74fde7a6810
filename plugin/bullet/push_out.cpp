#include "bullet/push_out.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

#include "bullet/bounce.h"
#include "rubble/destructible_body.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

bool isWhole(const btCollisionObject* object) {
  const DestructibleBody* body = DestructibleBody::upcast(object);
  return body && body->isWhole();
}

btVector3 velocityAt(const btCollisionObject* object, const btVector3& place) {
  const btRigidBody* body = btRigidBody::upcast(object);
  if (!body) return {0, 0, 0};
  return body->getVelocityInLocalPoint(place - body->getCenterOfMassPosition());
}

// The speed that Bullet's solver lets two bodies part with at a point because of how fast they near there.
btScalar restitutionSpeed(const btPersistentManifold& manifold, const btManifoldPoint& point,
                          btScalar threshold) {
  if (!(point.m_combinedRestitution > 0)) return 0;
  const btScalar nears = (velocityAt(manifold.getBody1(), point.getPositionWorldOnB()) -
                          velocityAt(manifold.getBody0(), point.getPositionWorldOnA()))
                             .dot(point.m_normalWorldOnB);
  return nears < threshold ? 0 : point.m_combinedRestitution * nears;
}

// At a point that overlaps and parts at `parts`: a push out by `share` of Bullet's own, and no more than it
// leaves to that. Whether there is less of something.
bool limitDepth(btManifoldPoint& point, btScalar parts, btScalar share, btScalar step,
                btDynamicsWorld& world) {
  constexpr int kOwn = BT_CONTACT_FLAG_HAS_CONTACT_ERP | BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING;
  const btContactSolverInfo& info = world.getSolverInfo();
  const btScalar depth = -point.getDistance() - info.m_linearSlop;
  if (!(depth > 0) || point.m_contactPointFlags & kOwn) return false;
  // Deeper than the threshold it moves them without a velocity, and lifts what has weight.
  if (info.m_splitImpulse && -depth <= info.m_splitImpulsePenetrationThreshold) {
    const btScalar lift = info.m_erp2 * depth * btFabs(world.getGravity().dot(point.m_normalWorldOnB));
    if (!(parts > 0) || !(lift > 0)) return false;
    point.m_combinedRestitution *= btSqrt(std::max(btScalar(0), 1 - 2 * lift / (parts * parts)));
    return true;
  }
  const btScalar erp = std::max(btScalar(0), info.m_erp2 * share - parts * step / depth);
  if (!(erp < info.m_erp2)) return false;
  point.m_contactERP = erp;
  point.m_contactPointFlags |= BT_CONTACT_FLAG_HAS_CONTACT_ERP;
  return true;
}

}  // namespace

void PushOut::limit(btDynamicsWorld& world, double dt) {
  m_limited.clear();
  if (!(dt > 0)) return;
  const btContactSolverInfo& info = world.getSolverInfo();
  const btScalar step = btScalar(dt), share = btScalar(dt / longest(info, dt));
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (!isWhole(manifold.getBody0()) && !isWhole(manifold.getBody1())) continue;
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      btManifoldPoint& point = manifold.getContactPoint(p);
      const Limited was{&point, point.m_combinedRestitution, point.m_contactERP, point.m_contactPointFlags};
      btScalar parts = restitutionSpeed(manifold, point, info.m_restitutionVelocityThreshold);
      if (parts > 0) {
        const btScalar most = boundedRestitution(manifold, point);
        parts *= most / was.restitution;
        point.m_combinedRestitution = most;
      }
      const bool less = limitDepth(point, parts, share, step, world);
      if (less || point.m_combinedRestitution < was.restitution) m_limited.push_back(was);
    }
  }
  std::ranges::sort(m_limited, {}, &Limited::point);
}

// What overlaps leaves at one speed, by the share erp of the long tick's depth in the time of that tick.
double PushOut::longest(const btContactSolverInfo& info, double dt) const {
  return std::max(dt, m_longest - double(info.m_erp2) * dt);
}

void PushOut::note(const btContactSolverInfo& info, double dt) {
  if (dt > 0) m_longest = longest(info, dt);
}

void PushOut::restore(btDispatcher& dispatcher) {
  if (m_limited.empty()) return;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      btManifoldPoint& point = manifold.getContactPoint(p);
      const auto was = std::ranges::lower_bound(m_limited, static_cast<const btManifoldPoint*>(&point), {},
                                                &Limited::point);
      if (was == m_limited.end() || was->point != &point) continue;
      point.m_combinedRestitution = was->restitution;
      point.m_contactPointFlags = was->flags;
      point.m_contactERP = was->erp;
    }
  }
  m_limited.clear();
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
