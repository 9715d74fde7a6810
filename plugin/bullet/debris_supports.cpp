#include "bullet/debris_supports.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>
#include <utility>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// A support that moved further than this has left its debris [m]: a gap that nobody sees.
constexpr double kLeft = 5e-4;

// No point of the shape has moved further.
double wayBetween(const btTransform& from, const btTransform& to, const btCollisionShape& shape) {
  if (from == to) return 0;
  const double shift = double((to.getOrigin() - from.getOrigin()).length());
  const double turn = 2 * (toEigen(from.getRotation()).conjugate() * toEigen(to.getRotation())).vec().norm();
  btVector3 centre;
  btScalar radius;
  shape.getBoundingSphere(centre, radius);
  return shift + turn * double(radius + centre.length());
}

}  // namespace

bool DebrisSupports::isNew(std::uint32_t surface) {
  if (surface >= m_known.size()) m_known.resize(std::size_t(surface) + 1, 0);
  return std::exchange(m_known[surface], std::uint8_t(1)) == 0;
}

void DebrisSupports::depart(std::uint32_t surface) {
  m_known[surface] = 0;
  m_departed.push_back(surface);
}

void DebrisSupports::add(std::uint32_t surface, btCollisionObject& object) {
  if (!isNew(surface)) return;
  m_objects.push_back({{&object, object.getWorldArrayIndex()},
                       surface,
                       object.getWorldTransform(),
                       object.getCollisionShape()});
}

void DebrisSupports::addElement(std::uint32_t surface, btCollisionObject& body, std::uint32_t id,
                                std::uint32_t element) {
  if (!isNew(surface)) return;
  auto known = std::find_if(m_bodies.begin(), m_bodies.end(), [id](const Body& b) { return b.id == id; });
  if (known == m_bodies.end()) known = m_bodies.insert(known, {{&body, body.getWorldArrayIndex()}, id, {}});
  known->elements.push_back({surface, element, m_solver.position(id, element)});
}

bool DebrisSupports::isPresent(Presence& presence) const {
  const btCollisionObjectArray& all = m_world.getCollisionObjectArray();
  const auto isAt = [&](int index) {
    return index >= 0 && index < all.size() && all[index] == presence.object;
  };
  // Removing one object moves another in the list.
  if (!isAt(presence.index)) presence.index = all.findLinearSearch(presence.object);
  return isAt(presence.index);
}

bool DebrisSupports::hasLeft(Support& support) const {
  if (!isPresent(support.presence)) return true;
  const btCollisionObject& object = *support.presence.object;
  return !object.hasContactResponse() || object.getCollisionShape() != support.shape ||
         wayBetween(support.at, object.getWorldTransform(), *support.shape) > kLeft;
}

void DebrisSupports::takeDeparted(Body& body) {
  const DestructibleBody* own =
      isPresent(body.presence) ? DestructibleBody::upcast(body.presence.object) : nullptr;
  // The elements of a whole body are nobody's support: its rigid shape is.
  const bool isThere = own && own->id() == body.id && !own->isWhole();
  if (isThere && m_solver.view(body.id).asleep) return;
  std::erase_if(body.elements, [&](const Element& e) {
    const bool stays = isThere && m_solver.view(body.id).alive[e.element] &&
                       (m_solver.position(body.id, e.element) - e.at).norm() <= kLeft;
    if (!stays) depart(e.surface);
    return !stays;
  });
}

std::span<const std::uint32_t> DebrisSupports::takeDeparted() {
  m_departed.clear();
  std::erase_if(m_objects, [this](Support& support) {
    const bool left = hasLeft(support);
    if (left) depart(support.surface);
    return left;
  });
  for (Body& body : m_bodies) takeDeparted(body);
  std::erase_if(m_bodies, [](const Body& body) { return body.elements.empty(); });
  return m_departed;
}

void DebrisSupports::clear() {
  if (m_objects.empty() && m_bodies.empty()) return;
  m_objects.clear();
  m_bodies.clear();
  std::fill(m_known.begin(), m_known.end(), std::uint8_t(0));
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
