// An element as a convex shape of Bullet's, for questions about it.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>

#include "edem/cell_faces.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// The convex hull of an element's cell, about the element's centre; where there are no cells its sphere.
/// Refers to `cells`.
class CellShape : public btConvexInternalShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  /// `radius` is that of the sphere [m].
  CellShape(const edem::CellFaces* cells, std::uint32_t element, double radius);

  /// No point of it is further from its origin [m].
  double reach() const;

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override;
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* out,
                                                         int count) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  const char* getName() const override { return "RubbleCell"; }

 private:
  const edem::CellFaces* m_cells;
  std::uint32_t m_element;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
