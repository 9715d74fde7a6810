// Where a body of elements and another object are near: what a manifold shows of it.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "rubble/abi.h"

struct btCollisionObjectWrapper;

namespace rubble {
RUBBLE_ABI_BEGIN
class DestructibleBody;
RUBBLE_ABI_END
}  // namespace rubble

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// A point where an element and the other object are near.
struct NearPoint {
  Eigen::Vector3d point, normal;  ///< on the other object's surface, out of it
  double distance;                ///< [m]
};

/// Those of the elements that sleep, which stay while these sleep and the other object is where it was.
struct RestingPoints {
  std::vector<NearPoint> points;
  std::uint64_t sleepChanges = 0;  ///< of BodyView
  const btCollisionShape* shape = nullptr;
  btTransform place = btTransform::getIdentity();
  btVector3 low{0, 0, 0}, high{0, 0, 0};  ///< bounds of the shape there: it may grow
  double margin = 0;                      ///< [m]
};

/// At most four, the deepest among them, of the elements' spheres within `margin` of `other` [m]: what each
/// tick can afford. `resting` is of the same pair in the last tick, null at first, and is made anew where
/// something has changed.
std::vector<NearPoint> nearSpheres(const DestructibleBody& own, const btCollisionObject& other, double margin,
                                   std::unique_ptr<RestingPoints>& resting);

/// The same of the elements' cells. Changes nothing, neither in the world nor in what it keeps of shapes.
std::vector<NearPoint> nearCells(const DestructibleBody& own, const btCollisionObjectWrapper& other,
                                 double margin);

RUBBLE_ABI_END
}  // namespace rubble::bullet
