// Bullet's collision objects as the substeps see them.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <memory>
#include <unordered_map>
#include <vector>

#include "edem/rigid_proxy.h"
#include "rubble/abi.h"
#include "rubble/error.h"

class btMultiSphereShape;
class btUniformScalingShape;

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Makes proxies, and keeps the faces of hulls between ticks.
class RigidProxies {
 public:
  explicit RigidProxies(LogFunction log) : m_log(std::move(log)) {}

  /// Position, motion and surface of an object now. Shapes that are not supported (triangle meshes, height
  /// fields), and objects whose numbers are not finite, leave `parts` empty and are logged once.
  edem::RigidProxy make(const btCollisionObject& object);

 private:
  struct CachedHull {
    std::uint64_t points = 0;  // hash of what it was made from: shapes may be changed or replaced
    std::shared_ptr<const edem::Hull> hull;
  };
  void addShape(const btCollisionShape& shape, const Eigen::Isometry3d& place,
                std::vector<edem::Collider>& parts);
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
  std::unordered_map<const btCollisionShape*, CachedHull> m_hulls;  // looked up by key only
  std::vector<int> m_refused;                                       // shape types already logged
  bool m_toldOfNumbers = false;                                     // logged that some are not finite
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
