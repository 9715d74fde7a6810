#include "edem/damping.h"

#include <cassert>
#include <cmath>

#include "edem/rigid_motion.h"

namespace rubble::edem {
namespace {

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
