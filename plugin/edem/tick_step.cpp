#include "edem/tick_step.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "edem/body_queries.h"
#include "edem/frozen.h"

namespace rubble::edem {
namespace {

// An element may not pass more than this share of its radius in a substep, or thin things are missed. Nor a
// sphere more than this share of what it is near is thick: the force turns round at its middle, and the
// moment of that is known to half a substep.
constexpr double kTravelShare = 0.25;

// Contacts that need a shorter substep than is allowed are made softer, down to this share.
constexpr double kSoftest = 0.01;
// Softer than just enough, for springs have a part in the bound.
constexpr double kSoftEnough = 0.9;

template <class Real>
double stableStep(World<Real>& w) {
  w.stepLength.bound(w.bodies, w.lists, w.rigid);
  return std::min(w.def.substepSafety * w.stepLength.stable(), w.stepLength.resolving());
}

template <class Real>
void setShare(World<Real>& w, double share) {
  w.contactShare = share;
  w.lists.soften(w.bodies, share);
  w.rigid.setShare(share);
}

// Makes contacts softer until a substep of `shortest` is stable, as penalty contacts of explicit codes are
// whose stiffness follows the step, or as soft as is allowed. What their springs held more is lost. Returns
// the stable step then [s].
template <class Real>
double softenContacts(World<Real>& w, double stable, double shortest) {
  const double before = w.contactShare, energy = w.lists.elasticAwake() + w.rigid.elasticAwake();
  double soft = stable;
  while (soft < shortest && w.contactShare > kSoftest) {
    // All their rates go with it, frequencies with its root.
    setShare(w, std::max(kSoftest, w.contactShare * kSoftEnough * soft * soft / (shortest * shortest)));
    soft = stableStep(w);
  }
  if (w.contactShare == before) return soft;
  w.books.dissipated.add(-(1 - w.contactShare / before) * energy, 0);
  char text[200];
  std::snprintf(text, sizeof text,
                "body %u: its contacts would need a substep of %.3g s, which is %.0f substeps in 1/60 s; "
                "maxSubstepsPerFrame is %d: all contacts have %.2g of their stiffness until they part",
                w.bodies[w.stepLength.stiffest()]->id, stable, std::ceil(1.0 / 60 / stable),
                w.def.maxSubstepsPerFrame, w.contactShare);
  w.report.warning = text;
  return soft;
}

}  // namespace

template <class Real>
void hardenContacts(World<Real>& w) {
  if (!(w.contactShare < 1)) return;
  double energy = w.rigid.elastic();
  for (const PairList<Real>& l : w.lists.lists()) energy += l.elastic;
  if (!(energy > 0)) setShare(w, 1);
}

// Longest safe step of a tick of `dt` as things are now [s]; a tick that would need too many fails.
template <class Real>
double longestStep(World<Real>& w, double dt) {
  const double shortest = 1.0 / 60 / w.def.maxSubstepsPerFrame * (1 - 1e-9);
  double stable = stableStep(w);
  const double asked = stable;
  if (stable < shortest) stable = softenContacts(w, stable, shortest);
  if (stable < shortest && freezeElements(w, shortest)) stable = shortest;
  double speed = 0, radius = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < w.bodies.size(); ++b) {
    const Body<Real>& body = *w.bodies[b];
    if (body.state.asleep) continue;
    speed = std::max(speed, speedOf(body, w.drifts.bodies[b].velocity));
    radius = std::min(radius, double(body.constants->radius));
  }
  const double pass = w.rigid.shortestPass(w.bodies, w.drifts.proxies, speed);
  speed = std::max(speed, w.rigid.maxSpeed(w.drifts.proxies));
  const bool travels = speed > 0 && std::isfinite(radius);
  const double travel =
      kTravelShare * std::min(pass, travels ? radius / speed : std::numeric_limits<double>::infinity());
  // A drift is that of the instant: what falls leaves it, and would be deep in what it meets by the next
  // step.
  const double way = kTravelShare * radius;
  double fall = w.gravity.norm();
  for (const auto& body : w.bodies)
    if (body->state.gravity) fall = std::max(fall, body->state.gravity->norm());
  const double falls = fall > 0 ? 2 * way / (speed + std::sqrt(speed * speed + 4 * fall * way))
                                : std::numeric_limits<double>::infinity();
  char text[200];
  if (stable < shortest) {
    std::snprintf(text, sizeof text,
                  "body %u: its contacts%s need a substep of %.3g s, which is %.0f substeps in 1/60 s; "
                  "maxSubstepsPerFrame is %d: raise it",
                  w.bodies[w.stepLength.stiffest()]->id,
                  w.bodies[w.stepLength.stiffest()]->state.base.ride.on() ? " or a light anchorBody" : "",
                  asked, std::ceil(1.0 / 60 / asked), w.def.maxSubstepsPerFrame);
    w.failure = text;
  } else if (travel < shortest) {
    std::snprintf(text, sizeof text,
                  "something moves at %.3g m/s, more than maxSubstepsPerFrame %d can follow: contacts may "
                  "be missed",
                  speed, w.def.maxSubstepsPerFrame);
    w.report.warning = text;
    return std::min({dt, stable, shortest});
  }
  // A blow on all that is near is followed as well as the substeps allow: it may be on less.
  const double blow = blowStep(w.rigid.blowFrequency2(w.bodies, w.drifts.proxies));
  return std::min({dt, stable, travel, std::max(falls, shortest), std::max(blow, shortest)});
}

template void hardenContacts(World<float>&);
template void hardenContacts(World<double>&);
template double longestStep(World<float>&, double);
template double longestStep(World<double>&, double);

}  // namespace rubble::edem
