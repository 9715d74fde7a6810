// A Bullet world over a plane.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "rubble/destruction.h"

namespace rubble::stability {

struct BulletWorld {
  BulletWorld() { ground = add(0, groundShape, {0, 0, 0}); }
  ~BulletWorld() { clear(); }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  /// `shape` must outlive the world, which has the body.
  btRigidBody* add(btScalar mass, btCollisionShape& shape, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    auto* body = new btRigidBody(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, &shape, inertia));
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    world.addRigidBody(body);
    return body;
  }
  void remove(btCollisionObject* object) {
    world.removeCollisionObject(object);
    delete object;
  }
  /// Everything; by whoever's shapes do not outlive the world.
  void clear() {
    destruction.reset();
    while (world.getNumCollisionObjects() > 0) remove(world.getCollisionObjectArray()[0]);
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btStaticPlaneShape groundShape{{0, 1, 0}, 0};
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<Destruction> destruction;  ///< null: stock Bullet
  btRigidBody* ground = nullptr;
};

}  // namespace rubble::stability
