#include "edem/parking.h"

#include <algorithm>
#include <cassert>

#include "edem/body_books.h"
#include "edem/frames.h"
#include "edem/rigid_motion.h"
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
    if (!body.state.alive[i]) continue;
    const Eigen::Vector3d v = body.state.velocity[i].template cast<double>(),
                          w = body.state.spin[i].template cast<double>();
    all.linear += body.constants->mass[i] * v;
    all.angular +=
        (body.worldPosition(i) - about).cross(body.constants->mass[i] * v) + body.constants->inertia[i] * w;
    all.kinetic +=
        0.5 * (body.constants->mass[i] * v.squaredNorm() + body.constants->inertia[i] * w.squaredNorm());
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

// Where the asset's frame is.
template <class Real>
Eigen::Isometry3d placeOf(const Body<Real>& body) {
  // The frame's origin is the centre of mass, asset axes: that of the rest positions.
  const Eigen::Vector3d centre = body.constants->asset->positions[0] - body.constants->restCentred[0];
  const Frame& frame = body.state.frames.back();
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = frame.turn.toRotationMatrix();
  place.translation() = frame.origin - frame.turn * centre;
  return place;
}

// Cracked pairs touch in that shape without force: it may not push itself apart later.
template <class Real>
void closeCracks(Body<Real>& body) {
  for (std::size_t s = 0; s < body.constants->anchorBegin; ++s) {
    if (body.state.intact[s]) continue;
    const Spring<Real>& spring = body.state.springs[s];
    const double apart = (body.work.position[spring.second] - body.work.position[spring.first]).norm();
    body.state.range[s] = std::min(body.state.range[s], Real(apart));
  }
}

// A free body's shape is that of the asset. What an anchor holds has the sag in which it was first parked;
// with cracks, which have moved its balance, the one that it has.
template <class Real>
void takeShape(Body<Real>& body) {
  if (body.state.anchorsIntact > 0 && body.state.parkedAt.empty()) {
    body.state.parkedAt = body.state.displacement;
    body.state.parkedTurn = body.state.rotation;
  } else if (body.state.anchorsIntact > 0 && body.state.brokenCount == 0) {
    body.state.displacement = body.state.parkedAt;
    body.state.rotation = body.state.parkedTurn;
  } else if (body.state.anchorsIntact == 0) {
    for (Vec3<Real>& u : body.state.displacement) u.setZero();
    for (Quat<Real>& q : body.state.rotation) q.setIdentity();
  }
  beginSubstep(body.state, body.work);
  closeCracks(body);
}

}  // namespace

template <class Real>
bool mayPark(const Body<Real>& body) {
  const std::size_t anchors = body.state.springs.size() - body.constants->anchorBegin;
  return !body.state.asleep && body.state.fragmentCount == 1 && body.state.crushedCount == 0 &&
         body.state.absentElements == 0 && body.state.anchorsIntact == anchors;
}

template <class Real>
ParkedMotion park(Body<Real>& body, Books& books) {
  assert(!body.state.asleep && mayPark(body));
  const Motion before = motionOf(body, books.centre);
  const double elastic = elasticOf(body);
  takeShape(body);
  body.state.sleepingElastic = elasticOf(body);
  body.state.sleepingMass = massOf(body);
  ParkedMotion out;
  out.place = placeOf(body);
  Motion whole = before;
  whole.kinetic = 0;
  if (body.state.anchorsIntact == 0) {
    const RigidMotion rest = rigidMotions(body).begin()->second;
    out.velocity = before.linear / rest.mass;
    out.angularMomentum = before.angular - (rest.centre - books.centre).cross(before.linear);
    whole.kinetic = 0.5 * (before.linear.dot(out.velocity) +
                           out.angularMomentum.dot(rest.inertia.ldlt().solve(out.angularMomentum)));
  }
  books.massDamped += before.kinetic - whole.kinetic + elastic - body.state.sleepingElastic;
  books.kinetic += whole.kinetic - before.kinetic;
  books.elastic += body.state.sleepingElastic - elastic;
  if (body.state.anchorsIntact == 0) {
    bookHost(whole, {}, books);
  } else {
    books.anchors.push(1, -before.linear, Eigen::Vector3d::Zero(), -before.angular);
    books.linear -= before.linear;
    books.angular -= before.angular;
  }
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.state.velocity[i].setZero();
    body.state.velocityCarry[i].setZero();
    body.state.spin[i].setZero();
  }
  body.state.asleep = body.state.parked = true;
  return out;
}

template <class Real>
void placeParked(Body<Real>& body, const Eigen::Isometry3d& place) {
  assert(body.state.parked && body.state.frames.size() <= 2);
  if (body.state.frames.size() < 2) return;
  // The frame's origin is the centre of mass, asset axes: that of the rest positions.
  const Eigen::Vector3d centre = body.constants->asset->positions[0] - body.constants->restCentred[0];
  body.state.frames[1] = {place * centre, Eigen::Quaterniond(place.linear()).normalized()};
}

template <class Real>
void unpark(Body<Real>& body, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angularMomentum,
            Books& books) {
  assert(body.state.parked);
  body.state.asleep = body.state.parked = false;
  turnRest(body, 1);
  beginSubstep(body.state, body.work);
  const RigidMotion whole = rigidMotions(body).begin()->second;
  const Eigen::Vector3d spin = whole.inertia.ldlt().solve(angularMomentum);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    const Eigen::Vector3d v = velocity + spin.cross(body.worldPosition(i) - whole.centre);
    body.state.velocity[i] = v.template cast<Real>();
    body.state.spin[i] = spin.template cast<Real>();
  }
  bookHost({}, motionOf(body, books.centre), books);
}

template bool mayPark(const Body<float>&);
template bool mayPark(const Body<double>&);
template ParkedMotion park(Body<float>&, Books&);
template ParkedMotion park(Body<double>&, Books&);
template void placeParked(Body<float>&, const Eigen::Isometry3d&);
template void placeParked(Body<double>&, const Eigen::Isometry3d&);
template void unpark(Body<float>&, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);
template void unpark(Body<double>&, const Eigen::Vector3d&, const Eigen::Vector3d&, Books&);

}  // namespace rubble::edem
