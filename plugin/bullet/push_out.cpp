#include "bullet/push_out.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

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

}  // namespace

void PushOut::limit(btDynamicsWorld& world, double dt) {
  m_limited.clear();
  if (!(dt > 0)) return;
  const btContactSolverInfo& info = world.getSolverInfo();
  const btScalar step = btScalar(dt);
  const btScalar longest = btScalar(this->longest(info, dt));
  constexpr int kOwn = BT_CONTACT_FLAG_HAS_CONTACT_ERP | BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING;
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (!isWhole(manifold.getBody0()) && !isWhole(manifold.getBody1())) continue;
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      btManifoldPoint& point = manifold.getContactPoint(p);
      const btScalar depth = -point.getDistance() - info.m_linearSlop;
      // Deeper than the threshold it moves them without a velocity, and lifts what has weight.
      const bool splits = info.m_splitImpulse && -depth <= info.m_splitImpulsePenetrationThreshold;
      if (!(depth > 0) || point.m_contactPointFlags & kOwn) continue;
      const btScalar parts = restitutionSpeed(manifold, point, info.m_restitutionVelocityThreshold);
      const Limited was{&point, point.m_combinedRestitution};
      if (splits) {
        const btScalar lift = info.m_erp2 * depth * btFabs(world.getGravity().dot(point.m_normalWorldOnB));
        if (!(parts > 0) || !(lift > 0)) continue;
        point.m_combinedRestitution *= btSqrt(std::max(btScalar(0), 1 - 2 * lift / (parts * parts)));
      } else {
        const btScalar erp = std::max(btScalar(0), info.m_erp2 * step / longest - parts * step / depth);
        if (!(erp < info.m_erp2)) continue;
        point.m_contactERP = erp;
        point.m_contactPointFlags |= BT_CONTACT_FLAG_HAS_CONTACT_ERP;
      }
      m_limited.push_back(was);
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
      point.m_contactPointFlags &= ~BT_CONTACT_FLAG_HAS_CONTACT_ERP;
      point.m_contactERP = 0;
    }
  }
  m_limited.clear();
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
