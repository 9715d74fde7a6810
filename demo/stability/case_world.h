// The Bullet world of a case: ground, body, impactor, and what the application does to them.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "demo/stability/bullet_world.h"
#include "demo/stability/case.h"

namespace rubble::stability {

/// What the bodies that can break are made of.
enum class Engine {
  Rubble,
  Stock  ///< a rigid box of Bullet's, of the same size, mass, friction and restitution; nothing breaks
};

class CaseWorld {
 public:
  explicit CaseWorld(const Case& c, Engine engine = Engine::Rubble);

  /// Throws rubble::Error where the library refuses the case. Stock Bullet refuses none.
  void build();
  void step(double dt);
  void happen();
  /// Length of a tick [s].
  double stepOf(int tick) const;

  BulletWorld& bullet() { return m_bullet; }
  const BulletWorld& bullet() const { return m_bullet; }
  /// Dynamic bodies that Bullet moves and whose numbers the application did not spoil: the impactor, whole
  /// bodies, stock bodies.
  std::vector<const btRigidBody*> moved() const;
  /// All whose numbers the application did not spoil.
  std::vector<const btRigidBody*> healthy() const;
  /// That the application moves; null: none.
  const btRigidBody* kinematic() const;
  const std::vector<std::string>& warnings() const { return m_warnings; }

  /// Kinetic and elastic energy of the elements at the start, whole bodies left out [J].
  double elementsPut() const;
  double lightest() const;  ///< element [kg]
  /// What the places of Bullet's bodies, and of elements as they are told, which are floats, may be wrong by
  /// in energy of gravity [J].
  double roundedEnergy() const;

 private:
  DestructionDef definition();
  std::shared_ptr<const Asset> asset(int elements, bool anchored) const;
  void addDestructible(const std::shared_ptr<const Asset>& asset, const Material& material,
                       const btVector3& at, const btVector3& velocity, double spin, bool anchored);
  void addStock(const Asset& asset, const Material& material, const btVector3& at, const btVector3& velocity,
                double spin, bool anchored);
  void addImpactor();
  void addOtherBody();
  std::vector<btRigidBody*> bodies() const;  // those that can break, or stand for them
  void removeBody();

  Case m_case;
  Engine m_engine;
  std::vector<std::string> m_warnings;
  std::vector<std::unique_ptr<btCollisionShape>> m_shapes;  // outlive what has them
  BulletWorld m_bullet;
  std::vector<btRigidBody*> m_stock;
  btRigidBody* m_impactor = nullptr;
  bool m_spoiled = false;                              // the impactor
  bool m_bodySpoiled = false;                          // the first body's velocity in Bullet
  Eigen::Vector3d m_middle = Eigen::Vector3d::Zero();  // of the body [m]
  Eigen::Vector3d m_half = Eigen::Vector3d::Zero();
  double m_elementsPut = 0;
  double m_lightest = 0;
  double m_mass = 0;
};

}  // namespace rubble::stability
