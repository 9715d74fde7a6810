// The shape of a whole body as one rigid body of Bullet's: box, convex hull, or few of these.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <memory>
#include <span>
#include <vector>

#include "bullet/convex_hull.h"
#include "rubble/abi.h"
#include "rubble/asset.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct WholeShape {
  std::vector<std::shared_ptr<btConvexShape>> parts;  ///< of a compound; none of a convex solid
  std::shared_ptr<btCollisionShape> shape;            ///< null: few convex parts do not fit the solid
  /// The rigid body's frame in the asset's: its origin, and its axes, which are those of the inertia.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  btVector3 inertia{0, 0, 0};  ///< [kg m^2]
  double mass = 0;             ///< [kg]
  /// Centre of the elements' masses in the rigid body's frame [m]: a box's own centre is that of the solid.
  Eigen::Vector3d elementCentre = Eigen::Vector3d::Zero();
};

/// The convex solids of an asset's shape, in its frame.
struct SolidHulls {
  std::vector<ConvexHull> hulls;  ///< none: few convex parts do not fit the solid
  bool isBox = false;             ///< along the asset's axes; then `hulls` is one
};

/// What the elements' masses make of an asset.
struct MassFrame {
  double mass = 0;                                    ///< [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about it [kg m^2]
};

SolidHulls solidHullsOf(const Asset& asset);
/// `masses` and scalar moments of `inertias` of the elements [kg], [kg m^2] (n).
MassFrame massFrameOf(const Asset& asset, std::span<const double> masses, std::span<const double> inertias);
WholeShape wholeShape(const Asset& asset, const SolidHulls& solid, const MassFrame& masses);

RUBBLE_ABI_END
}  // namespace rubble::bullet
