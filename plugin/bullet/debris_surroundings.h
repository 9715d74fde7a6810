// What debris fly against: Bullet's objects and the elements of destructible bodies.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <span>
#include <vector>

#include "bullet/rigid_proxies.h"
#include "debris/debris_collider.h"
#include "debris/particle.h"
#include "edem/grid.h"
#include "edem/solver.h"
#include "rubble/destruction.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

class DebrisSurroundings : public debris::DebrisCollider {
 public:
  DebrisSurroundings(btDiscreteDynamicsWorld& world, edem::Solver& solver, RigidProxies& proxies)
      : m_world(world), m_solver(solver), m_proxies(proxies) {}

  void begin(const Eigen::AlignedBox3d& swept) override;
  std::uint32_t surfaceCount() const override { return std::uint32_t(m_movable.size() + m_balls.size()); }
  bool sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
             debris::DebrisHit& hit) override;

  /// Gives Bullet's bodies and the elements what debris did to them in the last step, by surface.
  void push(std::span<const debris::SurfaceImpulse> impulses);

 private:
  struct Object {
    edem::RigidProxy proxy;
    Eigen::AlignedBox3d bounds;
    std::uint32_t surface;
  };
  struct ElementBall {
    std::uint32_t body, element;
    double radius;
    double inverseMass;  // 0 while the body sleeps: dust must not wake a wall
  };

  void addObject(btCollisionObject& object);
  void addElements(std::uint32_t body, const Eigen::AlignedBox3d& swept);
  bool sweepObject(const Object& object, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   double radius, debris::DebrisHit& hit) const;
  bool sweepElement(std::uint32_t ball, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                    debris::DebrisHit& hit) const;

  btDiscreteDynamicsWorld& m_world;
  edem::Solver& m_solver;
  RigidProxies& m_proxies;
  std::vector<Object> m_objects;
  // Surface ids: first every rigid body ever met, then the element balls of this step.
  std::vector<btRigidBody*> m_movable;  // compared, used only while present
  std::vector<std::uint8_t> m_present;
  std::vector<Eigen::Vector3d> m_centres;  // of the element balls near
  std::vector<ElementBall> m_balls;
  std::vector<std::uint8_t> m_all;
  edem::Grid<double> m_grid;
  double m_largest = 0;  // radius of the element balls [m]
  std::vector<std::uint32_t> m_near;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
