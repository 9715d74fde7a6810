#include "bullet/anchor_body.h"

#include <algorithm>
#include <cmath>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

// Ticks of one stepSimulation over which a way is spread at most; what is further was put there.
constexpr double kMostTicks = 64;

Eigen::Isometry3d isometryOf(const edem::Frame& frame) {
  return Eigen::Translation3d(frame.origin) * frame.turn;
}

bool isFinite(const btRigidBody& body) {
  return toEigen(body.getWorldTransform()).matrix().allFinite();
}

// In how many ticks it comes to where the application has put it.
double ticksTo(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, const btRigidBody& body,
               double dt) {
  const double turn = Eigen::AngleAxisd(to.linear() * from.linear().transpose()).angle();
  const double way = (to.translation() - from.translation()).norm() + turn;
  const double aTick = dt * double(body.getLinearVelocity().length() + body.getAngularVelocity().length());
  const double ticks = std::round(way / aTick);
  return ticks >= 1 && ticks <= kMostTicks ? ticks : 1;
}

}  // namespace

void requireAnchorBody(btDiscreteDynamicsWorld& world, btRigidBody& body) {
  const btCollisionObjectArray& all = world.getCollisionObjectArray();
  if (all.findLinearSearch(&body) == all.size())
    throw Error("anchorBody: is not in the world; add it before what is anchored to it");
  if (DestructibleBody::upcast(&body))
    throw Error("anchorBody: is a destructible body; anchors hold to others");
  if (!body.isStaticOrKinematicObject())
    throw Error(
        "anchorBody: is dynamic; anchors hold to kinematic and static bodies, for what they hold would not "
        "push "
        "it. Tie a free destructible body to it with a joint of Bullet's");
  if (!isFinite(body)) throw Error("anchorBody: its place is not finite");
}

AnchorBody anchorTo(btRigidBody& body, const edem::Frame& frame) {
  AnchorBody anchor;
  anchor.body = &body;
  anchor.number = body.getBroadphaseHandle()->m_uniqueId;
  anchor.at = toEigen(body.getWorldTransform());
  holdAnew(anchor, frame);
  return anchor;
}

bool isThere(const btDiscreteDynamicsWorld& world, const AnchorBody& anchor) {
  const btCollisionObjectArray& all = world.getCollisionObjectArray();
  btCollisionObject* object = anchor.body;
  return all.findLinearSearch(object) < all.size() &&
         anchor.body->getBroadphaseHandle()->m_uniqueId == anchor.number;
}

edem::Twist motionAt(const btRigidBody& body, const Eigen::Vector3d& point) {
  if (!body.isKinematicObject()) return {};
  const Eigen::Vector3d arm = point - toEigen(body.getWorldTransform().getOrigin()),
                        spin = toEigen(body.getAngularVelocity());
  return {toEigen(body.getLinearVelocity()) + spin.cross(arm), spin};
}

edem::Frame follow(AnchorBody& anchor, double dt) {
  if (isFinite(*anchor.body)) {
    const Eigen::Isometry3d to = toEigen(anchor.body->getWorldTransform());
    const double ticks = ticksTo(anchor.at, to, *anchor.body, dt);
    if (ticks > 1) {
      const Eigen::Quaterniond from(anchor.at.linear());
      const Eigen::Vector3d way = (to.translation() - anchor.at.translation()) / ticks;
      anchor.at.linear() =
          from.slerp(1 / ticks, Eigen::Quaterniond(to.linear())).normalized().toRotationMatrix();
      anchor.at.translation() += way;
    } else {
      anchor.at = to;
    }
  }
  const Eigen::Isometry3d frame = anchor.at * anchor.hold;
  return {frame.translation(), Eigen::Quaterniond(frame.linear()).normalized()};
}

void holdAnew(AnchorBody& anchor, const edem::Frame& frame) {
  anchor.hold = anchor.at.inverse(Eigen::Isometry) * isometryOf(frame);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet

namespace rubble {
RUBBLE_ABI_BEGIN

void Destruction::Impl::setAnchorBody(DestructibleBody& body, btRigidBody* base, const edem::Twist& motion) {
  DestructibleBody::Impl& own = body.impl();
  own.anchorBody = {};
  if (base) own.anchorBody = bullet::anchorTo(*base, solver->heldFrame(own.id));
  solver->setBase(own.id, motion);
}

void Destruction::Impl::carryAnchored(double dt) {
  for (DestructibleBody* body : bodies) {
    DestructibleBody::Impl& own = body->impl();
    bullet::AnchorBody& anchor = own.anchorBody;
    if (!anchor.body) continue;
    if (!bullet::isThere(world, anchor)) {
      anchor.body = nullptr;
      if (def.log)
        def.log(LogLevel::Info, own.name +
                                    ": the body that its anchors hold to has left the world: they hold "
                                    "where they are");
      continue;
    }
    if (solver->carry(own.id, bullet::follow(anchor, dt))) body->activate(true);
  }
}

// What anchors hold stands or hangs on that body by them.
void Destruction::Impl::bearAnchored() {
  for (const DestructibleBody* body : bodies)
    for (std::size_t p = 0; body->impl().anchorBody.body && p < proxies.size(); ++p)
      if (body->impl().anchorBody.is(*touched[p].object)) proxies[p].bears.push_back(body->id());
}

RUBBLE_ABI_END
}  // namespace rubble
