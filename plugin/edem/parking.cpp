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

// Where the asset's frame is.
template <class Real>
Eigen::Isometry3d placeOf(const Body<Real>& body) {
  // The frame's origin is the centre of mass, asset axes: that of the rest positions.
  const Eigen::Vector3d centre = body.asset->positions[0] - body.restCentred[0];
  const Frame& frame = body.frames.back();
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = frame.turn.toRotationMatrix();
  place.translation() = frame.origin - frame.turn * centre;
  return place;
}

// Cracked pairs touch in that shape without force: it may not push itself apart later.
template <class Real>
void closeCracks(Body<Real>& body) {
  for (std::size_t s = 0; s < body.anchorBegin; ++s) {
    if (body.intact[s]) continue;
    const Spring<Real>& spring = body.springs[s];
    const double apart = (body.position[spring.second] - body.position[spring.first]).norm();
    body.range[s] = std::min(body.range[s], Real(apart));
  }
}

// A free body's shape is that of the asset. What an anchor holds has the sag in which it was first parked;
// with cracks, which have moved its balance, the one that it has.
template <class Real>
void takeShape(Body<Real>& body) {
  if (body.anchorsIntact > 0 && body.parkedAt.empty()) {
    body.parkedAt = body.displacement;
    body.parkedTurn = body.rotation;
  } else if (body.anchorsIntact > 0 && body.brokenCount == 0) {
    body.displacement = body.parkedAt;
    body.rotation = body.parkedTurn;
  } else if (body.anchorsIntact == 0) {
    for (Vec3<Real>& u : body.displacement) u.setZero();
    for (Quat<Real>& q : body.rotation) q.setIdentity();
  }
  beginSubstep(body);
  closeCracks(body);
}

}  // namespace

template <class Real>
bool mayPark(const Body<Real>& body) {
  const std::size_t anchors = body.springs.size() - body.anchorBegin;
  return !body.asleep && body.fragmentCount == 1 && body.crushedCount == 0 && body.anchorsIntact == anchors;
}

template <class Real>
ParkedMotion park(Body<Real>& body, Books& books) {
  assert(!body.asleep && mayPark(body));
  const Motion before = motionOf(body, books.centre);
  const double elastic = elasticOf(body);
  takeShape(body);
  body.sleepingElastic = elasticOf(body);
  ParkedMotion out;
  out.place = placeOf(body);
  Motion whole = before;
  whole.kinetic = 0;
  if (body.anchorsIntact == 0) {
    const RigidMotion rest = rigidMotions(body).begin()->second;
    out.velocity = before.linear / rest.mass;
    out.angularMomentum = before.angular - (rest.centre - books.centre).cross(before.linear);
    whole.kinetic = 0.5 * (before.linear.dot(out.velocity) +
                           out.angularMomentum.dot(rest.inertia.ldlt().solve(out.angularMomentum)));
  }
  books.massDamped += before.kinetic - whole.kinetic + elastic - body.sleepingElastic;
  books.kinetic += whole.kinetic - before.kinetic;
  books.elastic += body.sleepingElastic - elastic;
  if (body.anchorsIntact == 0) {
    bookHost(whole, {}, books);
  } else {
    books.anchors.push(1, -before.linear, Eigen::Vector3d::Zero(), -before.angular);
    books.linear -= before.linear;
    books.angular -= before.angular;
  }
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    body.velocity[i].setZero();
    body.velocityCarry[i].setZero();
    body.spin[i].setZero();
  }
  body.asleep = body.parked = true;
  return out;
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
  const RigidMotion whole = rigidMotions(body).begin()->second;
  const Eigen::Vector3d spin = whole.inertia.ldlt().solve(angularMomentum);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    const Eigen::Vector3d v = velocity + spin.cross(body.worldPosition(i) - whole.centre);
    body.velocity[i] = v.template cast<Real>();
    body.spin[i] = spin.template cast<Real>();
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
