#include "edem/parking.h"

#include <cassert>

#include "edem/body_books.h"
#include "edem/frames.h"
#include "edem/stages.h"

namespace rubble::edem {
namespace {

struct Motion {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();  // about Books::centre
  double kinetic = 0;
};

template <class Real>
Motion motionOf(const Body<Real>& body, const Eigen::Vector3d& about) {
  Motion all;
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!body.alive[i]) continue;
    const Eigen::Vector3d v = body.velocity[i].template cast<double>(),
                          w = body.spin[i].template cast<double>();
    all.linear += body.mass[i] * v;
    all.angular += (body.worldPosition(i) - about).cross(body.mass[i] * v) + body.inertia[i] * w;
    all.kinetic += 0.5 * (body.mass[i] * v.squaredNorm() + body.inertia[i] * w.squaredNorm());
  }
  return all;
}

void bookHost(const Motion& before, const Motion& after, Books& books) {
  const Eigen::Vector3d linear = after.linear - before.linear, angular = after.angular - before.angular;
  books.bullet.push(1, linear, Eigen::Vector3d::Zero(), angular);
  books.bullet.work.add(after.kinetic - before.kinetic, 0);
  books.linear += linear;
  books.angular += angular;
  books.kinetic += after.kinetic - before.kinetic;
}

}  // namespace

template <class Real>
void park(Body<Real>& body, Books& books) {
  assert(!body.asleep && body.fragmentCount == 1 && body.brokenCount == 0);
  const Motion before = motionOf(body, books.centre);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.velocity[i].setZero();
    body.velocityCarry[i].setZero();
    body.spin[i].setZero();
  }
  bookHost(before, {}, books);
  body.sleepingElastic = elasticOf(body);
  body.asleep = body.parked = true;
}

template <class Real>
void placeParked(Body<Real>& body, const Eigen::Isometry3d& place) {
  assert(body.parked && body.frames.size() <= 2);
  if (body.frames.size() < 2) return;
  // The frame's origin is the centre of mass, asset axes: that of the rest positions.
  const Eigen::Vector3d centre = body.asset->positions[0] - body.restCentred[0];
  body.frames[1] = {place * centre, Eigen::Quaterniond(place.linear()).normalized()};
}

template <class Real>
void unpark(Body<Real>& body, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angularMomentum,
            Books& books) {
  assert(body.parked);
  body.asleep = body.parked = false;
  turnRest(body, 1);
  beginSubstep(body);
  double mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    mass += body.mass[i];
    centre += body.mass[i] * body.worldPosition(i);
  }
  centre /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    const Eigen::Vector3d arm = body.worldPosition(i) - centre;
    inertia += (body.mass[i] * arm.squaredNorm() + body.inertia[i]) * Eigen::Matrix3d::Identity() -
               body.mass[i] * arm * arm.transpose();
  }
  const Eigen::Vector3d spin = inertia.ldlt().solve(angularMomentum);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    const Eigen::Vector3d v = velocity + spin.cross(body.worldPosition(i) - centre);
    body.velocity[i] = v.template cast<Real>();
    body.spin[i] = spin.template cast<Real>();
  }
  bookHost({}, motionOf(body, books.centre), books);
}

template void park(Body<float>&, Books&);
template void park(Body<double>&, Books&);
template void placeParked(Body<float>&, const Eigen::Isometry3d&);
template void placeParked(Body<double>&, const Eigen::Isometry3d&);
template void unpark(Body<float>&, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);
template void unpark(Body<double>&, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);

}  // namespace rubble::edem
