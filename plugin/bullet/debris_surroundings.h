// What debris fly against: Bullet's objects and the elements of destructible bodies.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <vector>

#include "bullet/rigid_proxies.h"
#include "debris/debris_collider.h"
#include "edem/grid.h"
#include "edem/solver.h"
#include "rubble/destruction.h"

namespace rubble {
RUBBLE_ABI_BEGIN

class DebrisSurroundings : public debris::DebrisCollider {
 public:
  DebrisSurroundings(btDiscreteDynamicsWorld& world, const edem::Solver& solver, RigidProxies& proxies)
      : m_world(world), m_solver(solver), m_proxies(proxies) {}

  void begin(const Eigen::AlignedBox3d& swept) override;
  std::uint32_t surfaceCount() const override { return std::uint32_t(m_movable.size()); }
  bool sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
             debris::DebrisHit& hit) override;

  /// Body of a movable surface; null when it was not near in the last step (it may be gone).
  btRigidBody* movable(std::uint32_t surface) const {
    return m_present[surface] ? m_movable[surface] : nullptr;
  }

 private:
  struct Object {
    edem::RigidProxy proxy;
    Eigen::AlignedBox3d bounds;
    std::uint32_t surface;
  };
  struct ElementBall {
    std::uint32_t body, element;
    double radius;
  };

  void addObject(btCollisionObject& object);
  void addElements(std::uint32_t body, const Eigen::AlignedBox3d& swept);
  bool sweepObject(const Object& object, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   double radius, debris::DebrisHit& hit) const;
  bool sweepElement(std::uint32_t ball, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                    debris::DebrisHit& hit) const;

  btDiscreteDynamicsWorld& m_world;
  const edem::Solver& m_solver;
  RigidProxies& m_proxies;
  std::vector<Object> m_objects;
  std::vector<btRigidBody*> m_movable;  // by surface id; compared, used only while present
  std::vector<std::uint8_t> m_present;
  std::vector<Eigen::Vector3d> m_centres;  // of the element balls near
  std::vector<ElementBall> m_balls;
  std::vector<std::uint8_t> m_all;
  edem::Grid<double> m_grid;
  double m_largest = 0;  // radius of the element balls [m]
  std::vector<std::uint32_t> m_near;
};

RUBBLE_ABI_END
}  // namespace rubble
