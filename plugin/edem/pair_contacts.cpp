// The contacts of elements with elements (paper 3.1.2).
#include <cassert>
#include <cmath>
#include <utility>

#include "edem/fragment_motion.h"
#include "edem/stages.h"

namespace rubble::edem {
namespace {

constexpr std::size_t kNoRest = ~std::size_t(0);

template <class Real>
LoadedThing thingOf(const Body<Real>& body, std::uint32_t i, const RestingLoads& resting) {
  return {fragmentName(body.id, body.state.fragment[i]), body.work.motions[body.work.motionOf[i]].inverseMass,
          body.state.gravity.value_or(resting.gravity())};
}

// One touching pair. Loads on the second element.
template <class Real>
struct PairTouch {
  bool touches = false;
  ContactLoad<Real> load;
  Vec3<Real> armFirst, armSecond;  // centre -> contact point [m]
  Eigen::Vector3d at;              // contact point, world [m]
  Eigen::Vector3d full;            // on the second of that pair, before any is withheld [N]
  bool turned = false;             // that pair is of the second and the first
  Real power = 0;                  // of the elastic loads [W]
  std::size_t resting = kNoRest;   // place among the resting loads
  Real lost = 0;                   // by a pair that has parted [J]
};

// Contact distance D of a pair, law 2: own to joined pairs and to pairs overlapping at rest, and growing with
// their distance. Pairs that are free of each other touch at the sum of their radii; those first seen deep in
// each other where they are.
template <class Real>
Real& contactDistance(const PairEntry& entry, Body<Real>& a, const Body<Real>& b, Real distance, Real speed,
                      Real moved, ContactMemory<Real>& memory) {
  const Real free = a.constants->radius + b.constants->radius;
  Real& range = entry.pair == kNoPair ? memory.range : a.state.range[entry.pair];
  range = entry.pair == kNoPair ? contactRange(range, distance, free, speed, moved)
                                : std::fmin(std::fmax(range, distance), free);
  return range;
}

// What elements of two fragments withhold of their force where they touch, see withheld.
template <class Real>
Real withheldBetween(const ContactLaw<Real>& law, const Body<Real>& a, std::uint32_t i, const Body<Real>& b,
                     std::uint32_t j, const Vec3<Real>& normal, double step, RestingLoads& resting,
                     PairTouch<Real>& touch) {
  const FragmentMotion &first = a.work.motions[a.work.motionOf[i]],
                       &second = b.work.motions[b.work.motionOf[j]];
  if (&first == &second) return 0;
  const double parting =
      (second.velocityAt(touch.at) - first.velocityAt(touch.at)).dot(normal.template cast<double>());
  const LoadedThing thingA = thingOf(a, i, resting), thingB = thingOf(b, j, resting);
  touch.turned = thingB.name < thingA.name;
  touch.resting = touch.turned ? resting.pairOf(thingB, thingA) : resting.pairOf(thingA, thingB);
  const double jolt = step * (first.pressed * first.inverseMass + second.pressed * second.inverseMass);
  return Real(withheld(double(law.inelastic), parting, jolt, resting.share(touch.resting)));
}

template <class Real>
PairTouch<Real> touchPair(const PairList<Real>& list, std::size_t k, const Vec3<double>& offset,
                          Body<Real>& a, Body<Real>& b, const Steps& steps, RestingLoads& resting,
                          ContactMemory<Real>& memory) {
  PairTouch<Real> touch;
  const Real moved = Real(steps.moved), next = Real(steps.next);
  const PairEntry& entry = list.entries[k];
  const std::uint32_t i = entry.first, j = entry.second;
  assert(i < a.elementCount() && j < b.elementCount());
  if (!a.state.alive[i] || !b.state.alive[j]) return touch;
  const Vec3<Real> between = ((b.work.position[j] - a.work.position[i]) + offset).template cast<Real>();
  const Real distance2 = between.squaredNorm();
  const Real free = a.constants->radius + b.constants->radius;
  if (distance2 >= free * free) {
    if (entry.pair != kNoPair) a.state.range[entry.pair] = free;
    memory.range = 0;
    if (!entry.touching) return touch;
  }
  const Real distance = std::sqrt(distance2);
  touch.armFirst = between * (a.constants->radius / free);
  touch.armSecond = -between * (b.constants->radius / free);
  ContactMotion<Real> motion;
  motion.approach = b.state.velocity[j] + b.state.spin[j].cross(touch.armSecond) - a.state.velocity[i] -
                    a.state.spin[i].cross(touch.armFirst);
  motion.spin = b.state.spin[j] - a.state.spin[i];
  Real* range = nullptr;
  if (distance < free) {
    range = &contactDistance(entry, a, b, distance, motion.approach.norm(), moved, memory);
    motion.overlap = *range - distance;
  }
  if (!(motion.overlap > Real(0)) || !(distance > Real(0))) {
    if (entry.touching) touch.lost = lostAtParting(list.law, motion.approach, motion.spin, moved, memory);
    return touch;
  }
  touch.touches = true;
  motion.normal = between / distance;
  touch.at = a.state.origin + a.work.position[i] + touch.armFirst.template cast<double>();
  motion.withheld = withheldBetween(list.law, a, i, b, j, motion.normal, steps.next, resting, touch);
  const Real speed = -motion.approach.dot(motion.normal);
  if (moved > Real(0)) memory.onset = entry.touching ? Real(1) : onsetShare(motion.overlap, speed, moved);
  const ContactYield<Real> yield(list.law.stiffness, motion.overlap, moved * speed, motion.withheld);
  *range -= yield.yielded;
  motion.overlap -= yield.yielded;
  motion.share = touchShare(motion.overlap, speed, next, memory.onset);
  touch.load = contactLoad(list.law, motion, moved, memory);
  touch.load.slipped += yield.lost;
  touch.full = (touch.turned ? -1 : 1) * double(touch.load.full) * motion.normal.template cast<double>();
  touch.power = touch.load.elastic.dot(motion.approach) + touch.load.elasticTorque.dot(motion.spin);
  return touch;
}

template <class Real>
void addTouch(const PairTouch<Real>& touch, Body<Real>& a, std::uint32_t i, Body<Real>& b, std::uint32_t j,
              Real sign) {
  const Vec3<Real> damping = sign * touch.load.damping;
  const Vec3<Real> all = sign * touch.load.elastic + damping;
  const Vec3<Real> dampingTorque = sign * touch.load.dampingTorque;
  const Vec3<Real> torque = sign * touch.load.elasticTorque + dampingTorque;
  a.work.force[i] -= all;
  b.work.force[j] += all;
  a.work.dampingForce[i] -= damping;
  b.work.dampingForce[j] += damping;
  a.work.torque[i] -= touch.armFirst.cross(all) + torque;
  b.work.torque[j] += touch.armSecond.cross(all) + torque;
  a.work.dampingTorque[i] -= touch.armFirst.cross(damping) + dampingTorque;
  b.work.dampingTorque[j] += touch.armSecond.cross(damping) + dampingTorque;
}

}  // namespace

template <class Real>
void accumulateContacts(PairList<Real>& list, Body<Real>& a, Body<Real>& b, const Steps& steps,
                        RestingLoads& resting, Books& books) {
  assert(list.memory.size() == list.entries.size() && steps.moved >= 0 && steps.next >= 0);
  const Vec3<double> offset = b.state.origin - a.state.origin;
  list.elastic = list.elasticAsleep;
  double slipped = 0;
  for (const std::uint32_t k : list.awake) {
    PairEntry& entry = list.entries[k];
    ContactMemory<Real>& memory = list.memory[k];
    if (a.state.sleeping[entry.first] || b.state.sleeping[entry.second]) {  // one: they do not touch
      list.elastic += entry.touching ? double(memory.energy) : 0;
      continue;
    }
    const PairTouch<Real> touch = touchPair(list, k, offset, a, b, steps, resting, memory);
    if (!touch.touches) {
      if (entry.touching) {
        slipped += double(touch.lost);
        part(memory);
        entry.touching = false;
      }
      continue;
    }
    if (!std::exchange(entry.touching, true)) {
      ++a.work.touchesBegun[entry.first];
      ++b.work.touchesBegun[entry.second];
    }
    memory.energy = touch.load.energy;
    list.elastic += double(memory.energy);
    slipped += double(touch.load.slipped);
    addTouch(touch, a, entry.first, b, entry.second, Real(1));
    const Eigen::Vector3d force = (touch.load.elastic + touch.load.damping).template cast<double>();
    const Eigen::Vector3d torque =
        (touch.load.elasticTorque + touch.load.dampingTorque).template cast<double>();
    if (touch.resting == kNoRest) continue;
    pushMotion(a.work.motions[a.work.motionOf[entry.first]], touch.at, -force, -torque);
    pushMotion(b.work.motions[b.work.motionOf[entry.second]], touch.at, force, torque);
    resting.push(touch.resting, touch.full);
  }
  books.dissipated.add(-slipped, 0);
}

template <class Real>
void releaseContacts(PairList<Real>& list, Body<Real>& a, Body<Real>& b, double step, double kick,
                     RestingLoads& resting, Books& books) {
  const Vec3<double> offset = b.state.origin - a.state.origin;
  for (const std::uint32_t k : list.awake) {
    PairEntry& entry = list.entries[k];
    if (!entry.touching || (!a.work.leaving[entry.first] && !b.work.leaving[entry.second])) continue;
    const PairTouch<Real> touch = touchPair(list, k, offset, a, b, Steps{0, step}, resting, list.memory[k]);
    if (!touch.touches) continue;
    addTouch(touch, a, entry.first, b, entry.second, Real(-1));
    list.elastic -= double(touch.load.energy);
    books.elastic -= double(touch.load.energy);
    books.fracture += double(touch.load.energy) + 0.5 * kick * double(touch.power);
    list.memory[k] = {};
    entry.touching = false;
  }
}

template void accumulateContacts(PairList<float>&, Body<float>&, Body<float>&, const Steps&, RestingLoads&,
                                 Books&);
template void accumulateContacts(PairList<double>&, Body<double>&, Body<double>&, const Steps&, RestingLoads&,
                                 Books&);
template void releaseContacts(PairList<float>&, Body<float>&, Body<float>&, double, double, RestingLoads&,
                              Books&);
template void releaseContacts(PairList<double>&, Body<double>&, Body<double>&, double, double, RestingLoads&,
                              Books&);

}  // namespace rubble::edem
