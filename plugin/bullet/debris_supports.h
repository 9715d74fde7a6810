// What debris at rest lie on, and which of it is no longer where it was. Costs one comparison a tick for each
// object and element that bears debris, and one for each body that sleeps; nothing depends on the number of
// pieces.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "edem/solver.h"
#include "rubble/destructible_body.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

class DebrisSupports {
 public:
  DebrisSupports(const btDiscreteDynamicsWorld& world, const edem::Solver& solver)
      : m_world(world), m_solver(solver) {}

  /// Debris came to rest on an object of the world, or on an element of a body of it. Known surfaces are kept
  /// as they are.
  void add(std::uint32_t surface, btCollisionObject& object);
  void addElement(std::uint32_t surface, btCollisionObject& body, std::uint32_t id, std::uint32_t element);

  /// Surfaces that moved since they were added, were crushed, or left the world; they are known no more.
  /// Valid until the next call.
  std::span<const std::uint32_t> takeDeparted();
  /// Nothing rests any more.
  void clear();

 private:
  // Objects are compared by address, and touched only while the world has them: the application may have
  // deleted them.
  struct Presence {
    btCollisionObject* object;
    int index;  // in the world's list when last seen
  };
  struct Support {
    Presence presence;
    std::uint32_t surface;
    btTransform at;
    const btCollisionShape* shape;
  };
  struct Element {
    std::uint32_t surface, element;
    Eigen::Vector3d at;
  };
  struct Body {
    Presence presence;
    std::uint32_t id;
    std::vector<Element> elements;
  };

  bool isNew(std::uint32_t surface);
  void depart(std::uint32_t surface);
  bool isPresent(Presence& presence) const;
  bool hasLeft(Support& support) const;
  void takeDeparted(Body& body);

  const btDiscreteDynamicsWorld& m_world;
  const edem::Solver& m_solver;
  std::vector<Support> m_objects;
  std::vector<Body> m_bodies;
  std::vector<std::uint8_t> m_known;  // by surface
  std::vector<std::uint32_t> m_departed;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
