// A Bullet world with a destructible wall, a ball and the ground, for tests.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <functional>
#include <memory>
#include <utility>

#include "demo/stability/bullet_world.h"
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

// An action of the application that comes before ours, within the tick that Bullet has solved the joint in.
struct Takes : btActionInterface {
  explicit Takes(std::function<void()> what) : take(std::move(what)) {}
  void updateAction(btCollisionWorld*, btScalar) override {
    if (take) std::exchange(take, nullptr)();
  }
  void debugDraw(btIDebugDraw*) override {}
  std::function<void()> take;
};

struct BulletWorld : stability::BulletWorld {
  /// A warning fails the test unless `def` brings a log of its own.
  explicit BulletWorld(DestructionDef def = {}) {
    world.setGravity({0, btScalar(-9.81), 0});
    if (!def.log) def.log = strictLog();
    destruction = std::make_unique<Destruction>(world, def);
  }
  ~BulletWorld() { clear(); }
  DestructibleBody* addWall(const Material& material) {
    DestructibleBodyDef def;
    def.regime = Regime::Elements;
    def.asset = smallWall();
    def.material = material;
    return destruction->addBody(def);
  }

  void actFirst(btActionInterface& action) {
    world.removeAction(destruction.get());
    world.addAction(&action);
    world.addAction(destruction.get());
  }

  btSphereShape ballShape{btScalar(0.1)};
};

}  // namespace rubble::test
