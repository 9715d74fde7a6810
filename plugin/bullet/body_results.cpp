// What Bullet's bodies have of a tick once it has moved them: late impulses, places, and what holds them when
// they are at rest.
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <LinearMath/btQuickprof.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bullet/convert.h"
#include "bullet/multibody_links.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

// A body is held by Bullet when that bears more than this share of its weight.
constexpr double kHeldShare = 0.05;
// Share of the newest tick in the reaction that the substeps count on; at 1/2 a heavy slab on a light crate
// keeps jumping from tick to tick.
constexpr btScalar kTrust = btScalar(0.25);

btVector3 atMost(const btVector3& reaction, const btVector3& load) {
  const btScalar size = reaction.length(), most = load.length();
  return size > most ? reaction * (most / size) : reaction;
}

}  // namespace

// Actions of the application that come first in a tick may have taken bodies out of the world.
void Destruction::Impl::forgetTaken() {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (bullet::TouchedBody& t : touched)
    if (t.rigid && objects.findLinearSearch(t.object) == objects.size()) t.rigid = nullptr;
  for (bullet::TouchedBody& t : touched)
    if (t.link && objects.findLinearSearch(t.object) == objects.size()) t.link = nullptr;
}

// Impulses that no solver iteration took (MLCP, multi-threaded and sleeping islands).
void Destruction::Impl::lateImpulses() {
  BT_PROFILE("Rubble late impulses");
  for (bullet::TouchedBody& t : touched) {
    if (!t.rigid || t.given) continue;
    t.rigid->setLinearVelocity(t.rigid->getLinearVelocity() + t.deltaVelocity);
    t.rigid->setAngularVelocity(t.rigid->getAngularVelocity() + t.deltaSpin);
    t.rigid->translate(t.deltaVelocity * btScalar(world.getSolverInfo().m_timeStep));
  }
}

// A body that hit within the tick has moved as if its impulse had acted all along: put it where the substeps
// had it.
void Destruction::Impl::fixPositions() {
  BT_PROFILE("Rubble fix positions");
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    bullet::TouchedBody& t = touched[p];
    if ((!t.rigid && !t.link) || !proxies[p].isPressed() || isHeld(*t.object)) continue;
    if (t.link) {
      if (!proxies[p].coupled.empty()) continue;  // each moves the others, too
      const btQuaternion turn = toBullet(proxies[p].orientation) * t.freeEnd.getRotation().inverse();
      bullet::LinkMotion way;
      way << proxies[p].position - toEigen(t.freeEnd.getOrigin()),
          toEigen(turn.getAxis()) * std::remainder(double(turn.getAngle()), 2 * std::numbers::pi);
      bullet::shift(*t.link, way);
      continue;
    }
    btTransform at = t.rigid->getWorldTransform();
    at.setOrigin(at.getOrigin() + toBullet(proxies[p].position) - t.freeEnd.getOrigin());
    at.setRotation((toBullet(proxies[p].orientation) * t.freeEnd.getRotation().inverse() * at.getRotation())
                       .normalized());
    t.rigid->setWorldTransform(at);
    t.rigid->setInterpolationWorldTransform(at);
  }
}

void Destruction::Impl::noteLeftPlaces() {
  leftPlaces.clear();
  for (const bullet::TouchedBody& t : touched)
    if (t.rigid) leftPlaces.push_back({t.object, t.rigid->getWorldTransform()});
}

bool Destruction::Impl::wasPlaced(const btCollisionObject& body) const {
  return std::any_of(leftPlaces.begin(), leftPlaces.end(), [&](const bullet::LeftPlace& left) {
    return left.body == &body && !(left.at == body.getWorldTransform());
  });
}

// Whether Bullet's own contacts and joints bear a body at rest: those know where it belongs. Where nothing
// has weight nothing is borne: what is slow there turns back on the elements.
bool Destruction::Impl::isHeld(const btCollisionObject& body) const {
  const btScalar least = btScalar(kHeldShare) * world.getGravity().length();
  if (!(least > 0)) return false;
  return std::any_of(reactions.begin(), reactions.end(), [&](const bullet::Reaction& r) {
    return r.body == &body && r.rests && r.linear.length() > least;
  });
}

// A body that was at rest before and after this tick is held by something that only Bullet knows: the
// substeps of the next tick count on a share kTrust of it and the rest of what they counted on before, so
// that it settles.
void Destruction::Impl::noteReactions(double dt) {
  BT_PROFILE("Rubble note reactions");
  const std::vector<bullet::Reaction> before = std::exchange(reactions, {});
  const btScalar quiet = std::max(btScalar(kQuietSpeed), btScalar(0.5 * dt) * world.getGravity().length());
  const btScalar rate = btScalar(1 / dt);
  for (std::size_t p = 0; p < touched.size(); ++p) {
    const bullet::TouchedBody& t = touched[p];
    const bool ridden = t.rigid && proxies[p].pulled;
    if ((!t.rigid && !t.link) || (t.velocity.length() > quiet && !ridden)) continue;
    btVector3 velocity, spin;
    if (t.link) {
      const bullet::LinkMotion motion = bullet::motionOf(*t.link);
      velocity = toBullet(Eigen::Vector3d(motion.head<3>()));
      spin = toBullet(Eigen::Vector3d(motion.tail<3>()));
    } else {
      velocity = t.rigid->getLinearVelocity();
      spin = t.rigid->getAngularVelocity();
    }
    const bool rests = t.velocity.length() <= quiet && velocity.length() <= quiet;
    if (!rests && !ridden) continue;
    // Supports are Bullet's, too.
    const btVector3 byElements = t.deltaVelocity - t.supported,
                    spinByElements = t.deltaSpin - t.supportedSpin;
    bullet::Reaction now;
    now.body = t.object;
    now.rests = rests;
    now.linear = rate * (velocity - t.velocity - byElements) - t.acceleration;
    now.angular = rate * (spin - t.spin - spinByElements) - t.angularAcceleration;
    now.supported = rate * t.supported;
    now.supportedAngular = rate * t.supportedSpin;
    if (!rests) {  // no more than bears it: a blow is over in the next tick
      now.linear = atMost(now.linear, t.acceleration + rate * byElements);
      now.angular = atMost(now.angular, t.angularAcceleration + rate * spinByElements);
    }
    for (const bullet::Reaction& last : before) {
      if (last.body != now.body) continue;
      const auto settle = [](const btVector3& from, btVector3& to) { to = from + kTrust * (to - from); };
      settle(last.linear, now.linear);
      settle(last.angular, now.angular);
      settle(last.supported, now.supported);
      settle(last.supportedAngular, now.supportedAngular);
    }
    reactions.push_back(now);
  }
}

RUBBLE_ABI_END
}  // namespace rubble
