#include "bullet/swept_bodies.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/multibody_links.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// What a heavy body at speed v strikes without any loss leaves at 2 v.
constexpr double kRebound = 2;

// No point of the object is faster within the tick, as long as nothing strikes it [m/s].
double surfaceSpeed(const btCollisionObject& object, double dt) {
  if (const auto* link = btMultiBodyLinkCollider::upcast(&object)) {
    const LinkMotion motion = motionOf(*link);
    const double speed = motion.head<3>().norm() +
                         motion.tail<3>().norm() * double(object.getCollisionShape()->getAngularMotionDisc());
    return std::isfinite(speed) ? speed : 0;
  }
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  if (!rigid || (object.isStaticObject() && !object.isKinematicObject())) return 0;
  const btScalar gained = btScalar(dt) * rigid->getInvMass() * rigid->getTotalForce().length();
  const btScalar turning =
      rigid->getAngularVelocity().length() * rigid->getCollisionShape()->getAngularMotionDisc();
  const auto speed = double(rigid->getLinearVelocity().length() + gained + turning);
  return std::isfinite(speed) ? speed : 0;  // what is not finite touches nothing (RigidProxies)
}

// Fastest element or object that may strike an element in this tick [m/s]. Of all bodies: what one throws may
// strike another, and throw that.
double fastestNear(std::span<DestructibleBody* const> bodies, double dt) {
  double fastest = 0;
  for (const DestructibleBody* body : bodies) {
    const DestructibleBody::Impl& own = implOf(*body);
    if (body->isActive()) fastest = std::max(fastest, own.speed);
    for (const btCollisionObject* object : own.near) fastest = std::max(fastest, surfaceSpeed(*object, dt));
  }
  return fastest;
}

// Collects the objects in a box that may touch a destructible body.
class Reachable : public btBroadphaseAabbCallback {
 public:
  Reachable(btCollisionWorld& world, DestructibleBody& own, const btVector3& low, const btVector3& high)
      : m_world(world), m_own(own), m_low(low), m_high(high) {
    world.getBroadphase()->aabbTest(low, high, *this);
  }

  bool process(const btBroadphaseProxy* found) override {
    auto* object = static_cast<btCollisionObject*>(found->m_clientObject);
    const int kind = object->getInternalType();
    const bool isSparing =
        kind == btCollisionObject::CO_SOFT_BODY || kind == btCollisionObject::CO_GHOST_OBJECT;
    if (upcastElements(object) || isSparing || !object->hasContactResponse()) return true;
    // The broadphase may keep wider boxes than the objects' own, after how they moved.
    if (!TestAabbAgainstAabb2(m_low, m_high, found->m_aabbMin, found->m_aabbMax)) return true;
    if (mayTouch(m_world, m_own, *object)) m_objects.push_back(object);
    return true;
  }

  std::vector<btCollisionObject*>& objects() { return m_objects; }

 private:
  btCollisionWorld& m_world;
  DestructibleBody& m_own;
  btVector3 m_low, m_high;
  std::vector<btCollisionObject*> m_objects;
};

}  // namespace

bool mayTouch(btCollisionWorld& world, DestructibleBody& body, btCollisionObject& object) {
  return world.getPairCache()->needsBroadphaseCollision(body.getBroadphaseHandle(),
                                                        object.getBroadphaseHandle()) &&
         world.getDispatcher()->needsCollision(&body, &object);
}

std::vector<Eigen::AlignedBox3d> reachedBoxes(std::span<DestructibleBody* const> bodies, double dt) {
  const double reach = kRebound * fastestNear(bodies, dt) * dt;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (DestructibleBody* body : bodies) {
    if (!body->isActive()) continue;
    const DestructibleBody::Impl& own = implOf(*body);
    Eigen::AlignedBox3d box = own.shape->box();
    box.min().array() -= reach + own.shape->margin();
    box.max().array() += reach + own.shape->margin();
    // A union may meet one that none of its parts did.
    for (auto other = boxes.begin(); other != boxes.end();) {
      if (!other->intersects(box)) {
        ++other;
        continue;
      }
      box.extend(*other);
      boxes.erase(other);
      other = boxes.begin();
    }
    boxes.push_back(box);
  }
  return boxes;
}

void addSwept(btCollisionWorld& world, std::span<DestructibleBody* const> bodies, double dt) {
  const double reach = kRebound * fastestNear(bodies, dt) * dt;
  for (DestructibleBody* body : bodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (!body->isActive() || !(reach > own.shape->margin())) continue;
    btVector3 low, high;
    own.shape->getAabb(body->getWorldTransform(), low, high);
    const btVector3 grow = btScalar(reach) * btVector3(1, 1, 1);
    Reachable reachable(world, *body, low - grow, high + grow);
    std::vector<btCollisionObject*>& found = reachable.objects();
    const auto noted = [&](btCollisionObject* object) {
      return std::find(own.near.begin(), own.near.end(), object) != own.near.end();
    };
    std::erase_if(found, noted);
    std::sort(found.begin(), found.end(), [](const btCollisionObject* a, const btCollisionObject* b) {
      return a->getBroadphaseHandle()->m_uniqueId < b->getBroadphaseHandle()->m_uniqueId;
    });
    own.near.insert(own.near.end(), found.begin(), found.end());
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
