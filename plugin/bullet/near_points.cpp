#include "bullet/near_points.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "bullet/body_impl.h"
#include "bullet/cell_sweep.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Fewest points that show where a contact is: the deepest, then always the one furthest from those chosen.
// A manifold of Bullet's holds four.
void keepFour(std::vector<NearPoint>& points) {
  constexpr std::size_t kPoints = MANIFOLD_CACHE_SIZE;
  if (points.size() <= kPoints) return;
  const auto deeper = [](const NearPoint& a, const NearPoint& b) { return a.distance < b.distance; };
  std::iter_swap(points.begin(), std::min_element(points.begin(), points.end(), deeper));
  for (std::size_t n = 1; n < kPoints; ++n) {
    const auto apart = [&](const NearPoint& p) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < n; ++k) least = std::min(least, (p.point - points[k].point).squaredNorm());
      return least;
    };
    const auto nearer = [&](const NearPoint& a, const NearPoint& b) { return apart(a) < apart(b); };
    const auto rest = points.begin() + std::ptrdiff_t(n);
    std::iter_swap(rest, std::max_element(rest, points.end(), nearer));
  }
  points.resize(kPoints);
}

// The other object's surface, and where elements may be near it.
class Surface {
 public:
  Surface(const DestructibleBody& own, const btCollisionObject& other, double margin)
      : m_solver(*implOf(own).world->solver), m_id(own.id()), m_margin(margin) {
    Eigen::AlignedBox3d reached = implOf(own).shape->box();
    reached.min().array() -= margin;
    reached.max().array() += margin;
    m_proxy = implOf(own).world->proxyMaker.make(other, std::span(&reached, 1));
    m_radius = m_solver.radius(m_id);
    m_box = m_proxy.bounds();
    m_box.min().array() -= m_radius + margin;
    m_box.max().array() += m_radius + margin;
  }
  const Eigen::AlignedBox3d& box() const { return m_box; }

  void addNear(std::uint32_t element, std::vector<NearPoint>& points) const {
    const Eigen::Vector3d at = m_solver.position(m_id, element);
    if (!m_box.contains(at)) return;
    const Eigen::Vector3d local = m_proxy.orientation.conjugate() * (at - m_proxy.position);
    for (const edem::Collider& part : m_proxy.parts) {
      const edem::SurfacePoint s = edem::nearest(part, local, m_radius + m_margin);
      if (s.distance - m_radius > m_margin) continue;
      const Eigen::Vector3d normal = m_proxy.orientation * s.normal;
      points.push_back({at - s.distance * normal, normal, s.distance - m_radius});
    }
  }

 private:
  const edem::Solver& m_solver;
  std::uint32_t m_id;
  double m_margin, m_radius;  // [m]
  edem::RigidProxy m_proxy;
  Eigen::AlignedBox3d m_box;
};

// As they are now, without points.
RestingPoints restNow(const DestructibleBody& own, const btCollisionObject& other, double margin) {
  RestingPoints rest{{},
                     implOf(own).world->solver->view(own.id()).sleepChanges,
                     other.getCollisionShape(),
                     other.getWorldTransform(),
                     {},
                     {},
                     margin};
  rest.shape->getAabb(rest.place, rest.low, rest.high);
  return rest;
}

bool isSame(const RestingPoints& a, const RestingPoints& b) {
  return a.sleepChanges == b.sleepChanges && a.shape == b.shape && a.place == b.place && a.low == b.low &&
         a.high == b.high && a.margin == b.margin;
}

// Points where the cells of `own` are within `margin` of a shape at `place` [m].
void addNearCells(const DestructibleBody& own, const btCollisionShape& shape, const btTransform& place,
                  double margin, std::vector<NearPoint>& points) {
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int c = 0; c < compound.getNumChildShapes(); ++c)
      addNearCells(own, *compound.getChildShape(c), place * compound.getChildTransform(c), margin, points);
    return;
  }
  const bool isPlane = shape.getShapeType() == STATIC_PLANE_PROXYTYPE;
  if (!isPlane && !shape.isConvex()) return;
  const edem::Solver& solver = *implOf(own).world->solver;
  btVector3 low, high;
  shape.getAabb(place, low, high);
  const btVector3 grow = btVector3(1, 1, 1) * btScalar(margin);
  for (const std::uint32_t i : implOf(own).shape->elementsNear(low - grow, high + grow)) {
    const CellShape cell(solver.cells(own.id()), i, solver.radius(own.id()));
    const Eigen::Vector3d at = solver.position(own.id(), i);
    const btTransform turn(toBullet(solver.orientation(own.id(), i)));
    btTransform about = place;
    about.setOrigin(place.getOrigin() - toBullet(at));
    std::optional<CellDistance> near;
    if (isPlane)
      near = distanceOf(static_cast<const btStaticPlaneShape&>(shape), about, cell, turn);
    else
      near = distanceOf(static_cast<const btConvexShape&>(shape), about, cell, turn);
    if (!near || double(near->distance) > margin) continue;
    const Eigen::Vector3d normal = -toEigen(near->normal);
    const double distance = double(near->distance);
    points.push_back({at + toEigen(near->onCell) - distance * normal, normal, distance});
  }
}

}  // namespace

std::vector<NearPoint> nearSpheres(const DestructibleBody& own, const btCollisionObject& other, double margin,
                                   std::unique_ptr<RestingPoints>& resting) {
  const Surface surface(own, other, margin);
  const edem::BodyView view = implOf(own).world->solver->view(own.id());
  const auto addThatSleep = [&](bool sleep, std::vector<NearPoint>& points) {
    for (const std::uint32_t i :
         implOf(own).shape->elementsNear(toBullet(surface.box().min()), toBullet(surface.box().max())))
      if (bool(view.sleeping[i]) == sleep) surface.addNear(i, points);
    keepFour(points);
  };
  std::vector<NearPoint> points;
  if (view.sleepingCount == 0) {
    resting.reset();
    addThatSleep(false, points);
    return points;
  }
  RestingPoints now = restNow(own, other, margin);
  if (!resting || !isSame(*resting, now)) {
    addThatSleep(true, now.points);
    resting = std::make_unique<RestingPoints>(std::move(now));
  }
  points = resting->points;
  // Few, most often: looked for one by one, not in the tree.
  for (std::uint32_t i = 0; i < view.alive.size(); ++i)
    if (view.alive[i] && !view.sleeping[i]) surface.addNear(i, points);
  keepFour(points);
  return points;
}

std::vector<NearPoint> nearCells(const DestructibleBody& own, const btCollisionObjectWrapper& other,
                                 double margin) {
  std::vector<NearPoint> points;
  addNearCells(own, *other.getCollisionShape(), other.getWorldTransform(), margin, points);
  keepFour(points);
  return points;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
