#include "bullet/element_shape.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>
#include <cmath>

#include "bullet/convert.h"

namespace rubble::bullet {
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
  const Eigen::Vector3d grow = Eigen::Vector3d::Constant(travel + margin());
  m_low = toBullet(box.min() - grow);
  m_high = toBullet(box.max() + grow);
}

void ElementShape::getAabb(const btTransform&, btVector3& low, btVector3& high) const {
  low = m_low;
  high = m_high;
}

// Bullet's generic concave path for rays and sweeps: each element answers as a sphere.
void ElementShape::processAllTriangles(btTriangleCallback* callback, const btVector3&,
                                       const btVector3&) const {
  if (m_hidden) return;
  if (auto* ray = dynamic_cast<btTriangleRaycastCallback*>(callback)) {
    answer(*ray);
  } else if (auto* sweep = dynamic_cast<btTriangleConvexcastCallback*>(callback)) {
    answer(*sweep);
  }
}

std::vector<std::uint32_t> ElementShape::elementsAlong(const btVector3& low, const btVector3& high) const {
  Eigen::AlignedBox3d box(toEigen(low), toEigen(high));
  box.min().array() -= m_solver.radius(m_body);
  box.max().array() += m_solver.radius(m_body);
  std::vector<std::uint32_t> near;
  m_solver.elementsIn(m_body, box, near);
  return near;
}

void ElementShape::answer(btTriangleRaycastCallback& ray) const {
  const Eigen::Vector3d from = toEigen(ray.m_from), along = toEigen(ray.m_to) - from;
  const double length2 = along.squaredNorm(), radius = m_solver.radius(m_body);
  if (!(length2 > 0)) return;
  btVector3 low = ray.m_from, high = ray.m_from;
  low.setMin(ray.m_to);
  high.setMax(ray.m_to);
  for (const std::uint32_t i : elementsAlong(low, high)) {
    const Eigen::Vector3d to = m_solver.position(m_body, i) - from;
    const double middle = to.dot(along) / length2;
    const double miss2 = (to - middle * along).squaredNorm();
    if (miss2 > radius * radius) continue;
    const double t = middle - std::sqrt((radius * radius - miss2) / length2);
    if (t < 0 || t > double(ray.m_hitFraction)) continue;
    const Eigen::Vector3d normal = (t * along - to).normalized();
    ray.m_hitFraction = ray.reportHit(toBullet(normal), btScalar(t), 0, int(i));
  }
}

void ElementShape::answer(btTriangleConvexcastCallback& sweep) const {
  btVector3 low, high, endLow, endHigh;
  sweep.m_convexShape->getAabb(sweep.m_convexShapeFrom, low, high);
  sweep.m_convexShape->getAabb(sweep.m_convexShapeTo, endLow, endHigh);
  low.setMin(endLow);
  high.setMax(endHigh);
  const btSphereShape ball(btScalar(m_solver.radius(m_body)));
  for (const std::uint32_t i : elementsAlong(low, high)) {
    const btTransform at(btQuaternion::getIdentity(), toBullet(m_solver.position(m_body, i)));
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btContinuousConvexCollision cast(sweep.m_convexShape, &ball, &simplex, &depth);
    btConvexCast::CastResult result;
    result.m_fraction = sweep.m_hitFraction;
    result.m_allowedPenetration = sweep.m_allowedPenetration;
    if (!cast.calcTimeOfImpact(sweep.m_convexShapeFrom, sweep.m_convexShapeTo, at, at, result)) continue;
    if (result.m_normal.length2() < btScalar(1e-4) || !(result.m_fraction < sweep.m_hitFraction)) continue;
    sweep.m_hitFraction =
        sweep.reportHit(result.m_normal.normalized(), result.m_hitPoint, result.m_fraction, 0, int(i));
  }
}

void ElementShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const btVector3 size = m_high - m_low;
  const btVector3 square = size * size;
  inertia = mass / btScalar(12) *
            btVector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y());
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
