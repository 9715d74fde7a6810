#include "edem/sleep.h"

#include <algorithm>
#include <cmath>

#include "base/groups.h"
#include "edem/damping.h"
#include "edem/fragment_motion.h"

namespace rubble::edem {
namespace {

// An element by the place of its body.
struct Place {
  std::uint32_t body, element;
};

// Islands of fragments. A fragment stands for itself by its lowest element.
template <class Real>
class Islands {
 public:
  explicit Islands(const World<Real>& w) : m_first(w.bodies.size() + 1, 0), m_groups(0) {
    for (std::size_t b = 0; b < w.bodies.size(); ++b)
      m_first[b + 1] = m_first[b] + std::uint32_t(w.bodies[b]->elementCount());
    m_groups = base::Groups(m_first.back());
  }
  // Joins the fragments of touching elements that both are as asleep as wanted.
  void join(const World<Real>& w, bool sleeping) {
    for (const PairList<Real>& list : w.lists.lists()) {
      const Body<Real>&a = *w.bodies[list.first], &b = *w.bodies[list.second];
      if (a.state.asleep || b.state.asleep) continue;
      for (const PairEntry& e : list.entries)
        if (e.touching && a.state.alive[e.first] && b.state.alive[e.second] &&
            bool(a.state.sleeping[e.first]) == sleeping && bool(b.state.sleeping[e.second]) == sleeping)
          m_groups.join(m_first[list.first] + a.state.fragment[e.first],
                        m_first[list.second] + b.state.fragment[e.second]);
    }
  }
  std::uint32_t of(const World<Real>& w, const Place& p) {
    return m_groups.of(m_first[p.body] + w.bodies[p.body]->state.fragment[p.element]);
  }
  std::size_t count() const { return m_first.back(); }

 private:
  std::vector<std::uint32_t> m_first;  // of each body
  base::Groups m_groups;
};

template <class Real>
double energyAsleep(const Body<Real>& body) {
  double energy = 0;
  for (std::size_t s = 0; s < body.state.springs.size(); ++s) {
    const Spring<Real>& spring = body.state.springs[s];
    if (!body.state.intact[s] || !body.state.sleeping[spring.first]) continue;
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    energy += double(load.stretchEnergy + load.rotationEnergy);
  }
  return energy;
}

template <class Real>
void recount(Body<Real>& body) {
  ++body.state.sleepChanges;
  body.state.sleepingCount =
      std::uint32_t(std::count(body.state.sleeping.begin(), body.state.sleeping.end(), 1));
  body.state.energyAsleep = body.state.sleepingCount > 0 ? energyAsleep(body) : 0;
  body.state.massAsleep = 0;
  for (std::uint32_t i = 0; body.state.sleepingCount > 0 && i < body.elementCount(); ++i)
    if (body.state.alive[i] && body.state.sleeping[i]) body.state.massAsleep += body.constants->mass[i];
  listAwake(body);
}

template <class Real>
bool anySleeping(const World<Real>& w) {
  return std::any_of(w.bodies.begin(), w.bodies.end(),
                     [](const auto& b) { return b->state.sleepingCount > 0; });
}

template <class Real>
bool wake(World<Real>& w, const std::vector<Place>& places) {
  if (places.empty()) return false;
  Islands<Real> islands(w);
  islands.join(w, true);
  std::vector<std::uint8_t> wakes(islands.count(), 0);
  for (const Place& p : places) wakes[islands.of(w, p)] = 1;
  for (std::uint32_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (body.state.sleepingCount == 0) continue;
    const std::uint32_t before = body.state.sleepingCount;
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
      if (!body.state.sleeping[i] || !wakes[islands.of(w, {b, i})]) continue;
      body.state.sleeping[i] = 0;
      body.state.calmTime[i] = 0;
    }
    recount(body);
    if (body.state.sleepingCount < before) beginMotions(body);
  }
  w.lists.listAwake(w.bodies);
  w.stepLength.beginTick(w.bodies);
  w.listsStale = true;
  return true;
}

// Of a pair of which one sleeps: whether they would touch, were both awake. Its range follows the distance
// meanwhile, as it does when they are.
template <class Real>
bool comesAt(PairList<Real>& list, std::size_t k, const Vec3<double>& offset, Body<Real>& a,
             const Body<Real>& b) {
  const PairEntry& e = list.entries[k];
  const Real free = a.constants->radius + b.constants->radius;
  const Real distance = Real(((b.work.position[e.second] - a.work.position[e.first]) + offset).norm());
  const bool own = e.pair != kNoPair;
  Real& range = own ? a.state.range[e.pair] : list.memory[k].range;
  if (distance >= free) {
    range = own ? free : Real(0);
    return false;
  }
  if (!own && !(range > Real(0))) return true;
  range = std::fmin(std::fmax(range, distance), free);
  return range > distance;
}

// Of an element's centre, and of its surface by spin [m/s].
template <class Real>
double fastestOf(const Body<Real>& body, std::size_t i) {
  return double(body.state.velocity[i].norm()) +
         double(body.constants->radius) * double(body.state.spin[i].norm());
}

// Which fragments, by their lowest elements, have been slower than `speed` for longer than `time`; `since` is
// how long each element has.
template <class Real>
std::vector<std::uint8_t> slowFragments(const Body<Real>& body, double speed, double time, double dt,
                                        std::vector<float>& since) {
  std::vector<std::uint8_t> slow(body.elementCount(), 1);
  for (const std::uint32_t i : body.work.awake) {
    if (!body.state.alive[i]) continue;
    since[i] = fastestOf(body, i) < speed ? since[i] + float(dt) : 0;
    if (!(double(since[i]) > time)) slow[body.state.fragment[i]] = 0;
  }
  return slow;
}

// What swings is as fast again in half a period at most; what topples is only ever faster.
template <class Real>
void followSwings(Body<Real>& body) {
  for (const std::uint32_t i : body.work.awake) {
    const float speed = float(fastestOf(body, i));
    if (!(body.state.slowTime[i] > 0)) body.state.slowPeak[i] = 0;
    if (speed > body.state.slowPeak[i]) {
      body.state.slowPeak[i] = speed;
      body.state.slowTurned[i] = 0;
    } else if (speed < 0.5f * body.state.slowPeak[i]) {
      body.state.slowTurned[i] = 1;
    }
  }
}

}  // namespace

template <class Real>
void settle(World<Real>& w, double dt) {
  const SolverDef& def = w.def;
  std::vector<std::vector<std::uint8_t>> slow(w.bodies.size());
  for (std::size_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (body.state.asleep) continue;
    slow[b].assign(body.elementCount(), 0);
    if (def.settleSpeed > 0)
      slow[b] = slowFragments(body, def.settleSpeed, def.settleTime, dt, body.state.slowTime);
    std::vector<double> rates(body.elementCount(), body.constants->massDamping);
    bool any = body.constants->massDamping > 0;
    for (const std::uint32_t i : body.work.awake) {
      if (!body.state.alive[i]) continue;
      if (slow[b][i]) rates[i] = std::max(rates[i], def.settleRate);
      any = any || (body.state.fragment[i] != i &&
                    slow[b][body.state.fragment[i]]);  // a single one has no deformation
    }
    if (any) dampDeformation(body, std::span<const double>(rates), dt, w.books);
  }
  if (!(def.settleSpeed > 0)) return;
  // What does not fall is borne by nothing.
  const auto mayRest = [&](const Body<Real>& body) {
    const double fall = body.state.gravity.value_or(w.gravity).norm();
    return !body.state.asleep && fall * def.settleTime > def.settleSpeed;
  };
  if (!std::ranges::any_of(w.bodies, [&](const auto& body) { return mayRest(*body); })) return;
  for (std::size_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (!mayRest(body)) continue;
    followSwings(body);
    for (const std::uint32_t i : body.work.awake) {
      if (!body.state.alive[i]) continue;
      if (double(body.state.slowPeak[i]) > def.sleepSpeed && !body.state.slowTurned[i])
        slow[b][body.state.fragment[i]] = 0;
    }
  }
  w.rigid.visitAtMoving([&](std::uint32_t b, std::uint32_t i) {
    if (w.bodies[b]->state.alive[i]) slow[b][w.bodies[b]->state.fragment[i]] = 0;
  });
  const double share = -std::expm1(-def.brakeRate * dt);
  for (std::size_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (!mayRest(body)) continue;
    for (const std::uint32_t i : body.work.awake)
      if (body.state.alive[i] && slow[b][body.state.fragment[i]]) brake(body, i, share, w.books);
  }
}

template <class Real>
void putToSleep(World<Real>& w, double dt) {
  if (!(w.def.sleepSpeed > 0) || !w.failure.empty()) return;
  std::vector<std::vector<std::uint8_t>> calm(w.bodies.size());
  bool any = false;
  const auto visit = [&w](auto&& f) {
    for (std::uint32_t b = 0; b < w.bodies.size(); ++b) {
      const Body<Real>& body = *w.bodies[b];
      if (body.state.asleep) continue;
      for (const std::uint32_t i : body.work.awake)
        if (body.state.alive[i]) f(Place{b, i});
    }
  };
  for (std::uint32_t b = 0; b < w.bodies.size(); ++b)
    if (!w.bodies[b]->state.asleep)
      calm[b] =
          slowFragments(*w.bodies[b], w.def.sleepSpeed, w.def.sleepTime, dt, w.bodies[b]->state.calmTime);
  visit([&](const Place& p) { any = any || calm[p.body][w.bodies[p.body]->state.fragment[p.element]]; });
  if (!any) return;

  Islands<Real> islands(w);
  islands.join(w, false);
  std::vector<std::uint8_t> restless(islands.count(), 0);
  visit([&](const Place& p) {
    if (!calm[p.body][w.bodies[p.body]->state.fragment[p.element]]) restless[islands.of(w, p)] = 1;
  });
  w.rigid.visitAtMoving([&](std::uint32_t body, std::uint32_t element) {
    if (w.bodies[body]->state.alive[element]) restless[islands.of(w, {body, element})] = 1;
  });
  std::vector<std::uint8_t> fell(w.bodies.size(), 0);
  visit([&](const Place& p) {
    if (restless[islands.of(w, p)]) return;
    Body<Real>& body = *w.bodies[p.body];
    brake(body, p.element, 1, w.books);
    body.state.sleeping[p.element] = 1;
    fell[p.body] = 1;
  });
  for (std::size_t b = 0; b < fell.size(); ++b) {
    if (!fell[b]) continue;
    Body<Real>& body = *w.bodies[b];
    beginSubstep(body.state, body.work);  // for the last time of what sleeps now: where it is, without forces
    recount(body);
  }
}

template <class Real>
void wakeDisturbed(World<Real>& w) {
  if (!anySleeping(w)) return;
  std::vector<Place> places;
  w.rigid.visitDisturbed(w.bodies, w.lists, [&](std::uint32_t body, std::uint32_t element) {
    places.push_back({body, element});
  });
  wake(w, places);
}

template <class Real>
bool wakeTouched(World<Real>& w) {
  if (!anySleeping(w)) return false;
  std::vector<Place> places;
  for (PairList<Real>& list : w.lists.lists()) {
    Body<Real>&a = *w.bodies[list.first], &b = *w.bodies[list.second];
    if (a.state.sleepingCount + b.state.sleepingCount == 0 || (a.state.asleep && b.state.asleep)) continue;
    const Vec3<double> offset = b.state.origin - a.state.origin;
    for (const std::uint32_t k : list.awake) {
      const PairEntry& e = list.entries[k];
      // What sleeps with all of its body bears what lies on it.
      const bool first = a.state.asleep || a.state.sleeping[e.first],
                 second = b.state.asleep || b.state.sleeping[e.second];
      if (first == second || !a.state.alive[e.first] || !b.state.alive[e.second]) continue;
      if (!(first ? a.state.sleeping[e.first] : b.state.sleeping[e.second])) continue;
      if (!comesAt(list, k, offset, a, b)) continue;
      places.push_back(a.state.sleeping[e.first] ? Place{list.first, e.first} : Place{list.second, e.second});
    }
  }
  return wake(w, places);
}

template <class Real>
void wakeElement(World<Real>& w, std::uint32_t body, std::uint32_t element) {
  if (w.bodies[body]->state.sleeping[element]) wake(w, {Place{body, element}});
}

template <class Real>
void wakeNeighbours(World<Real>& w, std::uint32_t body) {
  std::vector<Place> places;
  for (const PairList<Real>& list : w.lists.lists()) {
    if ((list.first == body) == (list.second == body)) continue;
    for (const PairEntry& e : list.entries) {
      const Place other = list.first == body ? Place{list.second, e.second} : Place{list.first, e.first};
      if (e.touching && w.bodies[other.body]->state.sleeping[other.element]) places.push_back(other);
    }
  }
  wake(w, places);
}

template <class Real>
void wakeAll(World<Real>& w) {
  if (!anySleeping(w)) return;
  for (auto& body : w.bodies) forgetSleep(*body);
  w.lists.listAwake(w.bodies);
  w.stepLength.beginTick(w.bodies);
  w.listsStale = true;
}

template <class Real>
void forgetSleep(Body<Real>& body) {
  std::fill(body.state.sleeping.begin(), body.state.sleeping.end(), std::uint8_t(0));
  std::fill(body.state.calmTime.begin(), body.state.calmTime.end(), 0.0f);
  recount(body);
}

template void settle(World<float>&, double);
template void settle(World<double>&, double);
template void putToSleep(World<float>&, double);
template void putToSleep(World<double>&, double);
template void wakeDisturbed(World<float>&);
template void wakeDisturbed(World<double>&);
template bool wakeTouched(World<float>&);
template bool wakeTouched(World<double>&);
template void wakeElement(World<float>&, std::uint32_t, std::uint32_t);
template void wakeElement(World<double>&, std::uint32_t, std::uint32_t);
template void wakeNeighbours(World<float>&, std::uint32_t);
template void wakeNeighbours(World<double>&, std::uint32_t);
template void wakeAll(World<float>&);
template void wakeAll(World<double>&);
template void forgetSleep(Body<float>&);
template void forgetSleep(Body<double>&);

}  // namespace rubble::edem
