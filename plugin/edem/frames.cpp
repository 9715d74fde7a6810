#include "edem/frames.h"

#include <span>
#include <utility>
#include <vector>

namespace rubble::edem {
namespace {

// How one frame moves.
struct Fit {
  double mass = 0;
  Eigen::Vector4d rotation = Eigen::Vector4d::Zero();  // sum of mass x quaternion
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     // of the origin [m]
  Eigen::Quaterniond step = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d turnedBack = Eigen::Matrix3d::Zero();  // old turn - new turn

  void add(double m, const Eigen::Quaterniond& q) {
    mass += m;
    rotation += (q.w() < 0 ? -m : m) * q.coeffs();
  }
  void turn(Eigen::Quaterniond& turn) {
    // Elements that have no common rotation only take the frame along.
    if (!(rotation.norm() > 1e-3 * mass)) return;
    step = Eigen::Quaterniond(Eigen::Vector4d(rotation.normalized()));
    const Eigen::Matrix3d old = turn.toRotationMatrix();
    turn = (step * turn).normalized();
    turnedBack = old - turn.toRotationMatrix();
  }
};

// Visits the elements whose frame moves: those of fragments that sleep would only be rounded.
template <class Real, class Visit>
void visitMoving(const Body<Real>& body, Visit&& visit) {
  for (const std::uint32_t i : body.work.awake)
    if (body.state.alive[i] && body.state.frameOf[i] > 0) visit(i, body.state.frameOf[i]);
}

template <class Real>
void putInFrame0(Body<Real>& body, std::size_t i, const Frame& was) {
  const Frame& frame0 = body.state.frames[0];
  const Eigen::Vector3d rest = frame0.turn * body.constants->restCentred[i];
  const Eigen::Vector3d u =
      was.turn * body.constants->restCentred[i] + body.state.displacement[i].template cast<double>();
  const Eigen::Quaterniond q =
      body.state.rotation[i].template cast<double>() * was.turn * frame0.turn.conjugate();
  body.state.displacement[i] = (was.origin - frame0.origin + (u - rest)).template cast<Real>();
  body.state.rotation[i] = Quat<Real>(q.template cast<Real>());
  body.work.rest[i] = frame0.origin - body.state.origin + rest;
  body.state.frameOf[i] = 0;
}

template <class Real>
std::vector<Eigen::Matrix3d> turnsOf(const Body<Real>& body) {
  std::vector<Eigen::Matrix3d> turns;
  for (const Frame& frame : body.state.frames) turns.push_back(frame.turn.toRotationMatrix());
  return turns;
}

template <class Real>
void turnElement(Body<Real>& body, std::size_t i, std::span<const Eigen::Matrix3d> turns) {
  const std::uint32_t f = body.state.frameOf[i];
  body.work.rest[i] =
      body.state.frames[f].origin - body.state.origin + turns[f] * body.constants->restCentred[i];
}

template <class Real>
void turnSpring(Body<Real>& body, std::size_t s, std::span<const Eigen::Matrix3d> turns) {
  Spring<Real>& spring = body.state.springs[s];
  const Eigen::Matrix3d& turn = turns[body.state.frameOf[spring.first]];
  spring.rest = (turn * body.constants->springRest[s]).template cast<Real>();
  spring.offset = (turn * body.constants->springOffset[s]).template cast<Real>();
}

}  // namespace

template <class Real>
void turnRest(Body<Real>& body, std::size_t first) {
  const std::vector<Eigen::Matrix3d> turns = turnsOf(body);
  for (std::size_t i = 0; i < body.elementCount(); ++i)
    if (body.state.frameOf[i] >= first) turnElement(body, i, turns);
  for (std::size_t s = 0; s < body.state.springs.size(); ++s)
    if (body.state.intact[s] && body.state.frameOf[body.state.springs[s].first] >= first)
      turnSpring(body, s, turns);
}

template <class Real>
void splitFrames(Body<Real>& body) {
  std::vector<std::uint8_t> held(body.elementCount(), 0);  // by fragment
  for (std::size_t s = body.constants->anchorBegin; s < body.state.springs.size(); ++s)
    if (body.state.intact[s]) held[body.state.fragment[body.state.springs[s].first]] = 1;
  const std::vector<Frame> old = std::move(body.state.frames);
  body.state.frames = {old[0]};
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    const std::uint32_t root = body.state.fragment[i];  // not above i: its frame is there
    const Frame& was = old[body.state.frameOf[i]];
    if (root == kNoElement || held[root]) {
      if (body.state.frameOf[i] > 0) putInFrame0(body, i, was);
    } else if (root == i) {
      body.state.frameOf[i] = std::uint32_t(body.state.frames.size());
      body.state.frames.push_back(was);
    } else {
      body.state.frameOf[i] = body.state.frameOf[root];
    }
  }
}

template <class Real>
void fitFrames(Body<Real>& body) {
  if (body.state.frames.size() == 1) return;
  std::vector<Fit> fits(body.state.frames.size());
  visitMoving(body, [&](std::size_t i, std::uint32_t f) {
    fits[f].add(body.constants->mass[i], Eigen::Quaterniond(body.state.rotation[i].template cast<double>()));
  });
  for (std::size_t f = 1; f < fits.size(); ++f) fits[f].turn(body.state.frames[f].turn);
  visitMoving(body, [&](std::size_t i, std::uint32_t f) {
    const Eigen::Vector3d u = body.state.displacement[i].template cast<double>();
    fits[f].shift +=
        body.constants->mass[i] / fits[f].mass * (u + fits[f].turnedBack * body.constants->restCentred[i]);
  });
  for (std::size_t f = 1; f < fits.size(); ++f) body.state.frames[f].origin += fits[f].shift;
  visitMoving(body, [&](std::size_t i, std::uint32_t f) {
    const Fit& fit = fits[f];
    const Eigen::Vector3d u = body.state.displacement[i].template cast<double>();
    body.state.displacement[i] =
        (u - fit.shift + fit.turnedBack * body.constants->restCentred[i]).template cast<Real>();
    const Eigen::Quaterniond q = body.state.rotation[i].template cast<double>() * fit.step.conjugate();
    body.state.rotation[i] = Quat<Real>(q.normalized().template cast<Real>());
  });
  const std::vector<Eigen::Matrix3d> turns = turnsOf(body);
  visitMoving(body, [&](std::size_t i, std::uint32_t) { turnElement(body, i, turns); });
  for (const std::uint32_t s : body.work.awakeSprings)
    if (body.state.intact[s] && body.state.frameOf[body.state.springs[s].first] > 0)
      turnSpring(body, s, turns);
}

template <class Real>
void followBase(Body<Real>& body) {
  if (!body.state.base.given) return;
  endWay(body.state.base);
  const Frame old = std::exchange(body.state.frames[0], body.state.base.at);
  const Frame& now = body.state.frames[0];
  writeFarEnds(body);
  const bool turns = !(old.turn.coeffs() == now.turn.coeffs());
  if (!turns && old.origin == now.origin) return;
  const Eigen::Vector3d shift = old.origin - now.origin;
  const Eigen::Matrix3d turnedBack = old.turn.toRotationMatrix() - now.turn.toRotationMatrix();
  const Eigen::Quaterniond back = old.turn * now.turn.conjugate();
  const std::vector<Eigen::Matrix3d> matrices = turnsOf(body);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (body.state.frameOf[i] != 0 || !body.state.alive[i]) continue;
    const Eigen::Vector3d u = body.state.displacement[i].template cast<double>();
    body.state.displacement[i] =
        (u + (shift + turnedBack * body.constants->restCentred[i])).template cast<Real>();
    if (turns)
      body.state.rotation[i] = Quat<Real>(
          (body.state.rotation[i].template cast<double>() * back).normalized().template cast<Real>());
    turnElement(body, i, matrices);
  }
  for (std::size_t s = 0; turns && s < body.state.springs.size(); ++s)
    if (body.state.intact[s] && body.state.frameOf[body.state.springs[s].first] == 0)
      turnSpring(body, s, matrices);
}

template <class Real>
void moveFrame0(Body<Real>& body, const Frame& to) {
  const Frame old = std::exchange(body.state.frames[0], to);
  body.state.base.at = to;
  writeFarEnds(body);
  const bool turns = !(old.turn.coeffs() == to.turn.coeffs());
  const Quat<Real> around = (to.turn * old.turn.conjugate()).normalized().template cast<Real>();
  const std::vector<Eigen::Matrix3d> matrices = turnsOf(body);
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (body.state.frameOf[i] != 0) continue;
    if (turns) {
      Vec3<Real>& u = body.state.displacement[i];
      u += turned(around, u);
      Quat<Real>& q = body.state.rotation[i];
      q = (around * q * around.conjugate()).normalized();
    }
    turnElement(body, i, matrices);
  }
  for (std::size_t s = 0; turns && s < body.state.springs.size(); ++s)
    if (body.state.intact[s] && body.state.frameOf[body.state.springs[s].first] == 0)
      turnSpring(body, s, matrices);
}

template <class Real>
void writeFarEnds(Body<Real>& body) {
  const AnchorBase& base = body.state.base;
  const Frame& frame0 = body.state.frames[0];
  FarEnds<Real>& far = body.state.farEnds;
  far.shift = (base.at.origin - frame0.origin).template cast<Real>();
  far.turn = Quat<Real>::Identity();
  if (!(base.at.turn.coeffs() == frame0.turn.coeffs()))
    far.turn = (base.at.turn * frame0.turn.conjugate()).normalized().template cast<Real>();
  far.velocity = base.velocity.linear.template cast<Real>();
  far.spin = base.velocity.angular.template cast<Real>();
}

template void turnRest(Body<float>&, std::size_t);
template void turnRest(Body<double>&, std::size_t);
template void splitFrames(Body<float>&);
template void splitFrames(Body<double>&);
template void fitFrames(Body<float>&);
template void fitFrames(Body<double>&);
template void followBase(Body<float>&);
template void followBase(Body<double>&);
template void moveFrame0(Body<float>&, const Frame&);
template void moveFrame0(Body<double>&, const Frame&);
template void writeFarEnds(Body<float>&);
template void writeFarEnds(Body<double>&);

}  // namespace rubble::edem
