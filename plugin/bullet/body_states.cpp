#include "bullet/body_states.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

constexpr int kGyroscopic = BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                            BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;

// Bullet's gyroscopic term takes the product of the three inertias. Of a concrete cube from 110 m on that is
// more than a float holds, and the term is 0; from 2.2 km on it is not a number.
bool hasGyroscopicTerm(const btVector3& inertia) {
  return std::isfinite(inertia.x() * inertia.y() * inertia.z());
}

}  // namespace

void showInBullet(DestructibleBody& body, const btTransform& at, const btVector3& velocity,
                  const btVector3& spin) {
  body.setWorldTransform(at);
  body.setInterpolationWorldTransform(at);
  body.setLinearVelocity(velocity);
  body.setAngularVelocity(spin);
  body.setInterpolationLinearVelocity(velocity);
  body.setInterpolationAngularVelocity(spin);
}

void beElements(DestructibleBody& body) {
  ElementShape& shape = *implOf(body).shape;
  btVector3 inertia;
  shape.calculateLocalInertia(btScalar(implOf(body).whole.mass), inertia);
  body.setCollisionShape(&shape);
  body.setMassProps(btScalar(implOf(body).whole.mass), inertia);
  const btVector3 none(0, 0, 0);
  showInBullet(body, body.getWorldTransform(), none, none);
  body.clearForces();
  body.setGravity(implOf(body).settings.gravity);
  // Of what the application does to it; the elements take that from there.
  body.setLinearFactor(implOf(body).settings.linearFactor);
  body.setAngularFactor(implOf(body).settings.angularFactor);
  implOf(body).fixed = implOf(body).held;
  body.updateInertiaTensor();
  // Bullet's solver makes no contact rows against this body; its manifolds are ours.
  body.setContactProcessingThreshold(-BT_LARGE_FLOAT);
  body.setFlags((body.getFlags() & ~kGyroscopic) | BT_DISABLE_WORLD_GRAVITY);
  body.forceActivationState(DISABLE_DEACTIVATION);
}

void beRigid(DestructibleBody& body, const btTransform& at) {
  const WholeShape& whole = implOf(body).whole;
  body.setCollisionShape(whole.shape.get());
  body.setMassProps(btScalar(whole.mass), whole.inertia);
  body.setWorldTransform(at);
  body.setInterpolationWorldTransform(at);
  body.updateInertiaTensor();
}

void beNewRigid(DestructibleBody& body, const btTransform& at) {
  beRigid(body, at);
  body.setFriction(btScalar(std::max(0.0, body.material().friction)));
  body.setRestitution(btScalar(body.material().restitution));
  if (!hasGyroscopicTerm(implOf(body).whole.inertia)) body.setFlags(body.getFlags() & ~kGyroscopic);
  if (!implOf(body).held) return;
  body.setLinearFactor({0, 0, 0});
  body.setAngularFactor({0, 0, 0});
  body.setFlags(body.getFlags() | BT_DISABLE_WORLD_GRAVITY);
  body.setGravity(noGravity());
}

void limitGyroscopicTerm(DestructibleBody& body, double dt) {
  constexpr btScalar kTurn = SIMD_PI;
  int& taken = implOf(body).gyroscopicFlags;
  const bool isFast = body.getAngularVelocity().length2() * btScalar(dt * dt) > kTurn * kTurn;
  if (isFast && (body.getFlags() & kGyroscopic) != 0) {
    taken = body.getFlags() & kGyroscopic;
    body.setFlags(body.getFlags() & ~kGyroscopic);
  } else if (!isFast && taken != 0) {
    body.setFlags(body.getFlags() | std::exchange(taken, 0));
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
