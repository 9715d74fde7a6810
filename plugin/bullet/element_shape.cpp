#include "bullet/element_shape.h"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <cmath>

#include "bullet/convert.h"

namespace rubble {
RUBBLE_ABI_BEGIN

ElementShape::ElementShape(const edem::Solver& solver, std::uint32_t body) : m_solver(solver), m_body(body) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  refit(0);
}

void ElementShape::refit(double travel) {
  const Eigen::AlignedBox3d box = m_solver.bounds(m_body);
  if (box.isEmpty()) {
    m_high = m_low;
    return;
  }
  const Eigen::Vector3d grow = Eigen::Vector3d::Constant(travel + m_solver.radius(m_body));
  m_low = bullet::toBullet(box.min() - grow);
  m_high = bullet::toBullet(box.max() + grow);
}

void ElementShape::getAabb(const btTransform&, btVector3& low, btVector3& high) const {
  low = m_low;
  high = m_high;
}

void ElementShape::processAllTriangles(btTriangleCallback* callback, const btVector3&,
                                       const btVector3&) const {
  if (m_hidden) return;
  // Bullet's generic concave path for rays: each element answers as a sphere.
  auto* ray = dynamic_cast<btTriangleRaycastCallback*>(callback);
  if (!ray) return;
  const Eigen::Vector3d from = bullet::toEigen(ray->m_from), along = bullet::toEigen(ray->m_to) - from;
  const double length2 = along.squaredNorm(), radius = m_solver.radius(m_body);
  if (!(length2 > 0)) return;
  std::vector<std::uint32_t> near;
  Eigen::AlignedBox3d box(from.cwiseMin(from + along), from.cwiseMax(from + along));
  box.min().array() -= radius;
  box.max().array() += radius;
  m_solver.elementsIn(m_body, box, near);
  for (const std::uint32_t i : near) {
    const Eigen::Vector3d to = m_solver.position(m_body, i) - from;
    const double middle = to.dot(along) / length2;
    const double miss2 = (to - middle * along).squaredNorm();
    if (miss2 > radius * radius) continue;
    const double t = middle - std::sqrt((radius * radius - miss2) / length2);
    if (t < 0 || t > static_cast<double>(ray->m_hitFraction)) continue;
    const Eigen::Vector3d normal = (t * along - to).normalized();
    ray->m_hitFraction =
        ray->reportHit(bullet::toBullet(normal), static_cast<btScalar>(t), 0, static_cast<int>(i));
  }
}

void ElementShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const btVector3 size = m_high - m_low;
  const btVector3 square = size * size;
  inertia = mass / btScalar(12) *
            btVector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y());
}

RUBBLE_ABI_END
}  // namespace rubble
