#include "bullet/debris_surroundings.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <cmath>

#include "bullet/body_impl.h"
#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

constexpr double kTouch = 1e-5;  // nearer than this is a touch [m]
// A grazing sweep converges slowly. What is left then is no touch, but with a thin thing, which would be
// passed.
constexpr int kMostAdvances = 32;

// First touch of a ball with something convex, before that in `hit`. Conservative advancement: no part of it
// is nearer than nearest(place).distance.
template <class Nearest>
bool advanceTo(Nearest&& nearest, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
               bool thin, debris::DebrisHit& hit) {
  const Eigen::Vector3d way = to - from;
  const double length = way.norm();
  double t = 0;
  for (int n = 1; n <= kMostAdvances && t <= hit.fraction; ++n) {
    const Eigen::Vector3d at = from + t * way;
    const edem::SurfacePoint s = nearest(at);
    const double gap = s.distance - radius;
    if (gap <= kTouch || (thin && n == kMostAdvances)) {
      if (way.dot(s.normal) > 0) return false;  // leaving
      hit.fraction = t;
      hit.normal = s.normal;
      hit.point = at - s.distance * s.normal;
      return true;
    }
    if (!(length > 0)) return false;
    t += gap / length;
    if (t > 1) return false;
  }
  return false;
}

Eigen::Isometry3d placeOf(const edem::RigidProxy& proxy) {
  return Eigen::Translation3d(proxy.position) * proxy.orientation;
}

}  // namespace

void DebrisSurroundings::begin(const Eigen::AlignedBox3d& swept) {
  m_objects.clear();
  m_centres.clear();
  m_balls.clear();
  m_largest = 0;
  const btVector3 low = toBullet(swept.min()), high = toBullet(swept.max());
  // The world's list and not the broadphase's tree: its order does not depend on the tree's history.
  for (int i = 0; i < m_world.getNumCollisionObjects(); ++i) {
    btCollisionObject& object = *m_world.getCollisionObjectArray()[i];
    if (DestructibleBody* body = upcastElements(&object)) {
      addElements(*body, swept);
      continue;
    }
    btVector3 a, b;
    object.getCollisionShape()->getAabb(object.getWorldTransform(), a, b);
    if (object.hasContactResponse() && TestAabbAgainstAabb2(low, high, a, b)) addObject(object, swept);
  }
  m_all.assign(m_centres.size(), 1);
  if (!m_centres.empty()) m_grid.build(m_centres, m_all, 2 * m_largest);
}

void DebrisSurroundings::addObject(btCollisionObject& object, const Eigen::AlignedBox3d& swept) {
  Object o;
  o.object = &object;
  o.proxy = m_proxies.make(object, std::span(&swept, 1));
  if (o.proxy.parts.empty()) return;
  o.rigid = o.proxy.isDynamic() ? btRigidBody::upcast(&object) : nullptr;
  o.bounds = o.proxy.bounds();
  const auto [known, isNew] = m_surfaceOf.try_emplace(&object, std::uint32_t(m_places.size()));
  if (isNew) m_places.emplace_back();
  o.surface = known->second;
  m_places[o.surface] = {std::uint32_t(m_objects.size()), false};
  m_objects.push_back(std::move(o));
}

std::uint32_t DebrisSurroundings::firstSurfaceOf(std::uint32_t body, std::size_t elements) {
  constexpr std::uint32_t kUnknown = 0xffffffffu;
  if (body >= m_firstSurface.size()) m_firstSurface.resize(std::size_t(body) + 1, kUnknown);
  std::uint32_t& first = m_firstSurface[body];
  if (first == kUnknown) {
    first = std::uint32_t(m_places.size());
    m_places.resize(m_places.size() + elements);
  }
  return first;
}

void DebrisSurroundings::addElements(DestructibleBody& body, const Eigen::AlignedBox3d& swept) {
  const std::uint32_t id = body.id();
  const double radius = m_solver.radius(id);
  Eigen::AlignedBox3d grown = swept;
  grown.min().array() -= radius;
  grown.max().array() += radius;
  m_solver.elementsIn(id, grown, m_near);
  if (m_near.empty()) return;
  const edem::BodyView view = m_solver.view(id);
  const std::uint32_t first = firstSurfaceOf(id, view.alive.size());
  for (const std::uint32_t i : m_near) {
    m_places[first + i] = {std::uint32_t(m_balls.size()), true};
    m_centres.push_back(m_solver.position(id, i));
    m_balls.push_back({&body, id, i, radius, first + i, view.asleep || view.sleeping[i]});
  }
  m_largest = std::max(m_largest, radius);
}

debris::DebrisSurface DebrisSurroundings::surface(std::uint32_t id) const {
  const Place place = m_places[id];
  debris::DebrisSurface s;
  if (place.isElement) {
    const ElementBall& ball = m_balls[place.index];
    s.centre = m_centres[place.index];
    s.velocity = m_solver.velocity(ball.body, ball.element);
    s.spin = m_solver.spin(ball.body, ball.element);
    if (ball.asleep) return s;
    const edem::BodyView view = m_solver.view(ball.body);
    s.inverseMass.setConstant(1 / view.mass[ball.element]);
    s.inverseInertia = Eigen::Matrix3d::Identity() / view.inertia[ball.element];
    return s;
  }
  const Object& object = m_objects[place.index];
  const edem::RigidProxy& proxy = object.proxy;
  s.centre = proxy.position;
  s.velocity = proxy.velocity;
  s.spin = proxy.spin;
  if (!object.rigid) return s;
  if (proxy.mobility) {
    s.inverseMass = proxy.mobility->diagonal().head<3>();
    s.inverseInertia = proxy.mobility->bottomRightCorner<3, 3>();
    return s;
  }
  const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
  s.inverseMass.setConstant(proxy.inverseMass);
  s.inverseInertia = turn * proxy.inverseInertia.asDiagonal() * turn.transpose();
  return s;
}

void DebrisSurroundings::noteSupport(std::uint32_t id) {
  const Place place = m_places[id];
  if (place.isElement) {
    const ElementBall& ball = m_balls[place.index];
    m_supports.addElement(id, *ball.object, ball.body, ball.element);
  } else {
    m_supports.add(id, *m_objects[place.index].object);
  }
}

bool DebrisSurroundings::sweepObject(const Object& object, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to, double radius, debris::DebrisHit& hit) const {
  Eigen::AlignedBox3d path(from.cwiseMin(to), from.cwiseMax(to));
  path.min().array() -= radius;
  path.max().array() += radius;
  if (!path.intersects(object.bounds)) return false;
  const edem::RigidProxy& proxy = object.proxy;
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  bool found = false;
  for (const edem::Collider& part : proxy.parts) {
    if (part.kind == edem::Collider::Kind::Mesh) {
      found = sweepMesh(part, placeOf(proxy) * part.place, from, to, radius, hit) || found;
      continue;
    }
    const auto nearest = [&](const Eigen::Vector3d& at) {
      edem::SurfacePoint s = edem::nearest(part, back * (at - proxy.position));
      s.normal = proxy.orientation * s.normal;
      return s;
    };
    found = advanceTo(nearest, from, to, radius, false, hit) || found;
  }
  if (found) hit.surface = object.surface;
  return found;
}

// Triangle by triangle: what leaves one may run into the next.
bool DebrisSurroundings::sweepMesh(const edem::Collider& part, const Eigen::Isometry3d& place,
                                   const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                                   debris::DebrisHit& hit) const {
  const edem::TriangleMesh& mesh = *part.mesh;
  const Eigen::Isometry3d back = place.inverse(Eigen::Isometry);
  const double grown = radius + part.rounding;
  mesh.gather(back * (0.5 * (from + to)), 0.5 * (to - from).norm() + grown + kTouch, m_triangles);
  bool found = false;
  for (const std::uint32_t triangle : m_triangles) {
    const auto nearest = [&](const Eigen::Vector3d& at) {
      const edem::MeshPoint p = mesh.nearest(triangle, back * at);
      const Eigen::Vector3d normal =
          p.distance > 0 ? Eigen::Vector3d((back * at - p.at) / p.distance) : mesh.normal(triangle);
      return edem::SurfacePoint{p.distance - part.rounding, place.linear() * normal};
    };
    found = advanceTo(nearest, from, to, radius, true, hit) || found;
  }
  return found;
}

bool DebrisSurroundings::sweepThin(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                                   debris::DebrisHit& hit) {
  hit.fraction = 1;
  bool found = false;
  for (const Object& object : m_objects) {
    for (const edem::Collider& part : object.proxy.parts) {
      if (part.kind != edem::Collider::Kind::Mesh ||
          !sweepMesh(part, placeOf(object.proxy) * part.place, from, to, radius, hit))
        continue;
      hit.surface = object.surface;
      found = true;
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
  hit.surface = m_balls[ball].surface;
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

ElementPush DebrisSurroundings::push(std::span<const debris::SurfaceImpulse> impulses) {
  const edem::Exchange before = m_solver.books().bullet;
  ElementPush pushed;
  for (const debris::SurfaceImpulse& impulse : impulses) {
    const Place place = m_places[impulse.surface];
    if (place.isElement) {
      const ElementBall& ball = m_balls[place.index];
      if (ball.asleep) continue;
      m_solver.push(ball.body, ball.element, impulse.linear, impulse.angularAbout(m_centres[place.index]));
      pushed.given += {impulse.linear, impulse.angular, impulse.work};
    } else if (btRigidBody* rigid = m_objects[place.index].rigid) {
      // By the inverse masses that the hits counted on.
      const debris::DebrisSurface s = surface(impulse.surface);
      rigid->activate();
      rigid->setLinearVelocity(toBullet(s.velocity + s.inverseMass.cwiseProduct(impulse.linear)));
      rigid->setAngularVelocity(toBullet(s.spin + s.inverseInertia * impulse.angularAbout(s.centre)));
    }
  }
  const edem::Exchange& after = m_solver.books().bullet;
  pushed.received = {after.linear - before.linear, after.angular - before.angular,
                     after.work.done() - before.work.done()};
  return pushed;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
