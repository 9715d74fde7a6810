// A destructible body's collision shape: the spheres of its living elements. Concave and of a type that
// nothing in Bullet uses, so that our own algorithm is called for every pair.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <vector>

#include "edem/solver.h"
#include "rubble/abi.h"

class btTriangleConvexcastCallback;
class btTriangleRaycastCallback;

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

class ElementShape : public btConcaveShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  ElementShape(const edem::Solver& solver, std::uint32_t body);

  /// Takes the elements' bounds, grown by what they may travel before the next call [m].
  void refit(double travel);
  /// By which the bounds are wider than what the elements may travel [m].
  double margin() const { return m_solver.radius(m_body); }
  /// While Bullet moves things itself the shape answers no sweep: its own continuous collision would hold a
  /// ball in the air that our contacts have let through.
  void setHidden(bool hidden) { m_hidden = hidden; }

  void getAabb(const btTransform& t, btVector3& low, btVector3& high) const override;
  void processAllTriangles(btTriangleCallback* callback, const btVector3& low,
                           const btVector3& high) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return m_scaling; }
  const char* getName() const override { return "RubbleElements"; }

 private:
  /// Living elements whose spheres may reach into the box.
  std::vector<std::uint32_t> elementsAlong(const btVector3& low, const btVector3& high) const;
  void answer(btTriangleRaycastCallback& ray) const;
  void answer(btTriangleConvexcastCallback& sweep) const;

  const edem::Solver& m_solver;
  std::uint32_t m_body;
  bool m_hidden = false;
  btVector3 m_low{0, 0, 0}, m_high{0, 0, 0};
  btVector3 m_scaling{1, 1, 1};
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
