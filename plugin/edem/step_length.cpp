#include "edem/step_length.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>
#include <utility>

#include "edem/anchor_ride.h"
#include "rubble/error.h"

namespace rubble::edem {
namespace {

// Step over 1 / omega of a lone contact: a blow then takes nine steps.
constexpr double kContactPhase = 0.35;
// A body in contact needs a substep shorter than alone: by up to a quarter in a cube on the ground and in a
// wall that a ball breaks.
constexpr double kContactsShorten = 1.5;

template <class Real>
ElementRates ratesOf(const ContactLaw<double>& law, const Body<Real>& body, std::uint32_t i) {
  return contactRates(law, 1 / body.constants->mass[i], 1 / body.constants->inertia[i],
                      double(body.constants->radius));
}

void operator+=(ElementRates& a, const ElementRates& b) {
  a.stiffness += b.stiffness;
  a.damping += b.damping;
}

}  // namespace

template <class Real>
void StepLength<Real>::beginTick(std::span<const std::unique_ptr<Body<Real>>> bodies) {
  m_springs.resize(bodies.size());
  m_rates.resize(bodies.size());
  m_next.resize(bodies.size());
  m_sleepers.resize(bodies.size(), kNoPair);
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const Body<Real>& body = *bodies[b];
    if (body.state.asleep) {
      // What sleeps with all of its body has no rates, in any tick.
      if (std::exchange(m_sleepers[b], body.id) == body.id && m_rates[b].size() == body.elementCount())
        continue;
      m_rates[b].assign(body.elementCount(), {});
      continue;
    }
    m_sleepers[b] = kNoPair;
    m_springs[b].assign(body.elementCount(), {});
    awakeSpringRates(body, std::span(m_springs[b]));
  }
}

double blowStep(double frequency2) {
  return frequency2 > 0 ? kContactPhase / std::sqrt(frequency2) : std::numeric_limits<double>::infinity();
}

template <class Real>
double StepLength<Real>::resolving() const {
  return blowStep(m_contact2);
}

template <class Real>
void StepLength<Real>::addContact(std::uint32_t place, std::uint32_t i, const ElementRates& one,
                                  bool touching) {
  if (touching) {
    m_rates[place][i] += one;
    return;
  }
  ElementRates& next = m_next[place][i];
  next.stiffness = std::max(next.stiffness, one.stiffness);
  next.damping = std::max(next.damping, one.damping);
}

template <class Real>
void StepLength<Real>::add(std::uint32_t place, const ElementRates& a, const ElementRates& b) {
  const double before = m_bound.frequency2;
  m_bound.add(a, b);
  if (m_bound.frequency2 > before) m_stiffest = place;
}

template <class Real>
void StepLength<Real>::weighRides(std::span<const std::unique_ptr<Body<Real>>> bodies,
                                  const RigidContacts<Real>& rigid) {
  m_rides.assign(rigid.proxies().size(), {});
  for (const auto& body : bodies)
    if (isRiding(*body) && body->state.base.ride.moves()) {
      const std::uint32_t p = body->state.base.ride.place;
      m_rides[p] += rideRates(*body, rigid.proxies()[p]);
    }
}

template <class Real>
void StepLength<Real>::addRides(std::span<const std::unique_ptr<Body<Real>>> bodies,
                                const RigidContacts<Real>& rigid) {
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const Body<Real>& body = *bodies[b];
    if (!isRiding(body) || !body.state.base.ride.moves()) continue;
    const std::uint32_t p = body.state.base.ride.place;
    ElementRates all = rigid.proxyRates(p);
    all += m_rides[p];
    for (const std::uint32_t s : body.work.awakeSprings)
      if (body.isAnchor(s) && body.state.intact[s]) add(b, m_rates[b][body.state.springs[s].first], all);
  }
}

template <class Real>
void StepLength<Real>::bound(std::span<const std::unique_ptr<Body<Real>>> bodies,
                             const PairLists<Real>& lists, RigidContacts<Real>& rigid) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b]->state.asleep) continue;
    m_rates[b] = m_springs[b];
    m_next[b].assign(m_rates[b].size(), {});
  }
  m_bound = {};
  m_contact2 = 0;
  m_stiffest = 0;
  weighRides(bodies, rigid);
  for (const PairList<Real>& l : lists.lists()) {
    const Body<Real>&a = *bodies[l.first], &b = *bodies[l.second];
    const ContactLaw<double> law = l.law.template cast<double>();
    for (const std::uint32_t k : l.awake) {
      const PairEntry& e = l.entries[k];
      m_contact2 = std::max(
          m_contact2, law.stiffness * (1 / a.constants->mass[e.first] + 1 / b.constants->mass[e.second]));
      if (!a.state.asleep) addContact(l.first, e.first, ratesOf(law, a, e.first), e.touching);
      if (!b.state.asleep) addContact(l.second, e.second, ratesOf(law, b, e.second), e.touching);
    }
  }
  rigid.weigh(bodies);
  rigid.visitRates(bodies, [&](std::uint32_t place, std::uint32_t i, const ElementRates& rates, bool touching,
                               double frequency2) {
    addContact(place, i, rates, touching);
    m_contact2 = std::max(m_contact2, frequency2);
  });
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b]->state.asleep) continue;
    bodies[b]->work.touchesBegun.assign(bodies[b]->elementCount(), 0);
    for (std::size_t i = 0; i < m_rates[b].size(); ++i) {
      m_rates[b][i] += m_next[b][i];
      if (bodies[b]->work.frozen[i]) m_rates[b][i] = {};  // nothing moves it
    }
  }
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const Body<Real>& body = *bodies[b];
    if (body.state.asleep) continue;
    const std::vector<ElementRates>& rates = m_rates[b];
    for (const std::uint32_t s : body.work.awakeSprings) {
      const Spring<Real>& spring = body.state.springs[s];
      if (!body.state.intact[s]) continue;
      add(b, rates[spring.first], body.isAnchor(s) ? ElementRates{} : rates[spring.second]);
    }
    for (const std::uint32_t i : body.work.awake)
      if (body.state.alive[i]) add(b, rates[i], {});
  }
  for (const PairList<Real>& l : lists.lists()) {
    for (const std::uint32_t k : l.awake) {
      const PairEntry& e = l.entries[k];
      add(l.first, m_rates[l.first][e.first], m_rates[l.second][e.second]);
    }
  }
  // What moves at a rigid body moves it too: light ones are made softer where they would need a step much
  // shorter than the elements'.
  rigid.soften(m_bound.frequency2);
  rigid.visitProxyRates(
      [&](std::uint32_t place, std::uint32_t i, std::uint32_t p, const ElementRates& proxy) {
        ElementRates all = proxy;
        all += m_rides[p];
        add(place, m_rates[place][i], all);
      });
  addRides(bodies, rigid);
}

template <class Real>
std::vector<typename StepLength<Real>::Place> StepLength<Real>::stiffestElements(
    std::span<const std::unique_ptr<Body<Real>>> bodies, std::size_t count) const {
  std::vector<Place> found;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b]->state.asleep) continue;
    for (const std::uint32_t i : bodies[b]->work.awake) {
      if (!bodies[b]->state.alive[i]) continue;
      RateBound bound;
      bound.add(m_rates[b][i], {});
      const double step = bound.stableStep();
      if (std::isfinite(step)) found.push_back({b, i, step});
    }
  }
  count = std::min(count, found.size());
  std::partial_sort(found.begin(), found.begin() + std::ptrdiff_t(count), found.end(),
                    [](const Place& a, const Place& b) {
                      return std::tie(a.step, a.body, a.element) < std::tie(b.step, b.body, b.element);
                    });
  found.resize(count);
  return found;
}

template <class Real>
void requireStep(const Body<Real>& body, const Material& material, double step, const SolverDef& def) {
  const double substeps = std::ceil(1.0 / 60 / step);
  if (substeps <= def.maxSubstepsPerFrame) return;
  const double lightest = *std::min_element(body.constants->mass.begin(), body.constants->mass.end());
  const double resolving = kContactPhase / std::sqrt(2 * body.constants->contact.stiffness / lightest);
  const double enough = std::ceil(1.0 / 60 / std::min(step / kContactsShorten, resolving));
  // Every frequency goes with sqrt(E); rounded down by more than the text rounds.
  const double share = def.maxSubstepsPerFrame / enough;
  const double soft = 0.99 * material.youngsModulus * share * share;
  char text[320];
  std::snprintf(text, sizeof text,
                "material %s: stable substep is %.3g s, which is %.0f substeps in 1/60 s; "
                "maxSubstepsPerFrame is %d: %.0f would do, for contacts too, or a youngsModulus of %.3g Pa, "
                "or larger elements",
                material.name.c_str(), step, substeps, def.maxSubstepsPerFrame, enough, soft);
  throw Error(text);
}

template void requireStep(const Body<float>&, const Material&, double, const SolverDef&);
template void requireStep(const Body<double>&, const Material&, double, const SolverDef&);
template class StepLength<float>;
template class StepLength<double>;

}  // namespace rubble::edem
