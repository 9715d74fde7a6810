#include "demo/stability/rigid_books.h"

#include <algorithm>
#include <cmath>

namespace rubble::stability {

double kineticEnergy(const std::vector<const btRigidBody*>& bodies) {
  double sum = 0;
  for (const btRigidBody* body : bodies) {
    const btVector3 w = body->getAngularVelocity();
    const btMatrix3x3& turn = body->getWorldTransform().getBasis();
    const btVector3 local = w * turn, inverse = body->getInvInertiaDiagLocal();
    for (int a = 0; a < 3; ++a)
      if (inverse[a] > 0) sum += 0.5 * double(local[a] * local[a]) / double(inverse[a]);
    sum += 0.5 / double(body->getInvMass()) * double(body->getLinearVelocity().length2());
  }
  return sum;
}

bool isFinite(const btRigidBody& body) {
  const btVector3 &x = body.getWorldTransform().getOrigin(), &v = body.getLinearVelocity(),
                  &w = body.getAngularVelocity();
  for (int a = 0; a < 3; ++a)
    if (!std::isfinite(x[a]) || !std::isfinite(v[a]) || !std::isfinite(w[a])) return false;
  return true;
}

void WeightBooks::begin(const std::vector<const btRigidBody*>& bodies) {
  m_before.clear();
  for (const btRigidBody* body : bodies)
    m_before[body] = {body->getWorldTransform().getOrigin(), body->getLinearVelocity(),
                      body->getTotalForce()};
}

double WeightBooks::work(const std::vector<const btRigidBody*>& bodies, double gravity, double dt) const {
  double sum = 0;
  for (const btRigidBody* body : bodies) {
    const auto before = m_before.find(body);
    if (before == m_before.end()) continue;
    const auto& [at, speed, force] = before->second;
    const double mass = 1 / double(body->getInvMass());
    const btVector3 pull = force + btVector3(0, btScalar(-mass * gravity), 0);
    const double way = double(pull.dot(body->getWorldTransform().getOrigin() - at));
    const double mean = 0.5 * dt * double(pull.dot(body->getLinearVelocity() + speed));
    const double free = dt * double(pull.dot(speed)) + 0.5 * dt * dt / mass * double(pull.length2());
    sum += std::max({way, mean, force.fuzzyZero() ? way : free});
  }
  return sum;
}

double contactWork(const btRigidBody& kinematic, btDispatcher& dispatcher) {
  double sum = 0;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const double side = manifold.getBody0() == &kinematic ? -1 : manifold.getBody1() == &kinematic ? 1 : 0;
    for (int p = 0; side != 0 && p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      const btVector3 onBody0 = point.m_appliedImpulse * point.m_normalWorldOnB +
                                point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
      sum += side * double(onBody0.dot(kinematic.getLinearVelocity()));
    }
  }
  return sum;
}

}  // namespace rubble::stability
