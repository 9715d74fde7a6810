// Bullet's collision objects as the substeps see them.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "bullet/mesh_patches.h"
#include "edem/rigid_proxy.h"
#include "rubble/abi.h"
#include "rubble/error.h"

class btMultiSphereShape;
class btUniformScalingShape;

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Names an object for as long as it lives: by its number in the broadphase, which another object at the
/// address of a deleted one does not get.
std::uint64_t keyOf(const btCollisionObject& object);

/// Makes proxies, and keeps the faces of hulls between ticks.
class RigidProxies {
 public:
  explicit RigidProxies(LogFunction log) : m_log(std::move(log)) {}

  /// Position, motion and surface of an object now; of triangle meshes and height fields what is in and about
  /// `boxes` (in the world). Shapes that have no surface, and objects whose numbers are not finite, leave
  /// `parts` empty and are logged once.
  edem::RigidProxy make(const btCollisionObject& object, std::span<const Eigen::AlignedBox3d> boxes);

 private:
  struct CachedHull {
    std::uint64_t points = 0;  // hash of what it was made from: shapes may be changed or replaced
    std::shared_ptr<const edem::Hull> hull;
  };
  // Where a shape is asked for.
  struct Asked {
    Eigen::Isometry3d body;  // in the world
    std::span<const Eigen::AlignedBox3d> boxes;
  };
  void addShape(const btCollisionShape& shape, const Eigen::Isometry3d& place, const Asked& asked,
                std::vector<edem::Collider>& parts);
  void addTriangles(const btConcaveShape& shape, edem::Collider at, const Asked& asked,
                    std::vector<edem::Collider>& parts);
  void refuse(const btCollisionShape& shape);
  // Each adds what the shape is at the place of `at`, or returns false.
  static bool addSolid(const btCollisionShape& shape, edem::Collider at, std::vector<edem::Collider>& parts);
  static bool addRound(const btCollisionShape& shape, edem::Collider at, std::vector<edem::Collider>& parts);
  static bool addSpheres(const btMultiSphereShape& shape, edem::Collider at,
                         std::vector<edem::Collider>& parts);
  static bool addScaled(const btUniformScalingShape& shape, const edem::Collider& at,
                        std::vector<edem::Collider>& parts);
  std::shared_ptr<const edem::Hull> hullOf(const btCollisionShape& shape,
                                           const std::vector<Eigen::Vector3d>& points);

  LogFunction m_log;
  MeshPatches m_meshes;
  std::unordered_map<const btCollisionShape*, CachedHull> m_hulls;  // looked up by key only
  std::vector<int> m_refused;                                       // shape types already logged
  bool m_toldOfNumbers = false;                                     // logged that some are not finite
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
