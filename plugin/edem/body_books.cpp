#include "edem/body_books.h"

#include <cassert>

#include "edem/stages.h"

namespace rubble::edem {

template <class Real>
void bookNew(const Body<Real>& body, Books& books) {
  Books probe = books;
  if (books.initialMass == 0) books.centre = body.state.origin;
  double mass = 0, kinetic = 0, size = 0;
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    const Eigen::Vector3d v = body.state.velocity[i].template cast<double>(),
                          w = body.state.spin[i].template cast<double>();
    const double m = body.constants->mass[i];
    mass += m;
    kinetic += 0.5 * (m * v.squaredNorm() + body.constants->inertia[i] * w.squaredNorm());
    size += m * v.norm();
    linear += m * v;
    angular += (body.worldPosition(i) - books.centre).cross(m * v) + body.constants->inertia[i] * w;
  }
  BodyWork<Real> work = body.work;
  const double elastic = accumulateSprings(body, work, 0, false, probe);
  books.initialMass += mass;
  books.initialMomentumSize += size;
  books.initialLinear += linear;
  books.initialAngular += angular;
  books.initialEnergy += kinetic + elastic;
  books.diagonal = std::max(books.diagonal, body.constants->asset->diagonal());
  books.mass += mass;
  books.kinetic += kinetic;
  books.elastic += elastic;
  books.linear += linear;
  books.angular += angular;
}

template <class Real>
void bookLeaving(const Body<Real>& body, double contactElastic, Books& books) {
  Books probe = books;
  probe.mass = probe.kinetic = 0;
  probe.linear = probe.angular = Eigen::Vector3d::Zero();
  Body<Real> copy = body;
  beginSubstep(copy.state, copy.work);
  const double elastic = accumulateSprings(copy, copy.work, 0, false, probe) + contactElastic;
  integrate(copy, 0, 0, Eigen::Vector3d::Zero(), std::span<const Vec3<double>>(copy.work.position),
            Eigen::Vector3d::Zero(), probe);
  books.leftMass += probe.mass;
  books.leftKinetic += probe.kinetic;
  books.leftElastic += elastic;
  books.leftLinear += probe.linear;
  books.leftAngular += probe.angular;
  books.mass -= probe.mass;
  books.kinetic -= probe.kinetic;
  books.elastic -= elastic;
  books.linear -= probe.linear;
  books.angular -= probe.angular;
}

template <class Real>
double elasticOf(const Body<Real>& body) {
  Books probe;
  BodyWork<Real> work = body.work;
  beginSubstep(body.state, work);
  return accumulateSprings(body, work, 0, false, probe);
}

template <class Real>
double massOf(const Body<Real>& body) {
  double mass = 0;
  for (std::size_t i = 0; i < body.elementCount(); ++i)
    mass += body.state.alive[i] ? body.constants->mass[i] : 0;
  return mass;
}

template <class Real>
void pushElement(Body<Real>& body, std::size_t i, const Eigen::Vector3d& linear,
                 const Eigen::Vector3d& angular, Books& books) {
  assert(i < body.elementCount() && linear.allFinite() && angular.allFinite());
  const Vec3<Real> v0 = body.state.velocity[i], w0 = body.state.spin[i];
  body.state.velocity[i] += body.constants->inverseMass[i] * linear.cast<Real>();
  body.state.spin[i] += body.constants->inverseInertia[i] * angular.cast<Real>();
  const Eigen::Vector3d gained =
      body.constants->mass[i] * (body.state.velocity[i] - v0).template cast<double>();
  const Eigen::Vector3d turned =
      body.constants->inertia[i] * (body.state.spin[i] - w0).template cast<double>();
  const Eigen::Vector3d arm = body.worldPosition(i) - books.centre;
  const double work = 0.5 * (gained.dot((v0 + body.state.velocity[i]).template cast<double>()) +
                             turned.dot((w0 + body.state.spin[i]).template cast<double>()));
  books.bullet.push(1, gained, arm, turned);
  books.bullet.work.add(work, 0);
  books.linear += gained;
  books.angular += arm.cross(gained) + turned;
  books.kinetic += work;
}

template void bookNew(const Body<float>&, Books&);
template void bookNew(const Body<double>&, Books&);
template void bookLeaving(const Body<float>&, double, Books&);
template void bookLeaving(const Body<double>&, double, Books&);
template double massOf(const Body<float>&);
template double massOf(const Body<double>&);
template double elasticOf(const Body<float>&);
template double elasticOf(const Body<double>&);
template void pushElement(Body<float>&, std::size_t, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);
template void pushElement(Body<double>&, std::size_t, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);

}  // namespace rubble::edem
