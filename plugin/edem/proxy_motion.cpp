#include "edem/proxy_motion.h"

#include <algorithm>

#include "edem/supports.h"

namespace rubble::edem {
namespace {

// What an impulse changes of its velocity and spin.
Twist response(const RigidProxy& proxy, const Wrench& impulse) {
  if (proxy.mobility) {
    Eigen::Matrix<double, 6, 1> push;
    push << impulse.force, impulse.torque;
    push = *proxy.mobility * push;
    return {push.head<3>(), push.tail<3>()};
  }
  const Eigen::Matrix3d turn = proxy.orientation.toRotationMatrix();
  return {proxy.inverseMass * impulse.force,
          turn * (proxy.inverseInertia.asDiagonal() * (turn.transpose() * impulse.torque))};
}

// Way of a point of the body from a place to the one that it has [m].
double furthest(const RigidProxy& proxy, const RigidPose& from) {
  return (proxy.position - from.position).norm() +
         from.orientation.angularDistance(proxy.orientation) * proxy.reach();
}

// For what elements weigh much more than, their springs press a float's rounding with more energy than it
// has.
void keepPlace(RigidProxy& proxy, const RigidPose& left, double light) {
  if (!(proxy.inverseMass * light > 1)) return;
  if ((proxy.position - left.position).cwiseAbs().maxCoeff() <= double(proxy.rounding))
    proxy.position = left.position;
}

// What the elements and the contacts' springs get is what the rigid body does, by its own motion: a body that
// does not move gives nothing. In half of a kick.
HalfWork workOf(const RigidState& state, double kick, const RigidProxy& proxy) {
  const auto power = [&](const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
    return 0.5 * kick * (force.dot(proxy.velocity) + torque.dot(proxy.spin));
  };
  return {-power(state.force, state.torque), -power(state.anchorForce, state.anchorTorque),
          power(state.dampingForce, state.dampingTorque)};
}

void movePlace(RigidProxy& proxy, double step) {
  proxy.position += step * proxy.velocity;
  const double angle = proxy.spin.norm() * step;
  if (angle > 0)
    proxy.orientation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(angle, proxy.spin.normalized())) * proxy.orientation)
            .normalized();
}

}  // namespace

RigidPose poseOf(const RigidProxy& proxy) {
  return {proxy.position, proxy.velocity, proxy.spin, proxy.orientation};
}

void setPose(RigidProxy& proxy, const RigidPose& pose) {
  proxy.position = pose.position;
  proxy.velocity = pose.velocity;
  proxy.spin = pose.spin;
  proxy.orientation = pose.orientation;
}

void pushProxy(RigidProxy& proxy, const Wrench& impulse) {
  if (proxy.isDynamic()) {
    const Twist change = response(proxy, impulse);
    proxy.velocity += change.linear;
    proxy.spin += change.angular;
  }
  proxy.impulse += impulse.force;
  proxy.angularImpulse += impulse.torque;
  proxy.anchorImpulse += impulse.force;
}

double speedOf(const RigidProxy& proxy, const Eigen::Vector3d& drift) {
  return (proxy.velocity - drift).norm() + proxy.spin.norm() * proxy.reach();
}

void takeProxies(std::span<RigidProxy> proxies, std::span<RigidState> before, double leap, double light,
                 std::vector<RigidState>& states) {
  states.assign(proxies.size(), {});
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    RigidProxy& proxy = proxies[p];
    RigidState& state = states[p];
    state.key = proxy.key != 0 ? proxy.key : p + 1;
    const auto last =
        std::find_if(before.begin(), before.end(), [&](const RigidState& s) { return s.key == state.key; });
    proxy.given = proxy.givenNext = proxy.surplus = 0;
    if (last != before.end()) {
      state.left = last->left;
      state.leapt = proxy.placed && furthest(proxy, last->left) > leap;
      state.moved = !state.leapt;
      if (!proxy.placed) keepPlace(proxy, last->left, light);
      state.still = !proxy.isDynamic() && proxy.velocity.isZero(0) && proxy.spin.isZero(0) &&
                    proxy.position == last->left.position &&
                    proxy.orientation.coeffs() == last->left.orientation.coeffs();
      state.pressed = last->size;
      state.pressedRate = last->pressedRate;
      state.surplusNext = last->surplusNext;
      if (!state.leapt) state.corners = std::move(last->corners);
    }
    proxy.supportImpulse.setZero();
    proxy.supportAngularImpulse.setZero();
    proxy.impulse.setZero();
    proxy.angularImpulse.setZero();
    proxy.contactPoint.setZero();
    proxy.contactWeight = 0;
    proxy.pulled = false;
    proxy.anchorImpulse.setZero();
    proxy.touched.clear();
  }
}

void moveProxies(std::span<RigidProxy> proxies, std::span<RigidState> states, double kick, double step,
                 Books& books) {
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    RigidProxy& proxy = proxies[p];
    RigidState& state = states[p];
    proxy.impulse += kick * state.force;
    proxy.angularImpulse += kick * state.torque;
    proxy.anchorImpulse += kick * state.anchorForce;
    state.halfWork = workOf(state, kick, proxy);
    books.bullet.linear -= kick * state.force;
    books.bullet.angular -= kick * ((proxy.position - books.centre).cross(state.force) + state.torque);
    books.bullet.size += kick * (state.size + state.anchorForce.norm());
    for (const RigidProxy::Coupling& other : proxy.coupled) {
      Eigen::Matrix<double, 6, 1> push;
      push << state.force, state.torque;
      push = kick * (other.mobility * push);
      proxies[other.proxy].velocity += push.head<3>();
      proxies[other.proxy].spin += push.tail<3>();
    }
    if (proxy.isDynamic()) {
      const Twist change = response(proxy, {state.force, state.torque});
      proxy.velocity += kick * (change.linear + proxy.acceleration);
      proxy.spin += kick * (change.angular + proxy.angularAcceleration);
    }
  }
  holdProxies(proxies, step);
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    RigidProxy& proxy = proxies[p];
    RigidState& state = states[p];
    const HalfWork first = state.halfWork, second = workOf(state, kick, proxy);
    books.bullet.work.add(first.given, second.given);
    proxy.given += first.given + second.given;
    proxy.givenNext = second.given;
    proxy.surplus -= first.given - first.byAnchors;
    state.surplusNext -= second.given - second.byAnchors;
    books.dissipated.add(first.lost, second.lost);
    movePlace(proxy, step);
    state.left = poseOf(proxy);
  }
}

}  // namespace rubble::edem
