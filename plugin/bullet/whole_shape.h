// The shape of a whole body as one rigid body of Bullet's: box, convex hull, or few of these.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <memory>
#include <span>
#include <vector>

#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct WholeShape {
  std::vector<std::unique_ptr<btConvexShape>> parts;  ///< of a compound; none of a convex solid
  std::unique_ptr<btCollisionShape> shape;            ///< null: few convex parts do not fit the solid
  /// The rigid body's frame in the asset's: its origin, and its axes, which are those of the inertia.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  btVector3 inertia{0, 0, 0};  ///< [kg m^2]
  double mass = 0;             ///< [kg]
  /// Centre of the elements' masses in the rigid body's frame [m]: a box's own centre is that of the solid.
  Eigen::Vector3d elementCentre = Eigen::Vector3d::Zero();
};

/// `masses` and scalar moments of `inertias` of the elements [kg], [kg m^2] (n).
WholeShape wholeShape(const Asset& asset, std::span<const double> masses, std::span<const double> inertias);

RUBBLE_ABI_END
}  // namespace rubble::bullet
