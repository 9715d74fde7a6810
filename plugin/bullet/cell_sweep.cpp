#include "bullet/cell_sweep.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Steps by the distance end when it is small; only what turns beside a cell comes near without touching.
constexpr int kMaxSteps = 256;

// Bullet's detector sees a cell that reaches this far: what it takes for one place is then 1/10000 of it, and
// floats hold a 100th of that.
constexpr double kSeenReach = 100;

// A convex shape, enlarged.
class Enlarged : public btConvexInternalShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  Enlarged(const btConvexShape& shape, btScalar factor) : m_shape(shape), m_factor(factor) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    setMargin(factor * shape.getMarginNonVirtual());
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    return m_factor * m_shape.localGetSupportVertexWithoutMarginNonVirtual(direction);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* out,
                                                         int count) const override {
    for (int i = 0; i < count; ++i) out[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override {
    m_shape.calculateLocalInertia(m_factor * m_factor * mass, inertia);
  }
  const char* getName() const override { return m_shape.getName(); }

 private:
  const btConvexShape& m_shape;
  btScalar m_factor;
};

// Of two shapes as Bullet's detector sees them.
std::optional<CellDistance> seenDistance(const Enlarged& shape, const btTransform& shapeAt,
                                         const Enlarged& cell, const btTransform& cellAt) {
  btVector3 guess = shapeAt.getOrigin() - cellAt.getOrigin();
  if (!(guess.length2() > 0)) guess = btVector3(0, 1, 0);
  btGjkEpaSolver2::sResults found;
  // Of the shapes without their margins.
  if (btGjkEpaSolver2::Distance(&shape, shapeAt, &cell, cellAt, guess, found) &&
      found.distance > SIMD_EPSILON) {
    const btScalar rounding = cell.getMargin();
    return CellDistance{found.distance - shape.getMargin() - rounding, found.normal,
                        found.witnesses[1] + rounding * found.normal};
  }
  if (!btGjkEpaSolver2::Penetration(&shape, shapeAt, &cell, cellAt, guess, found)) return std::nullopt;
  const btVector3 out = found.witnesses[1] - found.witnesses[0];
  const btScalar depth = out.length();
  if (!(depth > SIMD_EPSILON)) return std::nullopt;
  return CellDistance{-depth, out / depth, found.witnesses[1]};
}

}  // namespace

std::optional<CellDistance> distanceOf(const btConvexShape& shape, const btTransform& shapeAt,
                                       const CellShape& cell, const btTransform& cellAt) {
  const btScalar factor = btScalar(kSeenReach / cell.reach());
  btTransform seenShape = shapeAt, seenCell = cellAt;
  seenShape.setOrigin(factor * shapeAt.getOrigin());
  seenCell.setOrigin(factor * cellAt.getOrigin());
  auto found = seenDistance(Enlarged(shape, factor), seenShape, Enlarged(cell, factor), seenCell);
  if (!found) return found;
  found->distance /= factor;
  found->onCell /= factor;
  return found;
}

CellDistance distanceOf(const btStaticPlaneShape& plane, const btTransform& planeAt, const CellShape& cell,
                        const btTransform& cellAt) {
  const btVector3 up = planeAt.getBasis() * plane.getPlaneNormal();
  const btVector3 deepest = cellAt * cell.localGetSupportingVertex(cellAt.getBasis().transpose() * -up);
  return {up.dot(deepest - planeAt.getOrigin()) - plane.getPlaneConstant(), -up, deepest};
}

// Bullet's own (btTransformUtil) ends at an eighth of a turn.
btTransform between(const btTransform& from, const btTransform& to, btScalar fraction) {
  btTransform at(from.getBasis(), from.getOrigin().lerp(to.getOrigin(), fraction));
  if (!(from.getBasis() == to.getBasis()))
    at.setRotation(from.getRotation().slerp(to.getRotation(), fraction));
  return at;
}

std::optional<CellHit> sweepShape(const btConvexShape& shape, const btTransform& from, const btTransform& to,
                                  const CellShape& cell, const btTransform& cellAt, btScalar allowed) {
  const btVector3 velocity = to.getOrigin() - from.getOrigin();
  const btScalar angle =
      from.getBasis() == to.getBasis() ? btScalar(0) : from.getRotation().angleShortestPath(to.getRotation());
  const btScalar turning = angle * shape.getAngularMotionDisc();
  btScalar fraction = 0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto near = distanceOf(shape, between(from, to, fraction), cell, cellAt);
    if (!near) return std::nullopt;
    const btScalar approach = turning - velocity.dot(near->normal);
    if (!(approach > SIMD_EPSILON)) return std::nullopt;
    const btScalar distance = near->distance + allowed;
    if (distance <= btScalar(kSweepTouch)) return CellHit{fraction, near->normal, near->onCell};
    fraction += distance / approach;
    if (fraction > 1) return std::nullopt;
  }
  return std::nullopt;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
