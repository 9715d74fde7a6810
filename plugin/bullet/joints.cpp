// A joint's impulse comes out of Bullet's solver after the substeps of its tick. The fragment has it at once,
// as one rigid body, so that both sides agree when the tick is over. The next tick begins with the guess that
// the joint does the same again: it acts as a force all through the substeps, and what that gives is left out
// of what Bullet sees. So a body hung on a joint neither falls nor is thrown back within a tick. What the
// joint does for long presses the elements about the place, the rest all of the fragment alike: a joint that
// follows the waves that it makes would drive them.
#include "bullet/joints.h"

#include <LinearMath/btQuickprof.h>
#include <LinearMath/btTransformUtil.h>

#include <cmath>

#include "bullet/body_impl.h"
#include "bullet/convert.h"
#include "bullet/joint_frames.h"
#include "bullet/world_tick.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

void spread(const edem::Solver& solver, std::uint32_t body, const std::vector<std::uint32_t>& elements,
            const Eigen::Vector3d& at, const JointImpulse& wrench, double seconds,
            std::vector<edem::HostLoad>& loads) {
  const edem::BodyView view = solver.view(body);
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : elements) {
    mass += view.mass[i];
    centre += view.mass[i] * solver.position(body, i);
  }
  if (!(mass > 0)) return;
  centre /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : elements) {
    const Eigen::Vector3d arm = solver.position(body, i) - centre;
    inertia += (view.mass[i] * arm.squaredNorm() + view.inertia[i]) * Eigen::Matrix3d::Identity() -
               view.mass[i] * arm * arm.transpose();
  }
  const Eigen::Vector3d linear = wrench.linear / (mass * seconds),
                        angular = inertia.ldlt().solve(wrench.about(at - centre)) / seconds;
  for (const std::uint32_t i : elements) {
    const Eigen::Vector3d arm = solver.position(body, i) - centre;
    loads.push_back({i, view.mass[i] * (linear + angular.cross(arm)), view.inertia[i] * angular});
  }
}

RUBBLE_ABI_END
}  // namespace rubble::bullet

namespace rubble {
RUBBLE_ABI_BEGIN
namespace {

using bullet::toBullet;
using bullet::toEigen;

// Elements bear a joint up to this far beyond the nearest [radii]: on one alone it would break out.
constexpr double kBearingRadii = 2.5;
// For how long a joint has to do something to be borne by those [s]; as the loads of whole bodies.
constexpr double kSmoothing = 0.1;
// Share of what gravity does in a tick from which a joint wakes a fragment that sleeps.
constexpr double kWakingShare = 0.05;
// By which the mass of a fragment may differ from what Bullet has last seen.
constexpr double kSameMass = 0.01;

std::vector<std::uint32_t> fragmentOf(const edem::Solver& solver, std::uint32_t body, std::uint32_t element) {
  const edem::BodyView view = solver.view(body);
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < view.alive.size(); ++i)
    if (view.alive[i] && view.fragment[i] == view.fragment[element]) out.push_back(i);
  return out;
}

// By where they are at rest, so that the same elements bear a joint from tick to tick.
std::vector<std::uint32_t> bearing(const edem::Solver& solver, const DestructibleBody& body,
                                   std::uint32_t element, const Eigen::Vector3d& pivot) {
  const edem::BodyView view = solver.view(body.id());
  const std::vector<Eigen::Vector3d>& rest = body.asset()->positions;
  const Eigen::Vector3d at = implOf(body).shown.frame * pivot;
  const double reach = (rest[element] - at).norm() + kBearingRadii * solver.radius(body.id());
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < view.alive.size(); ++i)
    if (view.alive[i] && view.fragment[i] == view.fragment[element] && (rest[i] - at).norm() < reach)
      out.push_back(i);
  return out;
}

}  // namespace

// What the joints did in the last tick presses the elements through this.
void Destruction::Impl::loadJoints(double dt) {
  if (joints.empty()) return;
  for (DestructibleBody* body : bodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (own.jointed)
      own.jointAngular = jointWrench(*body, solver->motion(own.id, own.shown.fragment)).angular;
  }
  std::vector<edem::HostLoad> loads;
  for (bullet::HeldJoint& held : joints)
    for (int e = 0; e < 2; ++e) {
      bullet::JointEnd& end = held.ends[e];
      if (!end.body || end.element == kNoElement || solver->view(end.body->id()).asleep) continue;
      if (solver->view(end.body->id()).sleeping[end.element]) end.impulse = end.steady = {};
      if (end.impulse.linear.isZero(0) && end.impulse.angular.isZero(0)) continue;
      const double newest = 1 - std::exp(-dt / kSmoothing);
      end.steady.linear += newest * (end.impulse.linear - end.steady.linear);
      end.steady.angular += newest * (end.impulse.angular - end.steady.angular);
      const bullet::JointImpulse rest{end.impulse.linear - end.steady.linear,
                                      end.impulse.angular - end.steady.angular};
      const std::uint32_t id = end.body->id();
      const Eigen::Vector3d pivot = bullet::pivotOf(*held.joint, e == 0),
                            at = toEigen(end.body->getWorldTransform()) * pivot;
      loads.clear();
      bullet::spread(*solver, id, bearing(*solver, *end.body, end.element, pivot), at, end.steady, dt, loads);
      bullet::spread(*solver, id, fragmentOf(*solver, id, end.element), at, rest, dt, loads);
      solver->load(end.body->id(), loads);
    }
}

// Before Bullet makes rows of the joints: it shall see the elements as the substeps left them, but for what
// the joints' own loads did.
void Destruction::Impl::poseJoints(double dt) {
  if (joints.empty() || !failure.empty()) return;
  const double share = solver->report().kicked / dt;
  for (DestructibleBody* body : bodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (!own.jointed || solver->view(own.id).asleep) continue;
    if (solver->view(own.id).fragments > 1) chooseFragment(*body);
    const edem::RigidMotion motion = solver->motion(own.id, own.shown.fragment);
    if (!(motion.mass > 0)) continue;
    const bullet::JointImpulse given = jointWrench(*body, motion);
    own.jointVelocity = share / motion.mass * given.linear;
    // The forces kept their direction while the body turned.
    own.jointSpin = 0.5 * share * motion.inertia.ldlt().solve(own.jointAngular + given.angular);
    // Bullet adds the forces, which the elements have had.
    const btVector3 forced = btScalar(dt) * body->getInvMass() * body->getTotalForce(),
                    turned = btScalar(dt) * (body->getTotalTorque() * body->getInvInertiaTensorWorld());
    body->setLinearVelocity(toBullet(Eigen::Vector3d(motion.velocity - own.jointVelocity)) - forced);
    body->setAngularVelocity(toBullet(Eigen::Vector3d(motion.spin - own.jointSpin)) - turned);
    if (own.state == DestructibleBody::Impl::State::Elements)
      body->setWorldTransform(placeForJoints(*body, dt));
  }
  for (bullet::HeldJoint& held : joints) {
    held.ends[0].place = held.joint->getRigidBodyA().getWorldTransform();
    held.ends[1].place = held.joint->getRigidBodyB().getWorldTransform();
    held.lent = !held.joint->getJointFeedback();
    if (held.lent) held.joint->setJointFeedback(&held.feedback);
  }
}

// Half way between where the tick began and where the substeps left it: so a joint neither feeds nor brakes a
// swing. Bullet's own bodies are still where the tick began: against those it is put back by half the way
// that they are about to go.
btTransform Destruction::Impl::placeForJoints(const DestructibleBody& body, double dt) const {
  const DestructibleBody::Impl& own = implOf(body);
  const edem::Placement at = solver->placement(own.id, own.shown.fragment);
  const btTransform from = body.getWorldTransform(), to = toBullet(at.place * own.shown.frame);
  const btTransform place(from.getRotation().slerp(to.getRotation(), btScalar(0.5)),
                          btScalar(0.5) * (from.getOrigin() + to.getOrigin()));
  btVector3 velocity(0, 0, 0), spin(0, 0, 0);
  int count = 0;
  for (const bullet::HeldJoint& held : joints)
    for (int e = 0; e < 2; ++e) {
      if (held.ends[e].body != &body || held.ends[1 - e].body) continue;
      const btRigidBody& other = e == 0 ? held.joint->getRigidBodyB() : held.joint->getRigidBodyA();
      if (other.isStaticOrKinematicObject()) continue;
      velocity += other.getVelocityInLocalPoint(place.getOrigin() - other.getCenterOfMassPosition());
      spin += other.getAngularVelocity();
      ++count;
    }
  if (count == 0) return place;
  btTransform back;
  btTransformUtil::integrateTransform(place, velocity / btScalar(-count), spin / btScalar(-count),
                                      btScalar(0.5 * dt), back);
  return back;
}

// Of all joints of a body about the centre of `motion`, at the places where its elements are now.
bullet::JointImpulse Destruction::Impl::jointWrench(const DestructibleBody& body,
                                                    const edem::RigidMotion& motion) const {
  const DestructibleBody::Impl& own = implOf(body);
  const edem::Placement at = solver->placement(own.id, own.shown.fragment);
  bullet::JointImpulse sum;
  for (const bullet::HeldJoint& held : joints)
    for (int e = 0; e < 2; ++e) {
      const bullet::JointEnd& end = held.ends[e];
      if (end.body != &body) continue;
      const Eigen::Vector3d pivot = at.place * (own.shown.frame * bullet::pivotOf(*held.joint, e == 0));
      sum.linear += end.impulse.linear;
      sum.angular += end.impulse.about(pivot - motion.centre);
    }
  return sum;
}

namespace {

// What the solver did to one side, where the joint holds it. Bullet tells nothing of what it holds for fixed;
// that has the opposite of what the other side has.
bullet::JointImpulse solvedImpulse(const bullet::HeldJoint& held, int e, double dt) {
  const btJointFeedback& told = *held.joint->getJointFeedback();
  const bool fixed = held.ends[e].body->getLinearFactor().isZero();
  const bool ofA = fixed == (e == 1);
  const Eigen::Vector3d force = toEigen(ofA ? told.m_appliedForceBodyA : told.m_appliedForceBodyB),
                        torque = toEigen(ofA ? told.m_appliedTorqueBodyA : told.m_appliedTorqueBodyB);
  const Eigen::Vector3d pivot = toEigen(held.ends[e].place) * bullet::pivotOf(*held.joint, e == 0),
                        centre = toEigen(held.ends[ofA ? 0 : 1].place.getOrigin());
  const double sign = fixed ? -dt : dt;
  return {sign * force, sign * (torque - (pivot - centre).cross(force))};
}

}  // namespace

// After Bullet has solved them.
void Destruction::Impl::takeJoints(double dt) {
  if (joints.empty()) return;
  BT_PROFILE("Rubble take joints");
  // Actions of the application that came first may have taken some away.
  for (bullet::HeldJoint& held : joints)
    if (!hasJoint(held.joint)) held = {};
  for (bullet::HeldJoint& held : joints)
    for (int e = 0; e < 2; ++e) {
      bullet::JointEnd& end = held.ends[e];
      if (!end.body || !implOf(*end.body).inSolver || solver->view(end.body->id()).asleep) continue;
      end.impulse = {};
      if (end.element == kNoElement || !held.joint->isEnabled() || !held.joint->getJointFeedback()) continue;
      const bullet::JointImpulse solved = solvedImpulse(held, e, dt);
      if (solved.linear.allFinite() && solved.angular.allFinite()) end.impulse = solved;
    }
  for (bullet::HeldJoint& held : joints) {
    if (held.lent) held.joint->setJointFeedback(nullptr);
    held.lent = false;
  }
  for (DestructibleBody* body : bodies) {
    DestructibleBody::Impl& own = implOf(*body);
    if (!own.jointed || !own.inSolver || solver->view(own.id).asleep) continue;
    if (!body->getLinearFactor().isZero()) pushJointed(*body, dt);
  }
}

// What anchors hold has it as a load in the next tick only.
void Destruction::Impl::pushJointed(DestructibleBody& body, double dt) {
  DestructibleBody::Impl& own = implOf(body);
  const edem::RigidMotion motion = solver->motion(own.id, own.shown.fragment);
  if (!(motion.mass > 0)) return;
  const bullet::JointImpulse solved = jointWrench(body, motion);
  Eigen::Vector3d velocity = solved.linear / motion.mass, spin = motion.inertia.ldlt().solve(solved.angular);
  // What has just broken was another body to Bullet, and would be thrown by what that needed.
  const double seen = motion.mass * double(body.getInvMass());
  if (!(std::abs(seen - 1) < kSameMass)) {
    velocity *= seen;
    spin = toEigen(btVector3(body.getInvInertiaTensorWorld() * toBullet(solved.angular)));
  }
  velocity -= own.jointVelocity;
  spin -= own.jointSpin;
  const edem::BodyView view = solver->view(own.id);
  if (view.sleepingCount > 0) {
    const double least = kWakingShare * dt * double(world.getGravity().length());
    if (velocity.norm() + own.asset->diagonal() * spin.norm() < least) return;
  }
  if (velocity.isZero(0) && spin.isZero(0)) return;
  solver->pushAll(own.id, own.shown.fragment, velocity, spin);
}

RUBBLE_ABI_END
}  // namespace rubble
