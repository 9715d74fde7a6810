#include "edem/frozen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace rubble::edem {
namespace {

// Of the elements that are awake at most one in so many: a body that stands in the air as a whole tells
// nothing. A block of 64 elements that a rod of a million times their mass shatters at 300 m/s needs 14.
constexpr std::uint32_t kFrozenOf = 4;

}  // namespace

template <class Real>
bool freezeElements(World<Real>& w, double shortest) {
  std::uint32_t awake = 0;
  for (const auto& body : w.bodies)
    if (!body->state.asleep) awake += std::uint32_t(body->work.awake.size());
  std::vector<typename StepLength<Real>::Place> frozen;
  const auto isLong = [&] {
    w.stepLength.bound(w.bodies, w.lists, w.rigid);
    return w.def.substepSafety * w.stepLength.stable() >= shortest;
  };
  bool isStable = isLong();
  const double needed = w.def.substepSafety * w.stepLength.stable();
  // Twice as many each time: looking at all elements for each would take minutes of a large world.
  for (std::size_t count = 1; !isStable; isStable = isLong(), count *= 2) {
    const auto next = w.stepLength.stiffestElements(w.bodies, count);
    const std::size_t most = awake / kFrozenOf, held = w.report.frozen + frozen.size();
    if (next.empty() || held >= most) {
      for (const auto& place : frozen) w.bodies[place.body]->work.frozen[place.element] = 0;
      return false;
    }
    for (const auto& place : std::span(next).first(std::min(most - held, next.size()))) {
      w.bodies[place.body]->work.frozen[place.element] = 1;
      frozen.push_back(place);
    }
  }
  if (frozen.empty()) return true;
  w.report.frozen += std::uint32_t(frozen.size());
  char text[200];
  std::snprintf(text, sizeof text,
                "%sbody %u: element %u and %zu others need a substep of %.3g s, which is %.0f in 1/60 s; "
                "maxSubstepsPerFrame is %d: they stand still until the tick ends",
                w.report.warning.empty() ? "" : "; ", w.bodies[frozen.front().body]->id,
                frozen.front().element, frozen.size() - 1, needed, std::ceil(1.0 / 60 / needed),
                w.def.maxSubstepsPerFrame);
  w.report.warning += text;
  return true;
}

template <class Real>
void thawElements(World<Real>& w) {
  if (std::exchange(w.report.frozen, 0) == 0) return;
  for (auto& body : w.bodies) std::fill(body->work.frozen.begin(), body->work.frozen.end(), std::uint8_t(0));
}

// In the books' sense of energy, m/2 v(n-1/2) . v(n+1/2): what the instant before had, with the first half of
// what forces have done since.
template <class Real>
void stop(Body<Real>& body, std::uint32_t i, const Vec3<Real>& velocityBefore, const Vec3<Real>& spinBefore,
          Books& books) {
  const double mass = body.constants->mass[i], inertia = body.constants->inertia[i];
  const Eigen::Vector3d momentum = mass * body.state.velocity[i].template cast<double>(),
                        turning = inertia * body.state.spin[i].template cast<double>();
  books.slept += 0.5 * (momentum.dot(velocityBefore.template cast<double>()) +
                        turning.dot(spinBefore.template cast<double>()));
  books.sleptLinear += momentum;
  books.sleptAngular += (body.state.origin + body.work.position[i] - books.centre).cross(momentum) + turning;
  body.state.velocity[i].setZero();
  body.state.velocityCarry[i].setZero();
  body.state.spin[i].setZero();
}

template bool freezeElements(World<float>&, double);
template bool freezeElements(World<double>&, double);
template void thawElements(World<float>&);
template void thawElements(World<double>&);
template void stop(Body<float>&, std::uint32_t, const Vec3<float>&, const Vec3<float>&, Books&);
template void stop(Body<double>&, std::uint32_t, const Vec3<double>&, const Vec3<double>&, Books&);

}  // namespace rubble::edem
