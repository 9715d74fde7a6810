// What Bullet's own contacts hold light bodies by while elements press them. A crate between a slab that
// falls and the ground took no more of its momentum in a tick than its own.
#include <LinearMath/btQuickprof.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toEigen;

// Of this body along the normal; the second of a manifold has it the other way round.
edem::Support supportAt(const btManifoldPoint& point, bool second, const btCollisionObject& own,
                        const btCollisionObject& other, std::uint32_t place) {
  edem::Support s;
  s.other = place;
  s.at = toEigen((second ? point.getPositionWorldOnB() : point.getPositionWorldOnA()) -
                 own.getWorldTransform().getOrigin());
  s.atOther = toEigen((second ? point.getPositionWorldOnA() : point.getPositionWorldOnB()) -
                      other.getWorldTransform().getOrigin());
  s.normal = (second ? -1 : 1) * toEigen(point.m_normalWorldOnB).normalized();
  s.gap = double(point.getDistance());
  s.friction = double(point.m_combinedFriction);
  return s;
}

// Corners of boxes and hulls, frame of the body; none where another part is without.
std::vector<Eigen::Vector3d> cornersOf(const edem::RigidProxy& proxy) {
  std::vector<Eigen::Vector3d> corners;
  for (const edem::Collider& part : proxy.parts) {
    if (part.kind == edem::Collider::Kind::Hull) {
      for (const Eigen::Vector3d& at : part.hull->corners) corners.push_back(part.place * at);
    } else if (part.kind == edem::Collider::Kind::Box) {
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d sides(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        corners.push_back(part.place * part.size.cwiseProduct(sides));
      }
    } else {
      return {};
    }
  }
  return corners;
}

// Bullet gives one point of a body and a plane in a tick, about which it would tip over.
void addCorners(const btPersistentManifold& manifold, const edem::Support& first, edem::RigidProxy& proxy) {
  const auto threshold = double(manifold.getContactBreakingThreshold());
  const double above = first.normal.dot(first.at) - first.gap;  // the plane's, from the centre
  for (const Eigen::Vector3d& corner : cornersOf(proxy)) {
    edem::Support s = first;
    s.at = proxy.orientation * corner;
    s.gap = first.normal.dot(s.at) - above;
    if (s.gap < threshold) proxy.supports.push_back(s);
  }
}

bool isSolvedByBullet(const btPersistentManifold& manifold) {
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  return manifold.getNumContacts() > 0 && a.hasContactResponse() && b.hasContactResponse() &&
         !upcastElements(&a) && !upcastElements(&b);
}

}  // namespace

// Bodies that lie on light ones, and those that these lie on, come along.
void Destruction::Impl::gatherSupports(double dt, std::span<const Eigen::AlignedBox3d> boxes) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const DestructibleBody* body : elementBodies)
    if (body->isActive()) lightest = std::min(lightest, std::ranges::min(solver->view(body->id()).mass));
  const auto isLight = [&](const btCollisionObject& object) {
    const btRigidBody* rigid = btRigidBody::upcast(&object);
    return rigid && !rigid->isStaticOrKinematicObject() && double(rigid->getInvMass()) * lightest > 1;
  };
  std::unordered_map<const btCollisionObject*, std::uint32_t> placeOf;
  const auto note = [&](std::size_t place) {
    const bool isFree = proxies[place].isDynamic() && !proxies[place].mobility;  // in every way
    if (isFree && isLight(*touched[place].object)) placeOf[touched[place].object] = std::uint32_t(place);
  };
  for (std::size_t p = 0; p < touched.size(); ++p) note(p);
  if (placeOf.empty()) return;
  BT_PROFILE("Rubble gather supports");
  std::vector<const btPersistentManifold*> manifolds;
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const bool between = isLight(*manifold.getBody0()) || isLight(*manifold.getBody1());
    if (between && isSolvedByBullet(manifold)) manifolds.push_back(&manifold);
  }
  for (std::size_t before = 0; before != placeOf.size();) {
    before = placeOf.size();
    for (const btPersistentManifold* manifold : manifolds) {
      const btCollisionObject *a = manifold->getBody0(), *b = manifold->getBody1();
      if (placeOf.contains(a) == placeOf.contains(b)) continue;
      const btCollisionObject* next = placeOf.contains(a) ? b : a;
      if (!isLight(*next) || isTouched(*next)) continue;
      const std::size_t place = proxies.size();
      addProxy(*const_cast<btCollisionObject*>(next), nullptr, false, dt, boxes);
      if (proxies.size() > place) note(place);
    }
  }
  // What does not move in the substeps.
  const auto isFirm = [&](const btCollisionObject& object) {
    if (object.isStaticObject()) return !object.isKinematicObject();
    return std::ranges::any_of(touched,
                               [&](const bullet::TouchedBody& t) { return t.object == &object && t.held; });
  };
  for (const btPersistentManifold* manifold : manifolds) {
    const btCollisionObject *a = manifold->getBody0(), *b = manifold->getBody1();
    const bool second = !placeOf.contains(a);
    if (second) std::swap(a, b);
    const auto own = placeOf.find(a), other = placeOf.find(b);
    if (own == placeOf.end() || (other == placeOf.end() && !isFirm(*b))) continue;
    const std::uint32_t place = other == placeOf.end() ? edem::Support::kImmovable : other->second;
    edem::RigidProxy& proxy = proxies[own->second];
    const std::size_t before = proxy.supports.size();
    if (b->getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE)
      addCorners(*manifold, supportAt(manifold->getContactPoint(0), second, *a, *b, place), proxy);
    if (proxy.supports.size() > before) continue;
    for (int i = 0; i < manifold->getNumContacts(); ++i)
      proxy.supports.push_back(supportAt(manifold->getContactPoint(i), second, *a, *b, place));
  }
}

RUBBLE_ABI_END
}  // namespace rubble
