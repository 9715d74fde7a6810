#include "bullet/element_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletSoftBody/btSoftBody.h>

#include <memory>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/near_points.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Notes who is near for the substeps, and writes manifold points for the application; Bullet's solver leaves
// these alone (DestructibleBody's contactProcessingThreshold). Two destructibles touch by their elements and
// have no manifold points. Stays small: Bullet makes algorithms in a pool of fixed pieces and does not check
// (192 bytes by default).
class ElementAlgorithm : public btCollisionAlgorithm {
 public:
  ElementAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
                   const btCollisionObjectWrapper* second, bool isQuery)
      : btCollisionAlgorithm(info), m_isQuery(isQuery) {
    m_manifold = m_dispatcher->getNewManifold(first->getCollisionObject(), second->getCollisionObject());
  }
  // The two part, or one of them leaves the world: what sleeps on the other would hang in the air.
  ~ElementAlgorithm() override {
    if (m_touching) {
      const_cast<btCollisionObject*>(m_manifold->getBody0())->activate();
      const_cast<btCollisionObject*>(m_manifold->getBody1())->activate();
    }
    m_dispatcher->releaseManifold(m_manifold);
  }

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    const btCollisionObject *a = first->getCollisionObject(), *b = second->getCollisionObject();
    const DestructibleBody *ownA = upcastElements(a), *ownB = upcastElements(b);
    m_manifold->clearManifold();  // elements move within their body's frame: no point outlives a tick
    m_touching = !m_isQuery && ownA && ownB;  // as far as is known without a look at all their elements
    if (!ownA == !ownB) return;
    if (const btSoftBody* soft = btSoftBody::upcast(ownA ? b : a)) {
      if (!m_isQuery) meet(ownA ? *ownA : *ownB, *soft, info);
      return;
    }
    if (!m_isQuery) note(ownA ? *ownA : *ownB, ownA ? *b : *a);
    result->setPersistentManifold(m_manifold);
    const double margin = m_isQuery ? double(result->m_closestPointDistanceThreshold)
                                    : double(m_manifold->getContactBreakingThreshold());
    const DestructibleBody& own = ownA ? *ownA : *ownB;
    if (!implOf(own).world) return;
    for (const NearPoint& p : m_isQuery ? nearCells(own, ownA ? *second : *first, margin)
                                        : nearSpheres(own, ownA ? *b : *a, margin, m_resting)) {
      // Bullet wants the point on the second object, and the normal from it to the first.
      if (!m_isQuery) m_touching = m_touching || p.distance < implOf(own).shape->margin();
      const Eigen::Vector3d onElement = p.point + p.distance * p.normal;
      result->addContactPoint(toBullet(ownB ? Eigen::Vector3d(-p.normal) : p.normal),
                              toBullet(ownB ? onElement : p.point), btScalar(p.distance));
    }
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override { manifolds.push_back(m_manifold); }

 private:
  static void note(const DestructibleBody& own, const btCollisionObject& other) {
    // A character walks by its ghost's sweeps, sinks into what it stands on and would crush it.
    const bool isGhost = other.getInternalType() == btCollisionObject::CO_GHOST_OBJECT;
    if (isGhost || !other.hasContactResponse()) return;
    implOf(const_cast<DestructibleBody&>(own)).near.push_back(const_cast<btCollisionObject*>(&other));
  }

  static void meet(const DestructibleBody& own, const btSoftBody& soft, const btDispatcherInfo& info) {
    if (Destruction::Impl* world = implOf(own).world)
      world->softContacts.meet(const_cast<DestructibleBody&>(own), const_cast<btSoftBody&>(soft),
                               double(info.m_timeStep));
  }

  btPersistentManifold* m_manifold;
  std::unique_ptr<RestingPoints> m_resting;  // once something of the body has fallen asleep
  bool m_isQuery;
  bool m_touching = false;  // when last looked at
};

}  // namespace

btCollisionAlgorithm* ElementAlgorithms::CreateFunc::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
    const btCollisionObjectWrapper* second) {
  static_assert(sizeof(ElementAlgorithm) <= 64);
  void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(ElementAlgorithm));
  return new (memory) ElementAlgorithm(info, first, second, isQuery);
}

ElementAlgorithms::ElementAlgorithms(btCollisionDispatcher& dispatcher) : m_dispatcher(dispatcher) {
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    for (const auto& [a, b] : {std::pair(FAST_CONCAVE_MESH_PROXYTYPE + 0, type),
                               std::pair(type, FAST_CONCAVE_MESH_PROXYTYPE + 0)}) {
      dispatcher.registerCollisionCreateFunc(a, b, &m_contact);
      dispatcher.registerClosestPointsCreateFunc(a, b, &m_query);
    }
  }
}

ElementAlgorithms::~ElementAlgorithms() {
  btCollisionConfiguration* stock = m_dispatcher.getCollisionConfiguration();
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    for (const auto& [a, b] : {std::pair(FAST_CONCAVE_MESH_PROXYTYPE + 0, type),
                               std::pair(type, FAST_CONCAVE_MESH_PROXYTYPE + 0)}) {
      m_dispatcher.registerCollisionCreateFunc(a, b, stock->getCollisionAlgorithmCreateFunc(a, b));
      m_dispatcher.registerClosestPointsCreateFunc(a, b, stock->getClosestPointsAlgorithmCreateFunc(a, b));
    }
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
