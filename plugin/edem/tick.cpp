#include "edem/tick.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stopwatch.h"
#include "edem/anchor_ride.h"
#include "edem/body_queries.h"
#include "edem/damping.h"
#include "edem/fragment_motion.h"
#include "edem/frames.h"
#include "edem/frozen.h"
#include "edem/host_moves.h"
#include "edem/sleep.h"
#include "edem/tick_step.h"

namespace rubble::edem {
namespace {

// Skin of the candidate lists in radii: half of it is what an element may move before a new listing.
constexpr double kSkinRadii = 0.5;
// A rigid body is light beside an element of which it has less than this share.
constexpr double kLight = 1e-3;

// Of the elements of all bodies; infinite where there are none [m].
template <class Real>
double smallestRadius(const World<Real>& w) {
  double radius = std::numeric_limits<double>::infinity();
  for (const auto& body : w.bodies) radius = std::min(radius, double(body->constants->radius));
  return radius;
}

// Rigid bodies that are lighter than this are so beside every element; 0 where there are none [kg].
template <class Real>
double lightBody(const World<Real>& w) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const auto& body : w.bodies) lightest = std::min(lightest, body->constants->lightest);
  return std::isfinite(lightest) ? kLight * lightest : 0;
}

// `left`: of the tick [s].
template <class Real>
void list(World<Real>& w, double left) {
  const base::ScopeTimer timer(w.report.listing);
  w.lists.build(w.bodies, w.bodies.empty() ? 0 : kSkinRadii * smallestRadius(w));
  wakeDisturbed(w);
  w.rigid.build(w.bodies, w.lists);
  findDrifts(std::span<const std::unique_ptr<Body<Real>>>(w.bodies), w.rigid.proxies(), w.lists.skin(), left,
             w.drifts);
  w.listsStale = false;
}

// Lists anew what is out of date; true if anything was.
template <class Real>
bool refreshLists(World<Real>& w, double left) {
  const bool expired = !w.listsStale && w.rigid.expired(w.lists.skin(), w.drifts.proxies);
  if (w.listsStale || (expired && w.drifts.any())) {
    list(w, left);
  } else if (expired) {
    w.rigid.build(w.bodies, w.lists);
  } else {
    return false;
  }
  return true;
}

// What has broken free parts from what it hits as itself, not when the tick is over: restitution would depend
// on the tick.
template <class Real>
void refreshFragments(World<Real>& w) {
  for (auto& body : w.bodies) {
    if (body->state.asleep || body->state.labelledBroken == body->state.brokenCount) continue;
    labelFragments(*body);
    beginMotions(*body);
  }
}

// More contacts began at an element than the step was chosen for.
template <class Real>
bool contactsBegan(const World<Real>& w) {
  return std::any_of(w.bodies.begin(), w.bodies.end(), [](const auto& body) {
    const auto& awake = body->work.awake;
    return !body->state.asleep && std::any_of(awake.begin(), awake.end(), [&](std::uint32_t i) {
      return body->work.touchesBegun[i] > 1;
    });
  });
}

template <class Real>
std::string spoiledText(const Body<Real>& body, int substep) {
  const std::string end = " in substep " + std::to_string(substep) +
                          " of its tick; lower substepSafety, or look for units other than metres, seconds, "
                          "kilograms";
  const std::string head = "body " + std::to_string(body.id) + ": ";
  std::uint32_t fastest = body.work.awake.front();
  for (const std::uint32_t i : body.work.awake) {
    if (!body.state.alive[i]) continue;
    if (!(body.state.displacement[i].allFinite() && body.state.velocity[i].allFinite() &&
          body.state.spin[i].allFinite() && body.state.rotation[i].coeffs().allFinite()))
      return head + "the state of its elements is not finite, first that of " + std::to_string(i) + end;
    if (body.state.velocity[i].squaredNorm() > body.state.velocity[fastest].squaredNorm()) fastest = i;
  }
  return head + "its elements move or turn faster than light, the fastest of them " +
         std::to_string(fastest) + end;
}

template <class Real>
void substep(World<Real>& w, double kick, double step, const Eigen::Vector3d& gravity) {
  w.books.closeStep();
  w.books.elastic = w.parkedElastic;
  for (auto& body : w.bodies)
    w.books.elastic += body->state.asleep
                           ? body->state.sleepingElastic
                           : accumulateSprings(*body, body->work, kick, w.def.breaking, w.books);
  for (PairList<Real>& l : w.lists.lists()) {
    Body<Real>&a = *w.bodies[l.first], &b = *w.bodies[l.second];
    if (!a.state.asleep || !b.state.asleep)
      accumulateContacts(l, a, b, {w.lastStep, step}, w.resting, w.books);
    w.books.elastic += l.elastic;
  }
  for (auto& body : w.bodies)
    if (!body->state.asleep) addHostLoads(*body, kick, w.books);
  w.rigid.accumulate(w.bodies, {w.lastStep, step}, kick, w.resting, w.books);
  w.resting.settle();
  w.books.elastic += w.rigid.elastic();

  const std::size_t brokenBegin = w.report.broken.size();
  bool anyCrushed = false;
  for (auto& body : w.bodies) {
    if (body->state.asleep || !w.def.crushing || !w.def.breaking) continue;
    markCrushed(*body, body->work);
    anyCrushed = anyCrushed || !body->work.crushing.empty();
  }
  if (anyCrushed) {
    for (PairList<Real>& l : w.lists.lists())
      releaseContacts(l, *w.bodies[l.first], *w.bodies[l.second], step, kick, w.resting, w.books);
    w.rigid.release(w.bodies, kick, w.books);
  }
  for (std::uint32_t b = 0; b < w.bodies.size(); ++b)
    if (!w.bodies[b]->state.asleep) applyBreaks(*w.bodies[b], b, kick, w.lists, w.books, w.report);
  if (w.report.broken.size() > brokenBegin) w.rigid.expose(w.bodies, step, kick, w.resting, w.books);

  w.drifts.advance(step);
  w.books.mass = w.parkedMass;
  w.books.kinetic = 0;
  w.books.linear = w.books.angular = Eigen::Vector3d::Zero();
  for (std::uint32_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (body.state.asleep) {
      w.books.mass += body.state.sleepingMass;
      continue;
    }
    const Eigen::Vector3d fall = body.state.gravity.value_or(gravity);
    const Real moved2 =
        integrate(body, kick, step, fall, std::span<const Vec3<double>>(w.lists.grid(b).listed),
                  w.drifts.bodies[b].moved, w.books);
    bookHostLoads(body, kick, w.books);
    if (!std::isfinite(moved2)) w.failure = spoiledText(body, w.report.substeps);
    if (body.state.easeDamping > 0 && body.state.brokenCount == body.state.easeBroken)
      dampDeformation(body, body.state.easeDamping, kick, w.books);
    moveMotions(body, kick, step, fall);
    w.listsStale = w.listsStale || !(moved2 <= Real(0.25 * w.lists.skin() * w.lists.skin()));
  }
  for (auto& body : w.bodies)
    if (isRiding(*body)) pullRide(*body, kick, w.rigid, w.books);
  w.rigid.integrate(w.bodies, kick, step, w.books);
  for (auto& body : w.bodies) {
    if (isRiding(*body))
      goWithRide(*body, w.rigid.proxies());
    else if (!body->state.asleep)
      moveBase(*body, kick, step, w.books);
  }
  for (auto& body : w.bodies)
    if (!body->work.crushing.empty()) removeCrushed(*body, brokenBegin, w.books, w.report);
}

// What moves with its base is not slow, however slowly that goes. And what a dynamic one carries is its load
// until both sleep, which is the host's decision.
template <class Real>
void staysAwake(Body<Real>& body) {
  const bool moves = body.state.base.moves() || body.state.base.ride.moves();
  if (!moves && !body.state.base.ride.on()) return;
  for (const std::uint32_t i : body.work.awake) {
    if (body.state.frameOf[i] != 0) continue;
    body.state.calmTime[i] = 0;
    if (moves) body.state.slowTime[i] = 0;
  }
}

template <class Real>
void closeTick(World<Real>& w, double dt) {
  for (auto& body : w.bodies) {
    const bool broke = std::any_of(w.report.broken.begin(), w.report.broken.end(),
                                   [&](const BrokenSpring& s) { return s.body == body->id; });
    if (body->state.asleep || !broke) continue;
    labelFragments(*body);
    splitFrames(*body);
    listAwake(*body);
  }
  for (auto& body : w.bodies) body->state.hostLoads.clear();
  for (auto& body : w.bodies)
    if (!body->state.asleep) staysAwake(*body);
  settle(w, dt);
  for (auto& body : w.bodies)
    if (isRiding(*body)) endRide(*body, w.rigid, w.books);
  for (auto& body : w.bodies) {
    if (body->state.asleep) continue;
    fitFrames(*body);
    followBase(*body);
  }
  putToSleep(w, dt);
}

}  // namespace

// A tick reads top to bottom. The host applies proxies' impulses and handles the crushed
// afterwards.
template <class Real>
void tick(World<Real>& w, double dt, const Eigen::Vector3d& gravity, std::span<RigidProxy> proxies) {
  w.report.broken.clear();
  w.report.crushed.clear();
  w.report.substeps = 0;
  w.report.listing = w.report.kicked = 0;
  thawElements(w);
  w.report.warning.clear();
  if (!std::isfinite(dt)) w.failure = "the time step is not finite";
  if (!w.failure.empty() || !(dt > 0)) return;
  w.rigid.beginTick(proxies, smallestRadius(w), lightBody(w));
  w.resting.beginTick(gravity);
  w.stepLength.beginTick(w.bodies);
  hardenContacts(w);
  if (std::exchange(w.gravity, gravity) != gravity) wakeAll(w);
  for (auto& body : w.bodies)
    if (body->state.base.given && !beginRide(*body, w.rigid.proxies()))
      beginWay(body->state.base, body->state.frames[0], dt);
  for (auto& body : w.bodies)
    if (!body->state.asleep || body->work.motions.empty()) beginMotions(*body);
  w.listsStale = true;
  double left = dt, step = dt;
  int substeps = 0;
  while (left > 0 && w.failure.empty()) {
    for (auto& body : w.bodies)
      if (!body->state.asleep) beginSubstep(body->state, body->work);
    bool listed = refreshLists(w, left);
    if (wakeTouched(w)) {
      list(w, left);
      listed = true;
    }
    if (listed) refreshFragments(w);
    if (listed || contactsBegan(w) || w.rigid.blowGrew()) {
      // What is near has changed: the rest of the tick in equal steps that are short enough for it.
      const double longest = substeps == 0 ? longestStep(w, dt) : std::min(step, longestStep(w, dt));
      if (!w.failure.empty()) break;
      step = left / std::ceil(left / longest * (1 - 1e-9));
    }
    // Between steps of two lengths the half steps are their mean apart.
    const double kick = w.lastStep > 0 ? 0.5 * (w.lastStep + step) : step;
    substep(w, kick, step, gravity);
    w.lastStep = step;
    w.report.kicked += kick;
    w.report.substeps = ++substeps;
    left = left - step > 0.5 * step ? left - step : 0;
  }
  w.report.substep = step;
  closeTick(w, dt);
  // Where all lies still a step is as long as its tick. Who wakes did not move through half of that.
  if (std::ranges::none_of(w.bodies,
                           [](const auto& b) { return !b->state.asleep && !b->work.awake.empty(); }))
    w.lastStep = 0;
}

template void tick(World<float>&, double, const Eigen::Vector3d&, std::span<RigidProxy>);
template void tick(World<double>&, double, const Eigen::Vector3d&, std::span<RigidProxy>);

}  // namespace rubble::edem
