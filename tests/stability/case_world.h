// The Bullet world of a case: ground, body, impactor, and what the application does to them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bullet/bullet_world.h"
#include "stability/case.h"

namespace rubble::test {

class CaseWorld {
 public:
  explicit CaseWorld(const Case& c);

  /// Throws rubble::Error where the library refuses the case.
  void build();
  void step(double dt);
  void happen();
  /// Length of a tick [s].
  double stepOf(int tick) const;

  BulletWorld& bullet() { return m_bullet; }
  const BulletWorld& bullet() const { return m_bullet; }
  /// Dynamic bodies that Bullet moves and whose numbers the application did not spoil: the impactor, whole
  /// bodies.
  std::vector<const btRigidBody*> moved() const;
  /// All whose numbers the application did not spoil.
  std::vector<const btRigidBody*> healthy() const;
  const std::vector<std::string>& warnings() const { return m_warnings; }

  /// Kinetic and elastic energy of the elements at the start, whole bodies left out [J].
  double elementsPut() const;
  double lightest() const;  ///< element [kg]
  double mass() const;      ///< of all that moves [kg]

 private:
  DestructionDef definition();
  std::shared_ptr<const Asset> asset(int elements, bool anchored) const;
  void addDestructible(const std::shared_ptr<const Asset>& asset, const Material& material,
                       const btVector3& at, const btVector3& velocity, double spin, bool anchored);
  void addImpactor();
  void addOtherBody();

  struct Element {
    double mass;
    Eigen::Vector3d arm;
    double inertia;
  };

  Case m_case;
  std::vector<std::string> m_warnings;
  std::unique_ptr<btCollisionShape> m_shape;  // outlives what has it
  BulletWorld m_bullet;
  btRigidBody* m_impactor = nullptr;
  bool m_spoiled = false;                              // the impactor
  bool m_bodySpoiled = false;                          // the first body's velocity in Bullet
  Eigen::Vector3d m_middle = Eigen::Vector3d::Zero();  // of the body [m]
  Eigen::Vector3d m_half = Eigen::Vector3d::Zero();
  double m_elementsPut = 0;
  double m_lightest = 0;
  double m_mass = 0;
};

}  // namespace rubble::test
