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
  bool ridden = false;  ///< they rode on it in the last tick, dynamic as it was

  bool is(const btCollisionObject& object) const { return body == &object; }
};

/// Refuses a body that anchors of `mass` [kg] cannot hold to: throws rubble::Error that says why.
void requireAnchorBody(btDiscreteDynamicsWorld& world, btRigidBody& body, double mass);
/// Whether Bullet moves it now, so that anchors ride on its copy in the substeps.
bool isRidden(const btRigidBody& body);
/// Whether its place and motion are finite numbers.
bool isFinite(const btRigidBody& body);
/// Ties a frame to where `body` is now.
AnchorBody anchorTo(btRigidBody& body, const edem::Frame& frame);
/// Whether it still is in the world. What is not there is not looked at.
bool isThere(const btDiscreteDynamicsWorld& world, const AnchorBody& anchor);
/// Velocity of a point that goes with a body, and its spin.
edem::Twist motionAt(const btRigidBody& body, const Eigen::Vector3d& point);
/// Where the frame will be at the end of a tick of `dt` seconds. The application has put a kinematic body
/// where it will be after all ticks of one stepSimulation.
edem::Frame follow(AnchorBody& anchor, double dt);
/// Where the frame is beside a body that is ridden on.
edem::Frame frameOn(AnchorBody& anchor);
edem::Frame holdOf(const AnchorBody& anchor);
/// Lets a body and what its anchors hold it to, which ride on it, sleep and wake together: after Bullet has
/// decided on islands, and before it counts the time that each has been still.
void wakeTogether(btRigidBody& body, btRigidBody& base);
void waitTogether(btRigidBody& body, btRigidBody& base);
inline Eigen::Isometry3d isometryOf(const edem::Frame& frame) {
  return Eigen::Translation3d(frame.origin) * frame.turn;
}
/// The frame has been put elsewhere, and goes on from there with the body.
void holdAnew(AnchorBody& anchor, const edem::Frame& frame);

RUBBLE_ABI_END
}  // namespace rubble::bullet
