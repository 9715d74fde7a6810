#include "bullet/debris_surroundings.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <cmath>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

constexpr double kTouch = 1e-5;    // nearer than this is a touch [m]
constexpr int kMostAdvances = 32;  // a grazing sweep converges slowly; what is left then is no touch

// Velocity change along n of a rigid body for a unit impulse at `at`.
double inverseMassAt(const edem::RigidProxy& p, const Eigen::Vector3d& at, const Eigen::Vector3d& n) {
  const Eigen::Matrix3d turn = p.orientation.toRotationMatrix();
  const Eigen::Vector3d lever = (at - p.position).cross(n);
  const Eigen::Vector3d local = turn.transpose() * lever;
  return p.inverseMass + local.dot(p.inverseInertia.cwiseProduct(local));
}

}  // namespace

void DebrisSurroundings::begin(const Eigen::AlignedBox3d& swept) {
  m_objects.clear();
  m_centres.clear();
  m_balls.clear();
  m_largest = 0;
  std::fill(m_present.begin(), m_present.end(), std::uint8_t(0));
  const btVector3 low = toBullet(swept.min()), high = toBullet(swept.max());
  // The world's list and not the broadphase's tree: its order does not depend on the tree's history.
  for (int i = 0; i < m_world.getNumCollisionObjects(); ++i) {
    btCollisionObject& object = *m_world.getCollisionObjectArray()[i];
    if (const DestructibleBody* body = DestructibleBody::upcast(&object)) {
      addElements(body->id(), swept);
      continue;
    }
    btVector3 a, b;
    object.getCollisionShape()->getAabb(object.getWorldTransform(), a, b);
    if (object.hasContactResponse() && TestAabbAgainstAabb2(low, high, a, b)) addObject(object);
  }
  m_all.assign(m_centres.size(), 1);
  if (!m_centres.empty()) m_grid.build(m_centres, m_all, 2 * m_largest);
}

void DebrisSurroundings::addObject(btCollisionObject& object) {
  Object o;
  o.proxy = m_proxies.make(object);
  if (o.proxy.parts.empty()) return;
  o.bounds = o.proxy.bounds();
  o.surface = debris::kFixedSurface;
  if (o.proxy.isDynamic()) {
    btRigidBody* rigid = btRigidBody::upcast(&object);
    const auto found = std::find(m_movable.begin(), m_movable.end(), rigid);
    o.surface = std::uint32_t(found - m_movable.begin());
    if (found == m_movable.end()) {
      m_movable.push_back(rigid);
      m_present.push_back(1);
    }
    m_present[o.surface] = 1;
  }
  m_objects.push_back(std::move(o));
}

void DebrisSurroundings::addElements(std::uint32_t body, const Eigen::AlignedBox3d& swept) {
  const double radius = m_solver.radius(body);
  Eigen::AlignedBox3d grown = swept;
  grown.min().array() -= radius;
  grown.max().array() += radius;
  m_solver.elementsIn(body, grown, m_near);
  const edem::BodyView view = m_solver.view(body);
  for (const std::uint32_t i : m_near) {
    m_centres.push_back(m_solver.position(body, i));
    m_balls.push_back({body, i, radius, view.asleep ? 0 : 1 / view.mass[i]});
  }
  if (!m_near.empty()) m_largest = std::max(m_largest, radius);
}

bool DebrisSurroundings::sweepObject(const Object& object, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to, double radius, debris::DebrisHit& hit) const {
  Eigen::AlignedBox3d path(from.cwiseMin(to), from.cwiseMax(to));
  path.min().array() -= radius;
  path.max().array() += radius;
  if (!path.intersects(object.bounds)) return false;
  const edem::RigidProxy& proxy = object.proxy;
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  const double length = (to - from).norm();
  bool found = false;
  for (const edem::Collider& part : proxy.parts) {
    // Conservative advancement: no part of a convex surface is nearer than its signed distance.
    double t = 0;
    for (int n = 0; n < kMostAdvances && t <= hit.fraction; ++n) {
      const Eigen::Vector3d at = from + t * (to - from);
      const edem::SurfacePoint s = edem::nearest(part, back * (at - proxy.position));
      const Eigen::Vector3d normal = proxy.orientation * s.normal;
      const double gap = s.distance - radius;
      if (gap <= kTouch) {
        if ((to - from).dot(normal) > 0) break;  // leaving
        hit.fraction = t;
        hit.normal = normal;
        hit.point = at - s.distance * normal;
        hit.surfaceVelocity = proxy.velocity + proxy.spin.cross(hit.point - proxy.position);
        hit.inverseMass = proxy.isDynamic() ? inverseMassAt(proxy, hit.point, normal) : 0;
        hit.surface = object.surface;
        found = true;
        break;
      }
      if (!(length > 0)) break;
      t += gap / length;
      if (t > 1) break;
    }
  }
  return found;
}

bool DebrisSurroundings::sweepElement(std::uint32_t ball, const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& to, double radius,
                                      debris::DebrisHit& hit) const {
  const double reach = m_balls[ball].radius + radius;
  const Eigen::Vector3d along = to - from, out = from - m_centres[ball];
  const double a = along.squaredNorm(), b = out.dot(along), c = out.squaredNorm() - reach * reach;
  if (b > 0 || (a <= 0 && c > 0)) return false;  // leaving, or still and free
  double t = 0;
  if (c > 0) {
    const double root = b * b - a * c;
    if (root < 0) return false;
    t = (-b - std::sqrt(root)) / a;
  }
  if (t > hit.fraction) return false;
  const Eigen::Vector3d arm = from + t * along - m_centres[ball];
  const double distance = arm.norm();
  if (!(distance > 0)) return false;
  hit.fraction = t;
  hit.normal = arm / distance;
  hit.point = m_centres[ball] + m_balls[ball].radius * hit.normal;
  hit.surfaceVelocity =
      m_solver.velocity(m_balls[ball].body, m_balls[ball].element) +
      m_solver.spin(m_balls[ball].body, m_balls[ball].element).cross(hit.point - m_centres[ball]);
  hit.inverseMass = m_balls[ball].inverseMass;  // the normal goes through its centre
  hit.surface = hit.inverseMass > 0 ? std::uint32_t(m_movable.size()) + ball : debris::kFixedSurface;
  return true;
}

bool DebrisSurroundings::sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                               debris::DebrisHit& hit) {
  hit.fraction = 1;
  bool found = false;
  for (const Object& object : m_objects) found = sweepObject(object, from, to, radius, hit) || found;
  if (m_centres.empty()) return found;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(m_largest + radius);
  const Eigen::Vector3d low = from.cwiseMin(to) - reach, high = from.cwiseMax(to) + reach;
  const auto consider = [&](std::uint32_t ball) {
    found = sweepElement(ball, from, to, radius, hit) || found;
  };
  if (m_grid.cellsIn(low, high) > double(m_centres.size())) {
    for (std::uint32_t ball = 0; ball < m_centres.size(); ++ball) consider(ball);
  } else {
    m_grid.visitBox(low, high, consider);
  }
  return found;
}

void DebrisSurroundings::push(std::span<const debris::SurfaceImpulse> impulses) {
  for (std::uint32_t s = 0; s < impulses.size(); ++s) {
    if (impulses[s].hits == 0) continue;
    if (s >= m_movable.size()) {
      const ElementBall& ball = m_balls[s - m_movable.size()];
      m_solver.push(ball.body, ball.element, impulses[s].linear,
                    impulses[s].angularAbout(m_centres[s - m_movable.size()]));
    } else if (m_present[s]) {
      btRigidBody& rigid = *m_movable[s];
      rigid.activate();
      rigid.applyCentralImpulse(toBullet(impulses[s].linear));
      rigid.applyTorqueImpulse(toBullet(impulses[s].angularAbout(toEigen(rigid.getCenterOfMassPosition()))));
    }
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
