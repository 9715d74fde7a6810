#include "bullet/element_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include "bullet/body_impl.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

/// Stays small: Bullet makes algorithms in a pool of fixed pieces and does not check (192 bytes by default).
class ElementAlgorithm : public btCollisionAlgorithm {
 public:
  ElementAlgorithm(const btCollisionAlgorithmConstructionInfo& info, bool isQuery)
      : btCollisionAlgorithm(info), m_isQuery(isQuery) {}

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo&, btManifoldResult*) override {
    if (m_isQuery) return;
    note(first->getCollisionObject(), second->getCollisionObject());
    note(second->getCollisionObject(), first->getCollisionObject());
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray&) override {}

 private:
  static void note(const btCollisionObject* own, const btCollisionObject* other) {
    const DestructibleBody* body = DestructibleBody::upcast(own);
    if (!body || DestructibleBody::upcast(other)) return;  // two destructibles touch by their elements
    if (!other->hasContactResponse()) return;
    const_cast<DestructibleBody*>(body)->impl().near.push_back(const_cast<btCollisionObject*>(other));
  }

  bool m_isQuery;
};

}  // namespace

btCollisionAlgorithm* ElementAlgorithms::CreateFunc::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper*,
    const btCollisionObjectWrapper*) {
  static_assert(sizeof(ElementAlgorithm) <= 64);
  void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(ElementAlgorithm));
  return new (memory) ElementAlgorithm(info, isQuery);
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
}  // namespace rubble
