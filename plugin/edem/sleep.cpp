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
      if (a.asleep || b.asleep) continue;
      for (const PairEntry& e : list.entries)
        if (e.touching && a.alive[e.first] && b.alive[e.second] && bool(a.sleeping[e.first]) == sleeping &&
            bool(b.sleeping[e.second]) == sleeping)
          m_groups.join(m_first[list.first] + a.fragment[e.first],
                        m_first[list.second] + b.fragment[e.second]);
    }
  }
  std::uint32_t of(const World<Real>& w, const Place& p) {
    return m_groups.of(m_first[p.body] + w.bodies[p.body]->fragment[p.element]);
  }
  std::size_t count() const { return m_first.back(); }

 private:
  std::vector<std::uint32_t> m_first;  // of each body
  base::Groups m_groups;
};

template <class Real>
double energyAsleep(const Body<Real>& body) {
  double energy = 0;
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const Spring<Real>& spring = body.springs[s];
    if (!body.intact[s] || !body.sleeping[spring.first]) continue;
    const SpringLoad<Real> load = springLoad(spring, body.end(spring.first), secondEnd(body, s));
    energy += double(load.stretchEnergy + load.rotationEnergy);
  }
  return energy;
}

template <class Real>
void recount(Body<Real>& body) {
  body.sleepingCount = std::uint32_t(std::count(body.sleeping.begin(), body.sleeping.end(), 1));
  body.energyAsleep = body.sleepingCount > 0 ? energyAsleep(body) : 0;
  body.massAsleep = 0;
  for (std::uint32_t i = 0; body.sleepingCount > 0 && i < body.elementCount(); ++i)
    if (body.alive[i] && body.sleeping[i]) body.massAsleep += body.mass[i];
  listAwake(body);
}

template <class Real>
bool anySleeping(const World<Real>& w) {
  return std::any_of(w.bodies.begin(), w.bodies.end(), [](const auto& b) { return b->sleepingCount > 0; });
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
    if (body.sleepingCount == 0) continue;
    const std::uint32_t before = body.sleepingCount;
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
      if (!body.sleeping[i] || !wakes[islands.of(w, {b, i})]) continue;
      body.sleeping[i] = 0;
      body.calmTime[i] = 0;
    }
    recount(body);
    if (body.sleepingCount < before) beginMotions(body);
  }
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
  const Real free = a.radius + b.radius;
  const Real distance = Real(((b.position[e.second] - a.position[e.first]) + offset).norm());
  const bool own = e.pair != kNoPair;
  Real& range = own ? a.range[e.pair] : list.memory[k].range;
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
  return double(body.velocity[i].norm()) + double(body.radius) * double(body.spin[i].norm());
}

// Which fragments, by their lowest elements, have been slower than `speed` for longer than `time`; `since` is
// how long each element has.
template <class Real>
std::vector<std::uint8_t> slowFragments(const Body<Real>& body, double speed, double time, double dt,
                                        std::vector<float>& since) {
  std::vector<std::uint8_t> slow(body.elementCount(), 1);
  for (const std::uint32_t i : body.awake) {
    if (!body.alive[i]) continue;
    since[i] = fastestOf(body, i) < speed ? since[i] + float(dt) : 0;
    if (!(double(since[i]) > time)) slow[body.fragment[i]] = 0;
  }
  return slow;
}

// What swings is as fast again in half a period at most; what topples is only ever faster.
template <class Real>
void followSwings(Body<Real>& body) {
  for (const std::uint32_t i : body.awake) {
    const float speed = float(fastestOf(body, i));
    if (!(body.slowTime[i] > 0)) body.slowPeak[i] = 0;
    if (speed > body.slowPeak[i]) {
      body.slowPeak[i] = speed;
      body.slowTurned[i] = 0;
    } else if (speed < 0.5f * body.slowPeak[i]) {
      body.slowTurned[i] = 1;
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
    if (body.asleep) continue;
    slow[b].assign(body.elementCount(), 0);
    if (def.settleSpeed > 0)
      slow[b] = slowFragments(body, def.settleSpeed, def.settleTime, dt, body.slowTime);
    std::vector<double> rates(body.elementCount(), body.massDamping);
    bool any = body.massDamping > 0;
    for (const std::uint32_t i : body.awake) {
      if (!body.alive[i]) continue;
      if (slow[b][i]) rates[i] = std::max(rates[i], def.settleRate);
      any = any || (body.fragment[i] != i && slow[b][body.fragment[i]]);  // a single one has no deformation
    }
    if (any) dampDeformation(body, std::span<const double>(rates), dt, w.books);
  }
  if (!(def.settleSpeed > 0) || !(w.gravity.norm() * def.settleTime > def.settleSpeed)) return;
  for (std::size_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (body.asleep) continue;
    followSwings(body);
    for (const std::uint32_t i : body.awake) {
      if (!body.alive[i]) continue;
      if (double(body.slowPeak[i]) > def.sleepSpeed && !body.slowTurned[i]) slow[b][body.fragment[i]] = 0;
    }
  }
  w.rigid.visitAtMoving([&](std::uint32_t b, std::uint32_t i) {
    if (w.bodies[b]->alive[i]) slow[b][w.bodies[b]->fragment[i]] = 0;
  });
  const double share = -std::expm1(-def.brakeRate * dt);
  for (std::size_t b = 0; b < w.bodies.size(); ++b) {
    Body<Real>& body = *w.bodies[b];
    if (body.asleep) continue;
    for (const std::uint32_t i : body.awake)
      if (body.alive[i] && slow[b][body.fragment[i]]) brake(body, i, share, w.books);
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
      if (body.asleep) continue;
      for (const std::uint32_t i : body.awake)
        if (body.alive[i]) f(Place{b, i});
    }
  };
  for (std::uint32_t b = 0; b < w.bodies.size(); ++b)
    if (!w.bodies[b]->asleep)
      calm[b] = slowFragments(*w.bodies[b], w.def.sleepSpeed, w.def.sleepTime, dt, w.bodies[b]->calmTime);
  visit([&](const Place& p) { any = any || calm[p.body][w.bodies[p.body]->fragment[p.element]]; });
  if (!any) return;

  Islands<Real> islands(w);
  islands.join(w, false);
  std::vector<std::uint8_t> restless(islands.count(), 0);
  visit([&](const Place& p) {
    if (!calm[p.body][w.bodies[p.body]->fragment[p.element]]) restless[islands.of(w, p)] = 1;
  });
  w.rigid.visitAtMoving([&](std::uint32_t body, std::uint32_t element) {
    if (w.bodies[body]->alive[element]) restless[islands.of(w, {body, element})] = 1;
  });
  std::vector<std::uint8_t> fell(w.bodies.size(), 0);
  visit([&](const Place& p) {
    if (restless[islands.of(w, p)]) return;
    Body<Real>& body = *w.bodies[p.body];
    brake(body, p.element, 1, w.books);
    body.sleeping[p.element] = 1;
    fell[p.body] = 1;
  });
  for (std::size_t b = 0; b < fell.size(); ++b) {
    if (!fell[b]) continue;
    beginSubstep(*w.bodies[b]);  // for the last time of what sleeps now: where it is, without forces
    recount(*w.bodies[b]);
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
    if (a.sleepingCount + b.sleepingCount == 0 || (a.asleep && b.asleep)) continue;
    const Vec3<double> offset = b.origin - a.origin;
    for (std::size_t k = 0; k < list.entries.size(); ++k) {
      const PairEntry& e = list.entries[k];
      // What sleeps with all of its body bears what lies on it.
      const bool first = a.asleep || a.sleeping[e.first], second = b.asleep || b.sleeping[e.second];
      if (first == second || !a.alive[e.first] || !b.alive[e.second]) continue;
      if (!(first ? a.sleeping[e.first] : b.sleeping[e.second])) continue;
      if (!comesAt(list, k, offset, a, b)) continue;
      places.push_back(a.sleeping[e.first] ? Place{list.first, e.first} : Place{list.second, e.second});
    }
  }
  return wake(w, places);
}

template <class Real>
void wakeElement(World<Real>& w, std::uint32_t body, std::uint32_t element) {
  if (w.bodies[body]->sleeping[element]) wake(w, {Place{body, element}});
}

template <class Real>
void wakeNeighbours(World<Real>& w, std::uint32_t body) {
  std::vector<Place> places;
  for (const PairList<Real>& list : w.lists.lists()) {
    if ((list.first == body) == (list.second == body)) continue;
    for (const PairEntry& e : list.entries) {
      const Place other = list.first == body ? Place{list.second, e.second} : Place{list.first, e.first};
      if (e.touching && w.bodies[other.body]->sleeping[other.element]) places.push_back(other);
    }
  }
  wake(w, places);
}

template <class Real>
void wakeAll(World<Real>& w) {
  if (!anySleeping(w)) return;
  for (auto& body : w.bodies) forgetSleep(*body);
  w.stepLength.beginTick(w.bodies);
  w.listsStale = true;
}

template <class Real>
void forgetSleep(Body<Real>& body) {
  std::fill(body.sleeping.begin(), body.sleeping.end(), std::uint8_t(0));
  std::fill(body.calmTime.begin(), body.calmTime.end(), 0.0f);
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
