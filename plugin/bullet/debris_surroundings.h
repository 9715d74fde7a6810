// What debris fly against: Bullet's objects and the elements of destructible bodies.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <span>
#include <unordered_map>
#include <vector>

#include "bullet/debris_supports.h"
#include "bullet/rigid_proxies.h"
#include "debris/debris_collider.h"
#include "debris/motion.h"
#include "debris/surfaces.h"
#include "edem/grid.h"
#include "edem/solver.h"
#include "rubble/destructible_body.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// What debris gave to elements in a step: as the hits booked it, and as the elements' books took it.
struct ElementPush {
  debris::Impulse given;     ///< angular about the world's origin
  debris::Impulse received;  ///< angular about Books::centre
};

class DebrisSurroundings : public debris::DebrisCollider {
 public:
  DebrisSurroundings(btDiscreteDynamicsWorld& world, edem::Solver& solver, RigidProxies& proxies)
      : m_world(world), m_solver(solver), m_proxies(proxies), m_supports(world, solver) {}

  void begin(const Eigen::AlignedBox3d& swept) override;
  std::uint32_t surfaceCount() const override { return std::uint32_t(m_places.size()); }
  debris::DebrisSurface surface(std::uint32_t id) const override;
  void noteSupport(std::uint32_t id) override;
  bool sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
             debris::DebrisHit& hit) override;
  bool sweepThin(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                 debris::DebrisHit& hit) override;

  /// Gives Bullet's bodies and the elements what debris did to them in the last step.
  ElementPush push(std::span<const debris::SurfaceImpulse> impulses);

  /// What debris rest on.
  DebrisSupports& supports() { return m_supports; }

 private:
  struct Object {
    btCollisionObject* object;
    btRigidBody* rigid;  // null unless dynamic
    edem::RigidProxy proxy;
    Eigen::AlignedBox3d bounds;
    std::uint32_t surface;
  };
  struct ElementBall {
    btCollisionObject* object;
    std::uint32_t body, element;
    double radius;
    std::uint32_t surface;
    bool asleep;  // held then: debris must not wake a wall
  };
  // Where the surface was last met, as an index of m_objects or m_balls. Good in the step of a hit.
  struct Place {
    std::uint32_t index;
    bool isElement;
  };

  void addObject(btCollisionObject& object, const Eigen::AlignedBox3d& swept);
  void addElements(DestructibleBody& body, const Eigen::AlignedBox3d& swept);
  std::uint32_t firstSurfaceOf(std::uint32_t body, std::size_t elements);
  bool sweepObject(const Object& object, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   double radius, debris::DebrisHit& hit) const;
  bool sweepMesh(const edem::Collider& part, const Eigen::Isometry3d& place, const Eigen::Vector3d& from,
                 const Eigen::Vector3d& to, double radius, debris::DebrisHit& hit) const;
  bool sweepElement(std::uint32_t ball, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                    debris::DebrisHit& hit) const;

  btDiscreteDynamicsWorld& m_world;
  edem::Solver& m_solver;
  RigidProxies& m_proxies;
  DebrisSupports m_supports;
  std::vector<Object> m_objects;
  // Surface ids are given when an object or a body is first met, to a body one for each element, and never to
  // another body. An object that is made where a deleted one was inherits its id: by then nothing rests on
  // it.
  std::vector<Place> m_places;
  std::unordered_map<const btCollisionObject*, std::uint32_t> m_surfaceOf;  // looked up by key only
  std::vector<std::uint32_t> m_firstSurface;                                // by body id
  std::vector<Eigen::Vector3d> m_centres;                                   // of the element balls near
  std::vector<ElementBall> m_balls;
  std::vector<std::uint8_t> m_all;
  edem::Grid<double> m_grid;
  double m_largest = 0;  // radius of the element balls [m]
  std::vector<std::uint32_t> m_near;
  mutable std::vector<std::uint32_t> m_triangles;  // near a sweep
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
