// The last stages of a substep: motion, and crushed elements leaving.
#include <cassert>
#include <cmath>
#include <limits>

#include "edem/frozen.h"
#include "edem/stages.h"

namespace rubble::edem {
namespace {

// v + dv with what the addition lost kept in `carry` (Kahan). In float, gravity's tiny kicks would else be
// rounded the same way hundreds of times in a row.
template <class Real>
Vec3<Real> addCompensated(const Vec3<Real>& v, const Vec3<Real>& dv, Vec3<Real>& carry) {
  const Vec3<Real> wanted = dv + carry;
  const Vec3<Real> sum = v + wanted;
  carry = wanted - (sum - v);
  return sum;
}

// Rotation by w h of the unit quaternion q, exact for constant w to fifth order in |w| h; normalised.
template <class Real>
Quat<Real> rotated(const Quat<Real>& q, const Vec3<Real>& w, Real h) {
  const Vec3<Real> half = (Real(0.5) * h) * w;
  const Real a2 = half.squaredNorm();
  const Real sine = Real(1) - a2 / Real(6) * (Real(1) - a2 / Real(20));  // sin(a)/a
  const Real cosine = Real(1) - a2 / Real(2) * (Real(1) - a2 / Real(12));
  Quat<Real> step;
  step.vec() = sine * half;
  step.w() = cosine;
  return (step * q).normalized();
}

}  // namespace

template <class Real>
Real integrate(Body<Real>& body, double kick, double step, const Eigen::Vector3d& gravity,
               std::span<const Vec3<double>> listed, const Eigen::Vector3d& drifted, Books& books) {
  assert(std::isfinite(kick) && kick >= 0 && std::isfinite(step) && step >= 0);
  assert(listed.size() == body.elementCount());
  const Real kickTime = Real(kick), stepTime = Real(step);
  const Vec3<Real> fall = (kick * gravity).template cast<Real>();
  Real furthest2 = 0;
  double mass = 0, kinetic = 0, lost = 0, lostNext = 0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero(), after = Eigen::Vector3d::Zero(),
                  spinning = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : body.work.awake) {
    if (!body.state.alive[i]) continue;
    const Vec3<Real> oldVelocity = body.state.velocity[i], oldSpin = body.state.spin[i];
    body.state.velocity[i] = addCompensated<Real>(
        oldVelocity, (kickTime * body.constants->inverseMass[i]) * body.work.force[i] + fall,
        body.state.velocityCarry[i]);
    body.state.spin[i] = oldSpin + (kickTime * body.constants->inverseInertia[i]) * body.work.torque[i];
    if (body.work.frozen[i]) stop(body, i, oldVelocity, oldSpin, books);
    body.state.displacement[i] += stepTime * body.state.velocity[i];
    body.state.rotation[i] = rotated(body.state.rotation[i], body.state.spin[i], stepTime);
    const Vec3<double> moved =
        body.work.rest[i] + body.state.displacement[i].template cast<double>() - listed[i] - drifted;
    const Real moved2 = Real(moved.squaredNorm());
    furthest2 = moved2 > furthest2 || !(moved2 == moved2) ? moved2 : furthest2;

    const double m = body.constants->mass[i], inertia = body.constants->inertia[i];
    const Eigen::Vector3d v0 = oldVelocity.template cast<double>(),
                          v1 = body.state.velocity[i].template cast<double>();
    const Eigen::Vector3d w0 = oldSpin.template cast<double>(),
                          w1 = body.state.spin[i].template cast<double>();
    const Eigen::Vector3d x = body.work.position[i];
    mass += m;
    before += m * v0;
    after += m * v1;
    moment += m * x;
    angular += x.cross(m * v1);
    spinning += inertia * w1;
    kinetic += 0.5 * (m * v0.dot(v1) + inertia * w0.dot(w1));
    const Eigen::Vector3d f = body.work.dampingForce[i].template cast<double>();
    const Eigen::Vector3d t = body.work.dampingTorque[i].template cast<double>();
    lost += f.dot(v0) + t.dot(w0);
    lostNext += f.dot(v1) + t.dot(w1);
  }
  const Eigen::Vector3d arm = body.state.origin - books.centre;
  books.mass += mass + body.state.massAsleep;
  books.kinetic += kinetic;
  books.linear += after;
  books.angular += arm.cross(after) + angular + spinning;
  books.gravity.linear += kick * mass * gravity;
  books.gravity.angular += kick * (arm * mass + moment).cross(gravity);
  books.gravity.size += kick * mass * gravity.norm();
  books.gravity.work.add(0.5 * kick * gravity.dot(before), 0.5 * kick * gravity.dot(after));
  books.dissipated.add(0.5 * kick * lost, 0.5 * kick * lostNext);
  // Faster than light in the mean they are no state any more, though floats still hold it.
  constexpr double kLight = 3e8;  // [m/s]
  return std::abs(kinetic) <= 0.5 * mass * kLight * kLight ? furthest2
                                                           : std::numeric_limits<Real>::quiet_NaN();
}

template <class Real>
void removeCrushed(Body<Real>& body, std::size_t brokenBegin, Books& books, TickReport& report) {
  assert(brokenBegin <= report.broken.size());
  for (const std::uint32_t i : body.work.crushing) {
    assert(i < body.elementCount() && body.state.alive[i]);
    base::CrushedElement c;
    c.body = body.id;
    c.element = i;
    c.restCentre = body.constants->asset->positions[i];
    c.centre = body.worldPosition(i);
    c.velocity = body.state.velocity[i].template cast<double>();
    c.spin = body.state.spin[i].template cast<double>();
    c.orientation = body.orientation(i);
    c.mass = body.constants->mass[i];
    c.inertia = body.constants->inertia[i];
    c.volume = body.constants->asset->volumes[i];
    c.radius = body.constants->asset->radius;
    c.fractureEnergy = double(body.work.load[i]);
    for (std::size_t k = brokenBegin; k < report.broken.size(); ++k) {
      const BrokenSpring& b = report.broken[k];
      if (b.body != body.id) continue;
      const Spring<Real>& s = body.state.springs[b.spring];
      if (s.first != i && s.second != i) continue;
      const bool both = !body.isAnchor(b.spring) && body.work.leaving[s.first] && body.work.leaving[s.second];
      c.releasedEnergy += both ? 0.5 * b.energy : b.energy;
    }
    report.crushed.push_back(c);
  }
  for (const std::uint32_t i : body.work.crushing) {
    const double m = body.constants->mass[i];
    const Eigen::Vector3d v = body.state.velocity[i].template cast<double>(),
                          w = body.state.spin[i].template cast<double>();
    const double kinetic = 0.5 * (m * v.squaredNorm() + body.constants->inertia[i] * w.squaredNorm());
    const Eigen::Vector3d angular =
        (body.worldPosition(i) - books.centre).cross(m * v) + body.constants->inertia[i] * w;
    books.leftMass += m;
    books.leftKinetic += kinetic;
    books.leftLinear += m * v;
    books.leftAngular += angular;
    books.mass -= m;
    books.kinetic -= kinetic;
    books.linear -= m * v;
    books.angular -= angular;
    body.state.alive[i] = 0;
    body.work.leaving[i] = 0;
    ++body.state.crushedCount;
  }
}

template float integrate(Body<float>&, double, double, const Eigen::Vector3d&, std::span<const Vec3<double>>,
                         const Eigen::Vector3d&, Books&);
template double integrate(Body<double>&, double, double, const Eigen::Vector3d&,
                          std::span<const Vec3<double>>, const Eigen::Vector3d&, Books&);
template void removeCrushed(Body<float>&, std::size_t, Books&, TickReport&);
template void removeCrushed(Body<double>&, std::size_t, Books&, TickReport&);

}  // namespace rubble::edem
