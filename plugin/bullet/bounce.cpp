#include "bullet/bounce.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// One side of a hit: nothing for what is no rigid body, which stands.
struct Side {
  const btRigidBody* body;
  btVector3 arm;

  Side(const btCollisionObject* object, const btVector3& at) : body(btRigidBody::upcast(object)) {
    if (body) arm = at - body->getCenterOfMassPosition();
  }
  btVector3 velocity() const { return body ? body->getVelocityInLocalPoint(arm) : btVector3(0, 0, 0); }
  // Velocity at the point along `d` by a unit impulse along `e` [1/kg].
  btScalar mobility(const btVector3& d, const btVector3& e) const {
    if (!body || !(body->getInvMass() > 0)) return 0;
    return body->getInvMass() * d.dot(e) + arm.cross(d).dot(body->getInvInertiaTensorWorld() * arm.cross(e));
  }
};

}  // namespace

// By impulses P along the normal and against the sliding, with the mobilities K: u' = u + K P, and the energy
// changes by P . (u + u') / 2. The hit sets u'_n = -e u_n, friction u'_t = 0 or P_t = -mu P_n.
btScalar boundedRestitution(const btPersistentManifold& manifold, const btManifoldPoint& point) {
  const btScalar own = point.m_combinedRestitution;
  const Side a(manifold.getBody0(), point.getPositionWorldOnA());
  const Side b(manifold.getBody1(), point.getPositionWorldOnB());
  const btVector3 n = point.m_normalWorldOnB, u = a.velocity() - b.velocity();
  const btScalar nears = -u.dot(n);
  const btVector3 sliding = u + nears * n;
  const btScalar slides = sliding.length();
  if (!(own > 0) || !(nears > 0) || !(slides > 0)) return own;
  const btVector3 t = sliding / slides;
  const btScalar nn = a.mobility(n, n) + b.mobility(n, n), nt = a.mobility(n, t) + b.mobility(n, t),
                 tt = a.mobility(t, t) + b.mobility(t, t), determinant = nn * tt - nt * nt;
  if (!(determinant > 0)) return own;
  const btScalar parts = (1 + own) * nears;
  // The impulses that stop the sliding, up to a factor.
  const btScalar along = tt * parts + nt * slides, against = nt * parts + nn * slides;
  const btScalar friction = against < 0 ? -point.m_combinedFriction : point.m_combinedFriction;
  btScalar most = own;
  if (along > 0 && btFabs(against) <= btFabs(friction) * along) {
    const btScalar square = 1 + slides * (2 * nt * nears + nn * slides) / (tt * nears * nears);
    most = btSqrt(std::max(btScalar(0), square));
  } else if (const btScalar push = nn - friction * nt; push > 0) {
    const btScalar both = push - friction * (nt - friction * tt);
    most = 2 * (nears + friction * slides) * push / (both * nears) - 1;
  }
  return std::clamp(most, btScalar(0), own);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
