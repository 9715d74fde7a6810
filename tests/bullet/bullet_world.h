// A Bullet world with a destructible wall, a ball and the ground, for tests.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "rubble/destruction.h"
#include "support/strict_cook.h"

namespace rubble::test {

/// 0.5 x 0.5 x 0.08 m of 256 elements, anchored at its foot.
inline std::shared_ptr<const Asset> smallWall() {
  static const auto asset = [] {
    CookOptions options;
    options.elements = 256;
    options.anchorDirection = Eigen::Vector3d(0, -1, 0);
    return std::make_shared<const Asset>(cookStrictly(boxMesh({0.5, 0.5, 0.08}, {0, 0.25, 0}), options));
  }();
  return asset;
}

struct BulletWorld {
  /// A warning fails the test unless `def` brings a log of its own.
  explicit BulletWorld(DestructionDef def = {}) {
    world.setGravity({0, btScalar(-9.81), 0});
    ground = add(0, groundShape, {0, 0, 0});
    if (!def.log) def.log = strictLog();
    destruction = std::make_unique<Destruction>(world, def);
  }
  ~BulletWorld() {
    destruction.reset();
    while (world.getNumCollisionObjects() > 0) {
      btCollisionObject* object = world.getCollisionObjectArray()[0];
      world.removeCollisionObject(object);
      delete object;
    }
  }
  btRigidBody* add(btScalar mass, btCollisionShape& shape, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    auto* body = new btRigidBody(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, &shape, inertia));
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    world.addRigidBody(body);
    return body;
  }
  DestructibleBody* addWall(const Material& material) {
    DestructibleBodyDef def;
    def.asset = smallWall();
    def.material = material;
    return destruction->addBody(def);
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btStaticPlaneShape groundShape{{0, 1, 0}, 0};
  btSphereShape ballShape{btScalar(0.1)};
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<Destruction> destruction;
  btRigidBody* ground = nullptr;
};

}  // namespace rubble::test
