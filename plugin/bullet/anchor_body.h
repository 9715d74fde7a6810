// The Bullet body that the anchors of a destructible body hold to.
#pragma once

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "edem/anchor_base.h"
#include "rubble/abi.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

struct AnchorBody {
  btRigidBody* body =
      nullptr;     ///< null: none, or it has left the world; it may be dead while `number` differs
  int number = 0;  ///< its own in the broadphase, which never comes back
  Eigen::Isometry3d at = Eigen::Isometry3d::Identity();    ///< where the anchors have it
  Eigen::Isometry3d hold = Eigen::Isometry3d::Identity();  ///< their frame, from there

  bool is(const btCollisionObject& object) const { return body == &object; }
};

/// Refuses a body that anchors cannot hold to: throws rubble::Error that says why.
void requireAnchorBody(btDiscreteDynamicsWorld& world, btRigidBody& body);
/// Ties a frame to where `body` is now.
AnchorBody anchorTo(btRigidBody& body, const edem::Frame& frame);
/// Whether it still is in the world. What is not there is not looked at.
bool isThere(const btDiscreteDynamicsWorld& world, const AnchorBody& anchor);
/// Velocity of a point that goes with a body, and its spin.
edem::Twist motionAt(const btRigidBody& body, const Eigen::Vector3d& point);
/// Where the frame will be at the end of a tick of `dt` seconds. The application has put a kinematic body
/// where it will be after all ticks of one stepSimulation.
edem::Frame follow(AnchorBody& anchor, double dt);
/// The frame has been put elsewhere, and goes on from there with the body.
void holdAnew(AnchorBody& anchor, const edem::Frame& frame);

RUBBLE_ABI_END
}  // namespace rubble::bullet
