// Bullet's bodies beside the elements: who of them is near, as copies for the substeps, and what these gave
// them.
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <LinearMath/btQuickprof.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/locked_motion.h"
#include "bullet/multibody_links.h"
#include "bullet/swept_bodies.h"
#include "bullet/world_tick.h"

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

// A rigid body that Bullet holds is a rock to elements slower than this [m/s].
constexpr double kCalmSpeed = 0.1;
// Roundings of Bullet's numbers from one tick to the next, over their largest: its own step, ours, and the
// sum of both.
constexpr double kRoundings = 4;

// Where impulses taken as one at the tick's start give a body so many times the energy of rotation that it
// had after the substeps, it turned too far in them for that.
constexpr double kTurned = 1.05;

// Of a body of unlike inertias, turned as it is after the substeps [J].
double rotationOf(const edem::RigidProxy& proxy, const Eigen::Vector3d& spin) {
  const Eigen::Vector3d own = proxy.orientation.conjugate() * spin;
  double twice = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (proxy.inverseInertia[axis] > 0) twice += own[axis] * own[axis] / proxy.inverseInertia[axis];
  return 0.5 * twice;
}

// What has one inertia about all axes gets the same by its impulses whenever they come.
bool isUneven(const edem::RigidProxy& proxy) {
  return proxy.inverseInertia.maxCoeff() > 1.01 * proxy.inverseInertia.minCoeff();
}

float roundingOf(const edem::RigidProxy& proxy) {
  constexpr double kEpsilon = std::numeric_limits<btScalar>::epsilon();
  return float(kRoundings * kEpsilon * proxy.position.cwiseAbs().maxCoeff());
}

}  // namespace

void Destruction::Impl::gatherProxies(double dt) {
  BT_PROFILE("Rubble gather proxies");
  bullet::addSwept(world, bodies, dt);
  const std::vector<Eigen::AlignedBox3d> boxes = bullet::reachedBoxes(bodies, dt);
  touched.clear();
  proxies.clear();
  for (DestructibleBody* body : elementBodies) {
    bullet::AnchorBody& base = implOf(*body).anchorBody;
    std::vector<btCollisionObject*>& near = implOf(*body).near;
    const bool rides = base.body && base.ridden && body->isActive();
    if (rides && std::find(near.begin(), near.end(), base.body) == near.end()) near.push_back(base.body);
    for (btCollisionObject* object : near)
      if (!upcastElements(object) && !isTouched(*object))
        addProxy(*object, body, rides && base.is(*object), dt, boxes);
    near.clear();
  }
  gatherSupports(dt, boxes);
  coupleLinks();
  spareFiltered();
  bearAnchored();
}

bool Destruction::Impl::isTouched(const btCollisionObject& object) const {
  return std::ranges::any_of(touched, [&](const bullet::TouchedBody& t) { return t.object == &object; });
}

// `beside`: a body that it is near, or null. Without a shape that touches it comes along only where it
// `bears`.
void Destruction::Impl::addProxy(btCollisionObject& object, const DestructibleBody* beside, bool bears,
                                 double dt, std::span<const Eigen::AlignedBox3d> boxes) {
  edem::RigidProxy proxy = proxyMaker.make(object, boxes);
  auto* link = btMultiBodyLinkCollider::upcast(&object);
  if (link) bullet::take(*link, dt, proxy);
  if (proxy.parts.empty() && !bears) return;
  bullet::TouchedBody t;
  t.object = &object;
  if (proxy.isDynamic()) {
    t.rigid = btRigidBody::upcast(&object);
    proxy.placed = t.rigid && wasPlaced(object);
    if (t.rigid) proxy.rounding = roundingOf(proxy);
    t.link = link;
    t.velocity = toBullet(proxy.velocity);
    t.spin = toBullet(proxy.spin);
    t.acceleration = toBullet(proxy.acceleration);
    t.angularAcceleration = toBullet(proxy.angularAcceleration);
    // Without it a crate that stands on the ground would fall through every tick's substeps and be put
    // back. Under what lies on it calmly it stands like a rock, for Bullet holds it again after the tick.
    for (const bullet::Reaction& held : reactions) {
      if (held.body != &object) continue;
      proxy.acceleration += toEigen(held.linear - held.supported);
      proxy.angularAcceleration += toEigen(held.angular - held.supportedAngular);
    }
    // What is light has supports: as a rock it would get in one tick what presses it in a blow.
    const bool mayBeRock =
        beside && !(proxy.inverseMass * std::ranges::min(solver->view(beside->id()).mass) > 1);
    if (mayBeRock && isHeld(object) && speedOn(object, *beside) < kCalmSpeed) {
      t.held = true;
      proxy.inverseMass = 0;
      proxy.mobility.reset();
      proxy.kinematic = true;
      proxy.velocity.setZero();
      proxy.spin.setZero();
    }
  }
  touched.push_back(t);
  proxies.push_back(std::move(proxy));
}

// The copies of all bodies' neighbours are one list: what one body touches another may have to let through.
void Destruction::Impl::spareFiltered() {
  if (bodies.size() < 2) return;
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    btCollisionObject& object = *touched[p].object;
    if (!object.getBroadphaseHandle()) continue;  // gone from the world since the narrowphase
    for (DestructibleBody* body : elementBodies)
      if (body->isActive() && !bullet::mayTouch(world, *body, object))
        proxies[p].spared.push_back(body->id());
  }
}

// Links of one multibody move each other within the tick.
void Destruction::Impl::coupleLinks() {
  for (std::size_t p = 0; p < proxies.size(); ++p)
    for (std::size_t q = 0; q < proxies.size(); ++q) {
      if (p == q || !touched[p].link || !touched[q].link) continue;
      if (!proxies[p].mobility || !proxies[q].mobility) continue;
      if (touched[p].link->m_multiBody != touched[q].link->m_multiBody) continue;
      proxies[p].coupled.push_back(
          {std::uint32_t(q), bullet::mobilityOf(*touched[p].link, *touched[q].link)});
    }
}

void Destruction::Impl::giveBodies(double dt, std::span<const edem::RigidProxy> start) {
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    bullet::TouchedBody& t = touched[p];
    if (!t.rigid) continue;
    const edem::RigidProxy& s = start[p];
    Eigen::Vector3d change = double(t.rigid->getInvMass()) * proxies[p].impulse;
    t.deltaSpin = t.rigid->getInvInertiaTensorWorld() * toBullet(proxies[p].angularImpulse);
    if (const auto locked = bullet::lockedMobility(*t.rigid)) {
      change = locked->topLeftCorner<3, 3>() * proxies[p].impulse;
      t.deltaSpin = toBullet(Eigen::Vector3d(locked->bottomRightCorner<3, 3>() * proxies[p].angularImpulse));
    }
    // What Bullet's contacts did in the substeps is theirs: Bullet finds it done.
    t.supported = toBullet(Eigen::Vector3d(double(t.rigid->getInvMass()) * proxies[p].supportImpulse));
    t.supportedSpin = t.rigid->getInvInertiaTensorWorld() * toBullet(proxies[p].supportAngularImpulse);
    change += toEigen(t.supported);
    t.deltaSpin += t.supportedSpin;
    t.deltaVelocity = toBullet(change);
    const Eigen::Vector3d turning = s.spin + dt * s.angularAcceleration, own = proxies[p].spin;
    if (!s.mobility && proxies[p].isPressed() && isUneven(s) &&
        rotationOf(proxies[p], turning + toEigen(t.deltaSpin)) > kTurned * rotationOf(proxies[p], own))
      t.deltaSpin = toBullet(Eigen::Vector3d(own - turning));
    // Where Bullet brings it under the same impulses, taken as one at the tick's start.
    const btTransform begin(toBullet(s.orientation), toBullet(s.position));
    btTransformUtil::integrateTransform(
        begin, toBullet(Eigen::Vector3d(s.velocity + dt * s.acceleration + change)),
        toBullet(Eigen::Vector3d(s.spin + dt * s.angularAcceleration)) + t.deltaSpin, btScalar(dt),
        t.freeEnd);
    const bool isPushed = proxies[p].isPressed() || !proxies[p].supportImpulse.isZero(0);
    if (isPushed && !t.rigid->isActive()) t.rigid->activate();
  }
}

// Links have theirs at once: Bullet makes its rows for multibodies when all constraints have been set up,
// from the velocities of then.
void Destruction::Impl::giveLinks(double dt, std::span<const edem::RigidProxy> start) {
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    if (!touched[p].link || !(proxies[p].contactWeight > 0)) continue;
    bullet::LinkMotion impulse;
    impulse << proxies[p].impulse, proxies[p].angularImpulse;
    const auto change = [&](bullet::TouchedBody& t, const bullet::LinkMobility& mobility) {
      const bullet::LinkMotion by = mobility * impulse;
      t.deltaVelocity += toBullet(Eigen::Vector3d(by.head<3>()));
      t.deltaSpin += toBullet(Eigen::Vector3d(by.tail<3>()));
    };
    change(touched[p], bullet::mobilityOf(*touched[p].link));
    for (const edem::RigidProxy::Coupling& other : proxies[p].coupled)
      change(touched[other.proxy], other.mobility);
  }
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    bullet::TouchedBody& t = touched[p];
    if (!t.link || !(proxies[p].contactWeight > 0)) continue;
    const edem::RigidProxy& s = start[p];
    const btTransform begin(toBullet(s.orientation), toBullet(s.position));
    btTransformUtil::integrateTransform(
        begin, toBullet(Eigen::Vector3d(s.velocity + dt * s.acceleration)) + t.deltaVelocity,
        toBullet(Eigen::Vector3d(s.spin + dt * s.angularAcceleration)) + t.deltaSpin, btScalar(dt),
        t.freeEnd);
    bullet::push(*t.link, proxies[p].impulse, proxies[p].angularImpulse);
  }
}

RUBBLE_ABI_END
}  // namespace rubble
