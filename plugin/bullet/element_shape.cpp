#include "bullet/element_shape.h"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <cmath>

#include "bullet/cell_sweep.h"
#include "bullet/convert.h"
#include "edem/cell_ray.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

ElementShape::ElementShape(const edem::Solver& solver, std::uint32_t body) : m_solver(solver), m_body(body) {
  m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  follow();
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

Eigen::AlignedBox3d ElementShape::box() const {
  return {toEigen(m_low), toEigen(m_high)};
}

void ElementShape::getAabb(const btTransform&, btVector3& low, btVector3& high) const {
  low = m_low;
  high = m_high;
}

// Bullet's generic concave path for rays and sweeps: each element answers as its cell.
void ElementShape::processAllTriangles(btTriangleCallback* callback, const btVector3&,
                                       const btVector3&) const {
  if (auto* ray = dynamic_cast<btTriangleRaycastCallback*>(callback)) {
    answer(*ray);
  } else if (auto* sweep = dynamic_cast<btTriangleConvexcastCallback*>(callback); sweep && !m_hidden) {
    answer(*sweep);
  }
}

// Elements whose reach a ball meets on its way, by where it first does: nothing is hit before.
std::vector<ElementShape::Near> ElementShape::nearest(const std::vector<std::uint32_t>& elements,
                                                      const btVector3& from, const btVector3& to,
                                                      double ball) const {
  const edem::CellFaces* cells = m_solver.cells(m_body);
  const Eigen::Vector3d start = toEigen(from), way = toEigen(to) - start;
  const double length2 = way.squaredNorm();
  std::vector<Near> near;
  for (const std::uint32_t i : elements) {
    const Eigen::Vector3d at = m_solver.position(m_body, i) - start;
    const double reach = ball + (cells ? cells->reach[i] : m_solver.radius(m_body));
    // What only turns is near all the way.
    const double middle = length2 > 0 ? at.dot(way) / length2 : 0.5;
    const double inside2 = reach * reach - (at - middle * way).squaredNorm();
    if (inside2 < 0) continue;
    const double half = length2 > 0 ? std::sqrt(inside2 / length2) : 0.5;
    if (middle + half >= 0 && middle - half <= 1) near.push_back({middle - half, middle + half, i});
  }
  std::sort(near.begin(), near.end());
  return near;
}

// Elements are solid: a ray hits where it enters one, never where it leaves, whatever its flags say of faces
// seen from behind.
void ElementShape::answer(btTriangleRaycastCallback& ray) const {
  const edem::CellFaces* cells = m_solver.cells(m_body);
  // A ray comes in the object's frame; a sweep does not.
  const btTransform frame = m_object ? m_object->getWorldTransform() : btTransform::getIdentity();
  const btVector3 begin = frame * ray.m_from, end = frame * ray.m_to, none(0, 0, 0);
  const Eigen::Vector3d from = toEigen(begin), along = toEigen(end) - from;
  if (!(along.squaredNorm() > 0)) return;
  for (const Near& n : nearest(m_tree.along(begin, end, none, none), begin, end, 0)) {
    const double limit = double(ray.m_hitFraction);
    if (n.begin > limit) break;
    const Eigen::Vector3d to = m_solver.position(m_body, n.element) - from;
    double t = n.begin;
    Eigen::Vector3d normal = (t * along - to).normalized();
    if (cells) {
      const Eigen::Quaterniond turn = m_solver.orientation(m_body, n.element), back = turn.conjugate();
      const auto entry =
          edem::firstEntry(*cells, n.element, back * Eigen::Vector3d(-to), back * along, limit);
      if (!entry) continue;
      t = entry->t;
      normal = turn * entry->normal;
    }
    if (t < 0) continue;
    ray.m_hitFraction = ray.reportHit(toBullet(normal) * frame.getBasis(), btScalar(t), 0, int(n.element));
  }
}

void ElementShape::answer(btTriangleConvexcastCallback& sweep) const {
  const btTransform &from = sweep.m_convexShapeFrom, &to = sweep.m_convexShapeTo;
  // A ball about what moves holds it however it turns.
  btVector3 centre;
  btScalar ball;
  sweep.m_convexShape->getBoundingSphere(centre, ball);
  ball += centre.length();
  btVector3 low = btVector3(-1, -1, -1) * ball, high = btVector3(1, 1, 1) * ball;
  if (from.getBasis() == to.getBasis()) sweep.m_convexShape->getAabb(btTransform(from.getBasis()), low, high);
  const auto elements = m_tree.along(from.getOrigin(), to.getOrigin(), low, high);
  for (const Near& n : nearest(elements, from.getOrigin(), to.getOrigin(), double(ball))) {
    if (n.begin > double(sweep.m_hitFraction)) break;
    sweepElement(n, sweep);
  }
}

// About the element's centre and where it is near, so that Bullet's floats lose nothing of what a long way or
// a far place takes.
void ElementShape::sweepElement(const Near& near, btTriangleConvexcastCallback& sweep) const {
  const btVector3 centre = toBullet(m_solver.position(m_body, near.element));
  const CellShape cell(m_solver.cells(m_body), near.element, m_solver.radius(m_body));
  const btTransform at(toBullet(m_solver.orientation(m_body, near.element)));
  btTransform first = sweep.m_convexShapeFrom, last = sweep.m_convexShapeTo;
  first.setOrigin(first.getOrigin() - centre);
  last.setOrigin(last.getOrigin() - centre);
  const btScalar begin = btScalar(std::max(0.0, near.begin)), end = btScalar(std::min(1.0, near.end));
  const auto hit = sweepShape(*sweep.m_convexShape, between(first, last, begin), between(first, last, end),
                              cell, at, sweep.m_allowedPenetration);
  if (!hit) return;
  const btScalar fraction = begin + hit->fraction * (end - begin);
  if (!(fraction < sweep.m_hitFraction)) return;
  sweep.m_hitFraction = sweep.reportHit(hit->normal, hit->onCell + centre, fraction, 0, int(near.element));
}

void ElementShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const btVector3 size = m_high - m_low;
  const btVector3 square = size * size;
  inertia = mass / btScalar(12) *
            btVector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y());
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
