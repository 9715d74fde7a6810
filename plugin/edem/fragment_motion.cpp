#include "edem/fragment_motion.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rubble::edem {
namespace {

// Up to this speed what is withheld grows from nothing [m/s]: let go at once, a column under a weight tears
// itself by the wave of that. What leaves so slowly rises half a millimetre.
constexpr double kRestingSpeed = 0.1;

// Numbers the fragments from 0 in the order of their lowest elements.
template <class Real>
void number(Body<Real>& body) {
  std::uint32_t count = 0;
  body.work.motionOf.assign(body.elementCount(), 0);
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    if (!body.state.alive[i]) continue;
    body.work.motionOf[i] =
        body.state.fragment[i] == i ? count++ : body.work.motionOf[body.state.fragment[i]];
  }
  body.work.motions.assign(std::max(count, 1u), {});
  body.work.numberedBroken = body.state.labelledBroken;
  body.work.numberedCrushed = body.state.crushedCount;
}

// What each awake fragment was pressed with in the last substep [N]; nothing if there are others now.
template <class Real>
std::vector<double> pressedBefore(const BodyWork<Real>& work) {
  std::vector<double> pressed(work.motions.size(), 0);
  for (const std::uint32_t f : work.awakeMotions) pressed[f] = work.motions[f].pressed;
  return pressed;
}

void goWithBase(const AnchorBase& base, FragmentMotion& motion) {
  motion.velocity = base.velocityAt(motion.centre);
  motion.spin = base.velocity.angular;
}

}  // namespace

template <class Real>
void beginMotions(Body<Real>& body) {
  BodyWork<Real>& work = body.work;
  std::vector<FragmentMotion>& motions = work.motions;
  const std::vector<double> pressed = pressedBefore(work);
  // What sleeps stands as it was, unless all are numbered anew.
  const bool all = motions.empty() || work.numberedBroken != body.state.labelledBroken ||
                   work.numberedCrushed != body.state.crushedCount;
  if (all) number(body);
  work.awakeMotions.clear();
  for (const std::uint32_t i : work.awake)
    if (body.state.fragment[i] == i) work.awakeMotions.push_back(work.motionOf[i]);
  for (const std::uint32_t f : work.awakeMotions) {
    motions[f] = {};
    if (pressed.size() == motions.size()) motions[f].pressed = pressed[f];
  }
  const auto each = [&](auto&& visit) {
    const auto one = [&](std::size_t i) {
      if (body.state.alive[i]) visit(i, motions[work.motionOf[i]], body.worldPosition(i));
    };
    if (all)
      for (std::size_t i = 0; i < body.elementCount(); ++i) one(i);
    else
      for (const std::uint32_t i : work.awake) one(i);
  };
  const auto eachMotion = [&](auto&& visit) {
    if (all)
      for (std::uint32_t f = 0; f < motions.size(); ++f) visit(f);
    else
      for (const std::uint32_t f : work.awakeMotions) visit(f);
  };
  std::vector<double> mass(motions.size());
  each([&](std::size_t i, FragmentMotion& m, const Eigen::Vector3d& x) {
    mass[work.motionOf[i]] += body.constants->mass[i];
    m.centre += body.constants->mass[i] * x;
    m.velocity += body.constants->mass[i] * body.state.velocity[i].template cast<double>();
    m.fixed = m.fixed || body.state.anchored[i];
  });
  eachMotion([&](std::uint32_t f) {
    if (!(mass[f] > 0)) return;
    motions[f].centre /= mass[f];
    motions[f].velocity /= mass[f];
    motions[f].inverseMass = motions[f].fixed ? 0 : 1 / mass[f];
  });
  std::vector<Eigen::Matrix3d> inertia(motions.size(), Eigen::Matrix3d::Zero());
  each([&](std::size_t i, FragmentMotion& m, const Eigen::Vector3d& x) {
    const Eigen::Vector3d arm = x - m.centre;
    m.spin += body.constants->mass[i] * arm.cross(body.state.velocity[i].template cast<double>()) +
              body.constants->inertia[i] * body.state.spin[i].template cast<double>();
    inertia[work.motionOf[i]] += (body.constants->mass[i] * arm.squaredNorm() + body.constants->inertia[i]) *
                                     Eigen::Matrix3d::Identity() -
                                 body.constants->mass[i] * arm * arm.transpose();
  });
  eachMotion([&](std::uint32_t f) {
    FragmentMotion& m = motions[f];
    if (m.fixed || !(mass[f] > 0)) {
      m.velocity.setZero();
      m.spin.setZero();
      if (m.fixed && body.state.base.given) goWithBase(body.state.base, m);
      return;
    }
    m.inverseInertia = inertia[f].inverse();
    m.spin = m.inverseInertia * m.spin;
  });
}

template <class Real>
void moveMotions(Body<Real>& body, double kick, double step, const Eigen::Vector3d& gravity) {
  assert(kick >= 0 && step >= 0);
  for (const std::uint32_t f : body.work.awakeMotions) {
    FragmentMotion& m = body.work.motions[f];
    m.pressed = std::exchange(m.pressing, 0);
    if (!m.fixed) {
      m.velocity += kick * (m.inverseMass * m.force + gravity);
      m.spin += kick * (m.inverseInertia * m.torque);
      m.centre += step * m.velocity;
    } else if (body.state.base.given) {
      goWithBase(body.state.base, m);
      m.centre += step * m.velocity;
    }
    m.force.setZero();
    m.torque.setZero();
  }
}

void pushMotion(FragmentMotion& motion, const Eigen::Vector3d& at, const Eigen::Vector3d& force,
                const Eigen::Vector3d& torque) {
  motion.force += force;
  motion.torque += (at - motion.centre).cross(force) + torque;
  motion.pressing += force.norm();
}

double withheld(double inelastic, double parting, double jolt, double resting) {
  assert(inelastic >= 0 && inelastic <= 1 && jolt >= 0 && resting >= 0 && resting <= 1);
  if (!(parting > 0)) return 0;
  const double rise = parting / std::max(kRestingSpeed, 0.25 * jolt);
  return std::min(inelastic * std::min(1.0, rise), 1 - resting * std::clamp(2 - rise, 0.0, 1.0));
}

template void beginMotions(Body<float>&);
template void beginMotions(Body<double>&);
template void moveMotions(Body<float>&, double, double, const Eigen::Vector3d&);
template void moveMotions(Body<double>&, double, double, const Eigen::Vector3d&);

}  // namespace rubble::edem
