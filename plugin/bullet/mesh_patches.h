// Parts of Bullet's triangle meshes and height fields as the substeps touch them.
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "edem/triangle_mesh.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

/// Keeps those in use between calls.
class MeshPatches {
 public:
  /// The triangles of a shape in and about a box, both in its frame. Asked for in every tick, so that
  /// triangles that the application changes are seen; made anew only then. Null where there are none.
  std::shared_ptr<const edem::TriangleMesh> of(const btConcaveShape& shape, const Eigen::AlignedBox3d& box);

 private:
  struct Kept {
    const btConcaveShape* shape;  // looked up only
    std::uint64_t hash;           // of the corners
    std::shared_ptr<const edem::TriangleMesh> mesh;
  };
  std::vector<Kept> m_kept;  // latest first
  std::vector<btVector3> m_corners;
};

RUBBLE_ABI_END
}  // namespace rubble::bullet
