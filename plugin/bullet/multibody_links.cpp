#include "bullet/multibody_links.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "bullet/convert.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

/// Bullet's coordinates of a multibody: (spin, velocity) of the base, then the joints.
struct LinkScratch {
  explicit LinkScratch(const btMultiBody& multibody) { row.resize(6 + multibody.getNumDofs(), 0); }
  btAlignedObjectArray<btScalar> row, moved, r;
  btAlignedObjectArray<btVector3> v;
  btAlignedObjectArray<btMatrix3x3> m;
};

btVector3 centreOf(const btMultiBody& multibody, int link) {
  const btCollisionObject* collider =
      link < 0 ? multibody.getBaseCollider() : multibody.getLink(link).m_collider;
  if (collider) return collider->getWorldTransform().getOrigin();
  if (link < 0) return multibody.getBasePos();
  return multibody.getLink(link).m_cachedWorldTransform.getOrigin();
}

// What the coordinates feel of a force and a torque on a link; as a row, what of its motion is along them.
void fillRow(const btMultiBody& multibody, int link, const btVector3& force, const btVector3& torque,
             LinkScratch& scratch) {
  multibody.fillConstraintJacobianMultiDof(link, centreOf(multibody, link), torque, force, &scratch.row[0],
                                           scratch.r, scratch.v, scratch.m);
}

void fillUnit(const btMultiBody& multibody, int link, int axis, LinkScratch& scratch) {
  btVector3 force(0, 0, 0), torque(0, 0, 0);
  (axis < 3 ? force : torque)[axis % 3] = 1;
  fillRow(multibody, link, force, torque, scratch);
}

// What `scratch.row`, as forces, gives the coordinates.
void respond(const btMultiBody& multibody, LinkScratch& scratch) {
  scratch.moved.resize(scratch.row.size(), 0);
  multibody.calcAccelerationDeltasMultiDof(&scratch.row[0], &scratch.moved[0], scratch.r, scratch.v);
}

double along(const LinkScratch& scratch, const btScalar* coordinates) {
  double sum = 0;
  for (int c = 0; c < scratch.row.size(); ++c) sum += double(scratch.row[c]) * double(coordinates[c]);
  return sum;
}

LinkMotion motionBy(const btMultiBody& multibody, int link, const btScalar* coordinates,
                    LinkScratch& scratch) {
  LinkMotion motion;
  for (int axis = 0; axis < 6; ++axis) {
    fillUnit(multibody, link, axis, scratch);
    motion[axis] = along(scratch, coordinates);
  }
  return motion;
}

void addForces(const btMultiBody& multibody, LinkScratch& scratch, btAlignedObjectArray<btScalar>& forces) {
  const auto add = [&](int link, const btVector3& force, const btVector3& torque) {
    fillRow(multibody, link, force, torque, scratch);
    for (int c = 0; c < forces.size(); ++c) forces[c] += scratch.row[c];
  };
  add(-1, multibody.getBaseForce(), multibody.getBaseTorque());
  for (int link = 0; link < multibody.getNumLinks(); ++link) {
    add(link, multibody.getLinkForce(link), multibody.getLinkTorque(link));
    const btMultibodyLink& joint = multibody.getLink(link);
    for (int dof = 0; dof < joint.m_dofCount; ++dof)
      forces[6 + joint.m_dofOffset + dof] += joint.m_jointTorque[dof];
  }
}

}  // namespace

bool isMoved(const btMultiBodyLinkCollider& link) {
  const btMultiBody& multibody = *link.m_multiBody;
  if (link.m_link < 0) return !multibody.isBaseStaticOrKinematic() && multibody.getBaseMass() > 0;
  return !multibody.isLinkAndAllAncestorsStaticOrKinematic(link.m_link);
}

LinkMotion motionOf(const btMultiBodyLinkCollider& link) {
  LinkScratch scratch(*link.m_multiBody);
  return motionBy(*link.m_multiBody, link.m_link, link.m_multiBody->getVelocityVector(), scratch);
}

LinkMobility mobilityOf(const btMultiBodyLinkCollider& link) {
  const LinkMobility mobility = mobilityOf(link, link);
  return 0.5 * (mobility + mobility.transpose());
}

LinkMobility mobilityOf(const btMultiBodyLinkCollider& pushed, const btMultiBodyLinkCollider& moved) {
  const btMultiBody& multibody = *pushed.m_multiBody;
  LinkScratch scratch(multibody);
  LinkMobility mobility;
  for (int axis = 0; axis < 6; ++axis) {
    fillUnit(multibody, pushed.m_link, axis, scratch);
    respond(multibody, scratch);
    mobility.col(axis) = motionBy(multibody, moved.m_link, &scratch.moved[0], scratch);
  }
  return mobility;
}

LinkMotion accelerationOf(const btMultiBodyLinkCollider& link) {
  const btMultiBody& multibody = *link.m_multiBody;
  if (!link.isActive()) return LinkMotion::Zero();
  LinkScratch scratch(multibody);
  btAlignedObjectArray<btScalar> forces;
  forces.resize(scratch.row.size(), 0);
  addForces(multibody, scratch, forces);
  scratch.row = forces;
  respond(multibody, scratch);
  return motionBy(multibody, link.m_link, &scratch.moved[0], scratch);
}

void take(const btMultiBodyLinkCollider& link, double dt, edem::RigidProxy& proxy) {
  if (!isMoved(link)) return;
  const LinkMobility mobility = mobilityOf(link);
  const LinkMotion gained = accelerationOf(link);
  const auto largest = [](const Eigen::Matrix3d& share) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(share, Eigen::EigenvaluesOnly).eigenvalues()[2];
  };
  if (!mobility.allFinite() || !gained.allFinite()) return proxy.parts.clear();
  const double moves = largest(mobility.topLeftCorner<3, 3>());
  if (!(moves > 0)) return;  // its joints hold it
  proxy.kinematic = false;
  proxy.inverseMass = moves;
  proxy.inverseInertia.setConstant(largest(mobility.bottomRightCorner<3, 3>()));
  proxy.mobility = mobility;
  proxy.acceleration = gained.head<3>();
  proxy.angularAcceleration = gained.tail<3>();
  proxy.velocity -= dt * proxy.acceleration;
  proxy.spin -= dt * proxy.angularAcceleration;
}

void push(btMultiBodyLinkCollider& link, const Eigen::Vector3d& impulse, const Eigen::Vector3d& rotation) {
  btMultiBody& multibody = *link.m_multiBody;
  LinkScratch scratch(multibody);
  fillRow(multibody, link.m_link, toBullet(impulse), toBullet(rotation), scratch);
  respond(multibody, scratch);
  multibody.applyDeltaVeeMultiDof(&scratch.moved[0], 1);
  if (link.isActive()) return;
  multibody.wakeUp();
  link.activate(true);
}

void shift(btMultiBodyLinkCollider& link, const LinkMotion& way) {
  btMultiBody& multibody = *link.m_multiBody;
  const LinkMotion by = mobilityOf(link).completeOrthogonalDecomposition().solve(way);
  LinkScratch scratch(multibody);
  fillRow(multibody, link.m_link, toBullet(Eigen::Vector3d(by.head<3>())),
          toBullet(Eigen::Vector3d(by.tail<3>())), scratch);
  respond(multibody, scratch);
  multibody.stepPositionsMultiDof(1, nullptr, &scratch.moved[0]);
  btAlignedObjectArray<btQuaternion> turns;
  btAlignedObjectArray<btVector3> origins;
  multibody.updateCollisionObjectWorldTransforms(turns, origins);
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
