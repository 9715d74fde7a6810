// Bullet's narrowphase for pairs with a destructible body: it notes who is near for the substeps, and shows
// applications and contactTest where bodies touch.
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Registers the algorithm for (destructible, anything) with one dispatcher, and puts back what was there
/// when destroyed.
class ElementAlgorithms {
 public:
  explicit ElementAlgorithms(btCollisionDispatcher& dispatcher);
  ~ElementAlgorithms();
  ElementAlgorithms(const ElementAlgorithms&) = delete;
  ElementAlgorithms& operator=(const ElementAlgorithms&) = delete;

 private:
  struct CreateFunc : btCollisionAlgorithmCreateFunc {
    explicit CreateFunc(bool query) : isQuery(query) {}
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* first,
                                                   const btCollisionObjectWrapper* second) override;
    bool isQuery;  // contactTest and its like must not touch the simulation
  };

  btCollisionDispatcher& m_dispatcher;
  CreateFunc m_contact{false};
  CreateFunc m_query{true};
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
