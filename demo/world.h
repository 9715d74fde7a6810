// A Bullet world built from a scene, and the owner of everything in it.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <string>
#include <vector>

#include "demo/cooked_objects.h"
#include "demo/scene.h"
#include "rubble/destruction.h"

namespace rubble::demo {

class World {
 public:
  /// Throws InputError when the library refuses the scene.
  World(const Scene& scene, const Assets& assets, const LogFunction& log = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Advances one frame, that is a few of Bullet's ticks. Throws RunStopped when the library's guard stopped
  /// it.
  void step();

  const Scene& scene() const { return m_scene; }
  btDiscreteDynamicsWorld& bullet() { return *m_world; }
  Destruction& destruction() { return *m_destruction; }
  const Destruction& destruction() const { return *m_destruction; }
  /// The scene's impactors in its order, then those shot later.
  const std::vector<btRigidBody*>& impactors() const { return m_impactors; }
  const std::vector<btRigidBody*>& statics() const { return m_statics; }

  /// Adds a moving body, as the viewer does when it shoots a ball.
  btRigidBody* addImpactor(const SceneBody& def);

  /// EDEM substeps of the last frame, summed over its ticks, and their mean length [s].
  int substeps() const { return m_substeps; }
  double substepLength() const { return m_substepLength; }

  /// FNV-1a over the elements and springs of all bodies and the transforms of all of Bullet's rigid bodies.
  std::uint64_t hash() const;

 private:
  // An empty world. Made first, so that whatever fails after it, the whole is taken down.
  World(const Scene& scene, const LogFunction& log);
  void addObject(const SceneObject& object, std::shared_ptr<const Asset> asset);
  btRigidBody* addBody(const SceneBody& def);
  // What the scene names `statics.1`; null for an empty name.
  btRigidBody* bodyNamed(const std::string& path) const;
  void finishTick(double seconds);

  Scene m_scene;
  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btDbvtBroadphase m_broadphase;
  btSequentialImpulseConstraintSolver m_solver;
  std::vector<std::unique_ptr<btCollisionShape>> m_shapes;  // outlive the bodies that use them
  std::unique_ptr<btDiscreteDynamicsWorld> m_world;
  std::unique_ptr<Destruction> m_destruction;
  std::vector<btRigidBody*> m_impactors;
  std::vector<btRigidBody*> m_statics;
  int m_substeps = 0;
  double m_simulated = 0;  // in this frame [s]
  double m_substepLength = 0;
};

}  // namespace rubble::demo
