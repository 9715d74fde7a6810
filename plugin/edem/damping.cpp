#include "edem/damping.h"

#include <cassert>
#include <cmath>
#include <map>

namespace rubble::edem {
namespace {

struct RigidMotion {
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
};

// Rigid motion of each fragment with the same linear and angular momentum.
template <class Real>
std::map<std::uint32_t, RigidMotion> rigidMotions(const Body<Real>& body) {
  std::map<std::uint32_t, RigidMotion> motions;
  const auto each = [&](auto&& visit) {
    for (std::size_t i = 0; i < body.elementCount(); ++i)
      if (body.alive[i]) visit(i, motions[body.fragment[i]]);
  };
  each([&](std::size_t i, RigidMotion& m) {
    m.mass += body.mass[i];
    m.centre += body.mass[i] * body.worldPosition(i);
    m.velocity += body.mass[i] * body.velocity[i].template cast<double>();
  });
  for (auto& [root, m] : motions) {
    m.centre /= m.mass;
    m.velocity /= m.mass;
  }
  each([&](std::size_t i, RigidMotion& m) {
    const Eigen::Vector3d arm = body.worldPosition(i) - m.centre;
    const Eigen::Vector3d v = body.velocity[i].template cast<double>() - m.velocity;
    m.angular += body.mass[i] * arm.cross(v) + body.inertia[i] * body.spin[i].template cast<double>();
    m.inertia += body.mass[i] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose()) +
                 body.inertia[i] * Eigen::Matrix3d::Identity();
  });
  for (auto& [root, m] : motions) m.spin = m.inertia.ldlt().solve(m.angular);
  return motions;
}

template <class Real>
double kineticOf(const Body<Real>& body, std::size_t i) {
  return 0.5 * (body.mass[i] * body.velocity[i].template cast<double>().squaredNorm() +
                body.inertia[i] * body.spin[i].template cast<double>().squaredNorm());
}

}  // namespace

template <class Real>
void dampDeformation(Body<Real>& body, double rate, double dt, Books& books) {
  assert(rate >= 0 && dt >= 0);
  const double lost = -std::expm1(-rate * dt);
  const auto motions = rigidMotions(body);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!body.alive[i]) continue;
    const RigidMotion& m = motions.at(body.fragment[i]);
    const double before = kineticOf(body, i);
    const Eigen::Vector3d v = m.velocity + m.spin.cross(body.worldPosition(i) - m.centre);
    body.velocity[i] += (lost * (v - body.velocity[i].template cast<double>())).template cast<Real>();
    body.spin[i] += (lost * (m.spin - body.spin[i].template cast<double>())).template cast<Real>();
    const double taken = before - kineticOf(body, i);
    books.massDamped += taken;
    books.kinetic -= taken;
  }
}

template <class Real>
void bookSlept(Body<Real>& body, Books& books) {
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!body.alive[i]) continue;
    const double taken = kineticOf(body, i);
    const Eigen::Vector3d momentum = body.mass[i] * body.velocity[i].template cast<double>();
    const Eigen::Vector3d angular = (body.worldPosition(i) - books.centre).cross(momentum) +
                                    body.inertia[i] * body.spin[i].template cast<double>();
    books.slept += taken;
    books.sleptLinear += momentum;
    books.sleptAngular += angular;
    books.kinetic -= taken;
    books.linear -= momentum;
    books.angular -= angular;
    body.velocity[i].setZero();
    body.velocityCarry[i].setZero();
    body.spin[i].setZero();
  }
}

template void dampDeformation(Body<float>&, double, double, Books&);
template void dampDeformation(Body<double>&, double, double, Books&);
template void bookSlept(Body<float>&, Books&);
template void bookSlept(Body<double>&, Books&);

}  // namespace rubble::edem
