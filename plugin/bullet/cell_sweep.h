// Bullet's convex shapes against an element: how near, and where on a way. Bullet's detectors take vertices
// within 10 mm of each other for one, which puts a ball up to 4 mm into a cell: they get cells and shapes
// enlarged.
#pragma once

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <optional>

#include "bullet/cell_shape.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct CellDistance {
  btScalar distance;  ///< below 0: overlap [m]
  btVector3 normal;   ///< unit, out of the cell
  btVector3 onCell;   ///< nearest place, or the deepest, of the cell's surface
};

/// Distance of a shape from a cell; nothing where Bullet finds none. Best near the origin.
std::optional<CellDistance> distanceOf(const btConvexShape& shape, const btTransform& shapeAt,
                                       const CellShape& cell, const btTransform& cellAt);

/// The same of a half space, from the cell's deepest vertex.
CellDistance distanceOf(const btStaticPlaneShape& plane, const btTransform& planeAt, const CellShape& cell,
                        const btTransform& cellAt);

/// The place at a share of a way, straight on and turning evenly by the shorter way.
btTransform between(const btTransform& from, const btTransform& to, btScalar fraction);

struct CellHit {
  btScalar fraction;  ///< of the way
  btVector3 normal, onCell;
};

/// Where on its way from `from` to `to` a shape is first nearer to a cell than kSweepTouch, or sinks deeper
/// than `allowed` [m]. What overlaps from the start is hit at once, unless it moves out.
std::optional<CellHit> sweepShape(const btConvexShape& shape, const btTransform& from, const btTransform& to,
                                  const CellShape& cell, const btTransform& cellAt, btScalar allowed);

/// [m]; small beside the cells, large beside the noise of floats
inline constexpr double kSweepTouch = 1e-4;

RUBBLE_ABI_END
}  // namespace rubble::bullet
