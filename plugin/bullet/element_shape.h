// A destructible body's collision shape: the cells of its living elements, or their spheres. Concave and of a
// type that nothing in Bullet uses, so that our own algorithm is called for every pair.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <compare>
#include <vector>

#include "bullet/element_tree.h"
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

  /// Whose shape it is: Bullet asks in that object's frame, and the elements are where they are, wherever
  /// that frame is.
  void setObject(const btCollisionObject& object) { m_object = &object; }

  /// Takes the elements' bounds, grown by what they may travel before the next call [m].
  void refit(double travel);
  /// By which the bounds are wider than what the elements may travel [m].
  double margin() const { return m_solver.radius(m_body); }
  /// Takes where the elements are, for queries; to be called whenever they have moved. Between two calls
  /// queries change nothing: several threads may ask at once.
  void follow() { m_tree.follow(m_solver, m_body); }
  /// Living elements whose reach may meet a box, in rising order.
  std::vector<std::uint32_t> elementsNear(const btVector3& low, const btVector3& high) const {
    return m_tree.in(low, high);
  }
  /// Bounds of the elements and of what they may travel, in the world [m].
  Eigen::AlignedBox3d box() const;
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
  struct Near {
    double begin, end;  // shares of the way
    std::uint32_t element;
    auto operator<=>(const Near&) const = default;
  };

  std::vector<Near> nearest(const std::vector<std::uint32_t>& elements, const btVector3& from,
                            const btVector3& to, double ball) const;
  void answer(btTriangleRaycastCallback& ray) const;
  void answer(btTriangleConvexcastCallback& sweep) const;
  void sweepElement(const Near& near, btTriangleConvexcastCallback& sweep) const;

  const edem::Solver& m_solver;
  std::uint32_t m_body;
  const btCollisionObject* m_object = nullptr;  // none: at the origin
  ElementTree m_tree;
  bool m_hidden = false;
  btVector3 m_low{0, 0, 0}, m_high{0, 0, 0};
  btVector3 m_scaling{1, 1, 1};
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
