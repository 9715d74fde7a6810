#include "bullet/mesh_patches.h"

#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/hash.h"
#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// What is asked for moves a little from tick to tick: boxes are rounded up to this share of their size, so
// that the triangles stay the same.
constexpr double kGrain = 0.25;
// Meshes that this many others were asked for after are made anew.
constexpr std::size_t kMostKept = 64;

class Corners : public btTriangleCallback {
 public:
  explicit Corners(std::vector<btVector3>& corners) : m_corners(corners) {}
  void processTriangle(btVector3* triangle, int, int) override {
    m_corners.insert(m_corners.end(), triangle, triangle + 3);
  }

 private:
  std::vector<btVector3>& m_corners;
};

Eigen::AlignedBox3d roundedUp(const Eigen::AlignedBox3d& box) {
  const double size = std::max(box.sizes().maxCoeff(), 1e-6);
  const double grain = std::exp2(std::ceil(std::log2(kGrain * size)));
  return {((box.min() / grain).array().floor() * grain).matrix(),
          ((box.max() / grain).array().ceil() * grain).matrix()};
}

std::uint64_t hashOfCorners(const std::vector<btVector3>& corners) {
  base::Fnv1a hash;
  for (const btVector3& c : corners)
    for (int axis = 0; axis < 3; ++axis) hash.add(c[axis]);
  return hash.value();
}

// Corners at one place are one vertex: Bullet's meshes need not share them.
std::shared_ptr<const edem::TriangleMesh> makeMesh(const std::vector<btVector3>& corners) {
  std::map<std::array<btScalar, 3>, std::uint32_t> names;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<edem::TriangleMesh::Triangle> triangles(corners.size() / 3);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const btVector3& at = corners[c];
    const auto [name, isNew] = names.try_emplace({at.x(), at.y(), at.z()}, std::uint32_t(vertices.size()));
    if (isNew) vertices.push_back(toEigen(at));
    triangles[c / 3][c % 3] = name->second;
  }
  auto mesh = std::make_shared<const edem::TriangleMesh>(std::move(vertices), std::move(triangles));
  return mesh->triangles().empty() ? nullptr : mesh;
}

}  // namespace

std::shared_ptr<const edem::TriangleMesh> MeshPatches::of(const btConcaveShape& shape,
                                                          const Eigen::AlignedBox3d& box) {
  if (box.isEmpty() || !box.sizes().allFinite()) return nullptr;
  const Eigen::AlignedBox3d asked = roundedUp(box);
  m_corners.clear();
  Corners collect(m_corners);
  shape.processAllTriangles(&collect, toBullet(asked.min()), toBullet(asked.max()));
  // Some shapes hand over more than was asked for, and corners that are no numbers.
  auto kept = m_corners.begin();
  for (auto corner = m_corners.begin(); corner != m_corners.end(); corner += 3) {
    Eigen::AlignedBox3d own(toEigen(corner[0]));
    own.extend(toEigen(corner[1]));
    own.extend(toEigen(corner[2]));
    if (own.sizes().allFinite() && asked.intersects(own)) kept = std::copy(corner, corner + 3, kept);
  }
  m_corners.erase(kept, m_corners.end());
  if (m_corners.empty()) return nullptr;
  const std::uint64_t hash = hashOfCorners(m_corners);
  const auto isThis = [&](const Kept& k) { return k.shape == &shape && k.hash == hash; };
  auto found = std::find_if(m_kept.begin(), m_kept.end(), isThis);
  if (found == m_kept.end()) {
    if (m_kept.size() >= kMostKept) m_kept.pop_back();
    found = m_kept.insert(m_kept.end(), {&shape, hash, makeMesh(m_corners)});
  }
  std::rotate(m_kept.begin(), found, found + 1);
  return m_kept.front().mesh;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
