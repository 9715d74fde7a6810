#include "bullet/element_algorithm.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <limits>

#include "bullet/body_impl.h"
#include "bullet/cell_sweep.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// A point where an element and the other object are near.
struct Near {
  Eigen::Vector3d point, normal;  // on the other object's surface, out of it
  double distance;
};

// Fewest points that show where a contact is: the deepest, then always the one furthest from those chosen.
// A manifold of Bullet's holds four.
void keepFour(std::vector<Near>& points) {
  constexpr std::size_t kPoints = MANIFOLD_CACHE_SIZE;
  if (points.size() <= kPoints) return;
  const auto deeper = [](const Near& a, const Near& b) { return a.distance < b.distance; };
  std::iter_swap(points.begin(), std::min_element(points.begin(), points.end(), deeper));
  for (std::size_t n = 1; n < kPoints; ++n) {
    const auto apart = [&](const Near& p) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < n; ++k) least = std::min(least, (p.point - points[k].point).squaredNorm());
      return least;
    };
    const auto nearer = [&](const Near& a, const Near& b) { return apart(a) < apart(b); };
    const auto rest = points.begin() + std::ptrdiff_t(n);
    std::iter_swap(rest, std::max_element(rest, points.end(), nearer));
  }
  points.resize(kPoints);
}

// Points of the elements' spheres of `own` within `margin` of `other` [m]: what each tick can afford.
std::vector<Near> nearSpheres(const DestructibleBody& own, const btCollisionObject& other, double margin) {
  std::vector<Near> points;
  Destruction::Impl& world = *own.impl().world;
  Eigen::AlignedBox3d reached = own.impl().shape->box();
  reached.min().array() -= margin;
  reached.max().array() += margin;
  const edem::RigidProxy proxy = world.proxyMaker.make(other, std::span(&reached, 1));
  const edem::Solver& solver = *world.solver;
  const double radius = solver.radius(own.id());
  Eigen::AlignedBox3d box = proxy.bounds();
  box.min().array() -= radius + margin;
  box.max().array() += radius + margin;
  const Eigen::Quaterniond back = proxy.orientation.conjugate();
  for (const std::uint32_t i : own.impl().shape->elementsNear(toBullet(box.min()), toBullet(box.max()))) {
    const Eigen::Vector3d at = solver.position(own.id(), i);
    if (!box.contains(at)) continue;
    for (const edem::Collider& part : proxy.parts) {
      const edem::SurfacePoint s = edem::nearest(part, back * (at - proxy.position), radius + margin);
      if (s.distance - radius > margin) continue;
      const Eigen::Vector3d normal = proxy.orientation * s.normal;
      points.push_back({at - s.distance * normal, normal, s.distance - radius});
    }
  }
  keepFour(points);
  return points;
}

// Points where the cells of `own` are within `margin` of a shape at `place` [m].
void addNearCells(const DestructibleBody& own, const btCollisionShape& shape, const btTransform& place,
                  double margin, std::vector<Near>& points) {
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int c = 0; c < compound.getNumChildShapes(); ++c)
      addNearCells(own, *compound.getChildShape(c), place * compound.getChildTransform(c), margin, points);
    return;
  }
  const bool isPlane = shape.getShapeType() == STATIC_PLANE_PROXYTYPE;
  if (!isPlane && !shape.isConvex()) return;
  const edem::Solver& solver = *own.impl().world->solver;
  btVector3 low, high;
  shape.getAabb(place, low, high);
  const btVector3 grow = btVector3(1, 1, 1) * btScalar(margin);
  for (const std::uint32_t i : own.impl().shape->elementsNear(low - grow, high + grow)) {
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

// Changes nothing, neither in the world nor in what it keeps of shapes.
std::vector<Near> nearCells(const DestructibleBody& own, const btCollisionObjectWrapper& other,
                            double margin) {
  std::vector<Near> points;
  addNearCells(own, *other.getCollisionShape(), other.getWorldTransform(), margin, points);
  keepFour(points);
  return points;
}

// Notes who is near for the substeps, and writes manifold points for the application; Bullet's solver leaves
// these alone (DestructibleBody's contactProcessingThreshold). Two destructibles touch by their elements and
// have no manifold points. Stays small: Bullet makes algorithms in a pool of fixed pieces and does not check
// (192 bytes by default).
class ElementAlgorithm : public btCollisionAlgorithm {
 public:
  ElementAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
                   const btCollisionObjectWrapper* second, bool isQuery)
      : btCollisionAlgorithm(info), m_isQuery(isQuery) {
    m_manifold = m_dispatcher->getNewManifold(first->getCollisionObject(), second->getCollisionObject());
  }
  // The two part, or one of them leaves the world: what sleeps on the other would hang in the air.
  ~ElementAlgorithm() override {
    if (m_touching) {
      const_cast<btCollisionObject*>(m_manifold->getBody0())->activate();
      const_cast<btCollisionObject*>(m_manifold->getBody1())->activate();
    }
    m_dispatcher->releaseManifold(m_manifold);
  }

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    const btCollisionObject *a = first->getCollisionObject(), *b = second->getCollisionObject();
    const DestructibleBody *ownA = upcastElements(a), *ownB = upcastElements(b);
    m_manifold->clearManifold();  // elements move within their body's frame: no point outlives a tick
    m_touching = !m_isQuery && ownA && ownB;  // as far as is known without a look at all their elements
    if (!ownA == !ownB) return;
    if (const btSoftBody* soft = btSoftBody::upcast(ownA ? b : a)) {
      if (!m_isQuery) meet(ownA ? *ownA : *ownB, *soft, info);
      return;
    }
    if (!m_isQuery) note(ownA ? *ownA : *ownB, ownA ? *b : *a);
    result->setPersistentManifold(m_manifold);
    const double margin = m_isQuery ? double(result->m_closestPointDistanceThreshold)
                                    : double(m_manifold->getContactBreakingThreshold());
    const DestructibleBody& own = ownA ? *ownA : *ownB;
    if (!own.impl().world) return;
    for (const Near& p : m_isQuery ? nearCells(own, ownA ? *second : *first, margin)
                                   : nearSpheres(own, ownA ? *b : *a, margin)) {
      // Bullet wants the point on the second object, and the normal from it to the first.
      if (!m_isQuery) m_touching = m_touching || p.distance < own.impl().shape->margin();
      const Eigen::Vector3d onElement = p.point + p.distance * p.normal;
      result->addContactPoint(toBullet(ownB ? Eigen::Vector3d(-p.normal) : p.normal),
                              toBullet(ownB ? onElement : p.point), btScalar(p.distance));
    }
  }
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override { manifolds.push_back(m_manifold); }

 private:
  static void note(const DestructibleBody& own, const btCollisionObject& other) {
    // A character walks by its ghost's sweeps, sinks into what it stands on and would crush it.
    const bool isGhost = other.getInternalType() == btCollisionObject::CO_GHOST_OBJECT;
    if (isGhost || !other.hasContactResponse()) return;
    const_cast<DestructibleBody&>(own).impl().near.push_back(const_cast<btCollisionObject*>(&other));
  }

  static void meet(const DestructibleBody& own, const btSoftBody& soft, const btDispatcherInfo& info) {
    if (Destruction::Impl* world = own.impl().world)
      world->softContacts.meet(const_cast<DestructibleBody&>(own), const_cast<btSoftBody&>(soft),
                               double(info.m_timeStep));
  }

  btPersistentManifold* m_manifold;
  bool m_isQuery;
  bool m_touching = false;  // when last looked at
};

}  // namespace

btCollisionAlgorithm* ElementAlgorithms::CreateFunc::CreateCollisionAlgorithm(
    btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
    const btCollisionObjectWrapper* second) {
  static_assert(sizeof(ElementAlgorithm) <= 64);
  void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(ElementAlgorithm));
  return new (memory) ElementAlgorithm(info, first, second, isQuery);
}

ElementAlgorithms::ElementAlgorithms(btCollisionDispatcher& dispatcher) : m_dispatcher(dispatcher) {
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    for (const auto& [a, b] : {std::pair(FAST_CONCAVE_MESH_PROXYTYPE + 0, type),
                               std::pair(type, FAST_CONCAVE_MESH_PROXYTYPE + 0)}) {
      dispatcher.registerCollisionCreateFunc(a, b, &m_contact);
      dispatcher.registerClosestPointsCreateFunc(a, b, &m_query);
    }
  }
}

ElementAlgorithms::~ElementAlgorithms() {
  btCollisionConfiguration* stock = m_dispatcher.getCollisionConfiguration();
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    for (const auto& [a, b] : {std::pair(FAST_CONCAVE_MESH_PROXYTYPE + 0, type),
                               std::pair(type, FAST_CONCAVE_MESH_PROXYTYPE + 0)}) {
      m_dispatcher.registerCollisionCreateFunc(a, b, stock->getCollisionAlgorithmCreateFunc(a, b));
      m_dispatcher.registerClosestPointsCreateFunc(a, b, stock->getClosestPointsAlgorithmCreateFunc(a, b));
    }
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
