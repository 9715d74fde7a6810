#include "edem/anchor_base.h"

#include <algorithm>
#include <cassert>

namespace rubble::edem {
namespace {

Eigen::Vector3d rotationFrom(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::AngleAxisd way(to * from.conjugate());
  return way.angle() * way.axis();
}

Eigen::Quaterniond turnedBy(const Eigen::Vector3d& rotation, const Eigen::Quaterniond& from) {
  const double angle = rotation.norm();
  if (!(angle > 0)) return from;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) * from).normalized();
}

// What is the next tick's start, as if the acceleration went on; no more than as much again, or what has
// stopped would go on.
Eigen::Vector3d endRate(const Eigen::Vector3d& now, const Eigen::Vector3d& before) {
  const Eigen::Vector3d gained = 0.5 * (now - before);
  const double most = now.norm(), size = gained.norm();
  return size > most ? Eigen::Vector3d(now + most / size * gained) : Eigen::Vector3d(now + gained);
}

// Cubic of Hermite from 0, at the share s of the tick.
Eigen::Vector3d cubic(double s, double length, const Eigen::Vector3d& way, const Eigen::Vector3d& start,
                      const Eigen::Vector3d& end) {
  const double rest = 1 - s;
  return s * s * (3 - 2 * s) * way + length * s * rest * (rest * start - s * end);
}

}  // namespace

void beginWay(AnchorBase& base, const Frame& frame0, double dt) {
  assert(dt > 0);
  base.begin = base.at = frame0;
  const Frame target = base.target.value_or(frame0);
  base.target.reset();
  base.way = {target.origin - frame0.origin, Eigen::Vector3d::Zero()};
  if (!(target.turn.coeffs() == frame0.turn.coeffs()))
    base.way.angular = rotationFrom(frame0.turn, target.turn);
  base.start = base.end;
  const Twist mean = {base.way.linear / dt, base.way.angular / dt};
  base.end = {endRate(mean.linear, base.mean.linear), endRate(mean.angular, base.mean.angular)};
  base.mean = mean;
  base.length = dt;
  base.time = 0;
}

void advance(AnchorBase& base, double step) {
  assert(step > 0 && base.length > 0);
  base.time += step;
  if (!base.moves()) {
    base.velocity = {};
    return;
  }
  const double s = std::min(base.time / base.length, 1.0);
  const Frame was = base.at;
  const auto at = [&](Eigen::Vector3d Twist::*part) {
    return cubic(s, base.length, base.way.*part, base.start.*part, base.end.*part);
  };
  base.at = {base.begin.origin + at(&Twist::linear), turnedBy(at(&Twist::angular), base.begin.turn)};
  base.velocity = {(base.at.origin - was.origin) / step, rotationFrom(was.turn, base.at.turn) / step};
}

void endWay(AnchorBase& base) {
  base.at = {base.begin.origin + base.way.linear, turnedBy(base.way.angular, base.begin.turn)};
}

}  // namespace rubble::edem
