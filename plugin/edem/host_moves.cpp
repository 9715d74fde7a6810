#include "edem/host_moves.h"

#include "edem/body_books.h"
#include "edem/frames.h"
#include "edem/rigid_motion.h"
#include "edem/stages.h"

namespace rubble::edem {

template <class Real>
void pushWhole(Body<Real>& body, std::uint32_t root, const Eigen::Vector3d& velocity,
               const Eigen::Vector3d& spin, Books& books) {
  const Eigen::Vector3d centre = wholeMotion(body, root).centre;
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!body.state.alive[i] || (root != kNoElement && body.state.fragment[i] != root)) continue;
    const Eigen::Vector3d arm = body.worldPosition(i) - centre;
    pushElement(body, i, body.constants->mass[i] * (velocity + spin.cross(arm)),
                body.constants->inertia[i] * spin, books);
  }
}

namespace {

template <class Real>
double powerOf(const Body<Real>& body, const HostLoad& load) {
  return load.force.dot(body.state.velocity[load.element].template cast<double>()) +
         load.torque.dot(body.state.spin[load.element].template cast<double>());
}

template <class Real>
bool takes(const Body<Real>& body, const HostLoad& load) {
  return body.state.alive[load.element] && !body.state.sleeping[load.element];
}

}  // namespace

template <class Real>
void addHostLoads(Body<Real>& body, double kick, Books& books) {
  for (const HostLoad& load : body.state.hostLoads) {
    if (!takes(body, load)) continue;
    const std::uint32_t i = load.element;
    body.work.force[i] += load.force.cast<Real>();
    body.work.torque[i] += load.torque.cast<Real>();
    const Eigen::Vector3d at = body.state.origin + body.work.position[i];
    FragmentMotion& motion = body.work.motions[body.work.motionOf[i]];
    motion.force += load.force;
    motion.torque += (at - motion.centre).cross(load.force) + load.torque;
    books.bullet.push(kick, load.force, at - books.centre, load.torque);
    books.bullet.work.add(0.5 * kick * powerOf(body, load), 0);
  }
}

template <class Real>
void bookHostLoads(const Body<Real>& body, double kick, Books& books) {
  for (const HostLoad& load : body.state.hostLoads)
    if (takes(body, load)) books.bullet.work.add(0, 0.5 * kick * powerOf(body, load));
}

template <class Real>
void moveWhole(Body<Real>& body, const Eigen::Isometry3d& by, Books& books) {
  const auto momenta = [&] {
    const RigidMotion m = wholeMotion(body);
    const Eigen::Vector3d linear = m.mass * m.velocity;
    return std::pair(linear, Eigen::Vector3d(m.angular + (m.centre - books.centre).cross(linear)));
  };
  const auto [linear, angular] = momenta();
  const Eigen::Quaterniond turn(by.linear());
  body.state.origin = by * body.state.origin;
  body.state.turn = (turn * body.state.turn).normalized();
  for (Frame& frame : body.state.frames) frame = {by * frame.origin, (turn * frame.turn).normalized()};
  if (!by.linear().isIdentity(0)) {
    const Eigen::Matrix<Real, 3, 3> turned = by.linear().cast<Real>();
    const Quat<Real> around = turn.cast<Real>();
    for (auto* vectors : {&body.state.displacement, &body.state.velocity, &body.state.velocityCarry,
                          &body.state.spin, &body.state.parkedAt})
      for (Vec3<Real>& v : *vectors) v = turned * v;
    for (auto* rotations : {&body.state.rotation, &body.state.parkedTurn})
      for (Quat<Real>& q : *rotations) q = (around * q * around.conjugate()).normalized();
  }
  turnRest(body, 0);
  beginSubstep(body.state, body.work);
  const auto [linearNow, angularNow] = momenta();
  books.bullet.push(1, linearNow - linear, Eigen::Vector3d::Zero(), angularNow - angular);
  books.linear += linearNow - linear;
  books.angular += angularNow - angular;
}

template <class Real>
void moveHeld(Body<Real>& body, const Frame& to, Books& books) {
  const auto angular = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < body.elementCount(); ++i)
      if (body.state.alive[i] && body.state.frameOf[i] == 0)
        sum += (body.worldPosition(i) - books.centre)
                   .cross(body.constants->mass[i] * body.state.velocity[i].template cast<double>());
    return sum;
  };
  const Eigen::Vector3d before = angular();
  moveFrame0(body, to);
  const Eigen::Vector3d gained = angular() - before;
  books.bullet.angular += gained;
  books.angular += gained;
}

template void moveHeld(Body<float>&, const Frame&, Books&);
template void moveHeld(Body<double>&, const Frame&, Books&);
template void pushWhole(Body<float>&, std::uint32_t, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);
template void pushWhole(Body<double>&, std::uint32_t, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);
template void addHostLoads(Body<float>&, double, Books&);
template void addHostLoads(Body<double>&, double, Books&);
template void bookHostLoads(const Body<float>&, double, Books&);
template void bookHostLoads(const Body<double>&, double, Books&);
template void moveWhole(Body<float>&, const Eigen::Isometry3d&, Books&);
template void moveWhole(Body<double>&, const Eigen::Isometry3d&, Books&);

}  // namespace rubble::edem
