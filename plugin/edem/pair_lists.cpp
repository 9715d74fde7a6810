#include "edem/pair_lists.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

namespace rubble::edem {
namespace {

// The pair's place in BodyState::range, or kNoPair for two elements that are free of each other.
template <class Real>
std::uint32_t pairOf(const Body<Real>& body, std::uint32_t i, std::uint32_t j) {
  const auto begin = body.constants->pairs.begin() + body.constants->pairOffsets[i],
             end = body.constants->pairs.begin() + body.constants->pairOffsets[i + 1];
  const auto found = std::lower_bound(
      begin, end, j, [](const PairIndex& p, std::uint32_t partner) { return p.partner < partner; });
  return found != end && found->partner == j ? found->pair : kNoPair;
}

bool before(const PairEntry& a, const PairEntry& b) {
  return std::tie(a.first, a.second) < std::tie(b.first, b.second);
}

// Brings the list into its order and gives pairs that touched in `old` their memory back.
template <class Real>
void remember(PairList<Real>& list, const PairList<Real>& old) {
  std::sort(list.entries.begin(), list.entries.end(), before);
  list.memory.assign(list.entries.size(), {});
  list.elastic = old.elastic;
  std::size_t k = 0;
  for (std::size_t o = 0; o < old.entries.size(); ++o) {
    if (!old.entries[o].touching && !(old.memory[o].range > Real(0))) continue;
    while (k < list.entries.size() && before(list.entries[k], old.entries[o])) ++k;
    if (k == list.entries.size()) return;
    if (before(old.entries[o], list.entries[k])) continue;
    list.entries[k].touching = old.entries[o].touching;
    list.memory[k] = old.memory[o];
  }
}

template <class Real>
void add(PairList<Real>& list, const PairEntry& entry, const ContactMemory<Real>& memory) {
  list.entries.push_back(entry);
  list.memory.push_back(memory);
  if (entry.touching) list.elastic += double(memory.energy);
}

// A pair of which one element has become `part`'s, behind all other bodies: it comes second.
template <class Real>
void addAcross(PairList<Real>& list, PairEntry entry, ContactMemory<Real> memory, const Body<Real>& part,
               bool firstLeaves) {
  if (entry.pair != kNoPair) memory.range = part.state.range[entry.pair];
  entry.pair = kNoPair;
  if (firstLeaves) {
    std::swap(entry.first, entry.second);
    memory.slip = -memory.slip;
    memory.roll = -memory.roll;
  }
  add(list, entry, memory);
}

template <class Real>
void sortEntries(PairList<Real>& list) {
  std::vector<std::size_t> order(list.entries.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::sort(order,
                    [&](std::size_t k, std::size_t m) { return before(list.entries[k], list.entries[m]); });
  const PairList<Real> old = list;
  for (std::size_t k = 0; k < order.size(); ++k) {
    list.entries[k] = old.entries[order[k]];
    list.memory[k] = old.memory[order[k]];
  }
}

}  // namespace

template <class Real>
void PairLists<Real>::grid(const Body<Real>& body, ElementGrid& out) const {
  const bool sleeps = body.state.asleep;
  if (sleeps && out.sleeper == body.id && out.sleepChanges == body.state.sleepChanges) return;
  out.sleeper = sleeps ? body.id : kNoPair;
  out.sleepChanges = body.state.sleepChanges;
  out.listed = body.work.position;
  out.grid.build(out.listed, body.state.alive, 2 * double(body.constants->radius) + m_skin);
  out.bounds.setEmpty();
  for (std::size_t i = 0; i < body.elementCount(); ++i)
    if (body.state.alive[i]) out.bounds.extend(body.state.origin + out.listed[i]);
}

// The old list of two bodies, or a new one.
template <class Real>
PairList<Real> PairLists<Real>::take(const Body<Real>& a, const Body<Real>& b, std::uint32_t placeA,
                                     std::uint32_t placeB) {
  PairList<Real> list;
  // Lists within bodies mostly stand where they stood.
  const bool stands = placeA == placeB && placeA < m_old.size() && m_old[placeA].firstId == a.id &&
                      m_old[placeA].secondId == b.id;
  const std::size_t hint = stands ? placeA : 0;
  for (PairList<Real>& o : std::span(m_old).subspan(hint)) {
    if (o.firstId != a.id || o.secondId != b.id) continue;
    list = std::move(o);
    o.firstId = o.secondId = kNoPair;
    break;
  }
  list.first = placeA;
  list.second = placeB;
  list.firstId = a.id;
  list.secondId = b.id;
  list.law = lawOf(a, b);
  return list;
}

template <class Real>
ContactLaw<Real> PairLists<Real>::lawOf(const Body<Real>& a, const Body<Real>& b) const {
  ContactSide one = a.constants->contact, other = b.constants->contact;
  one.stiffness *= m_share;
  other.stiffness *= m_share;
  return contactLaw(one, other).template cast<Real>();
}

template <class Real>
void PairLists<Real>::soften(std::span<const std::unique_ptr<Body<Real>>> bodies, double share) {
  m_share = share;
  for (PairList<Real>& l : m_lists) l.law = lawOf(*bodies[l.first], *bodies[l.second]);
}

template <class Real>
double PairLists<Real>::elasticAwake() const {
  double energy = 0;
  for (const PairList<Real>& l : m_lists) energy += l.elastic - l.elasticAsleep;
  return energy;
}

template <class Real>
void PairLists<Real>::build(std::span<const std::unique_ptr<Body<Real>>> bodies, double skin) {
  assert(skin >= 0);
  m_skin = skin;
  m_grids.resize(bodies.size());
  std::swap(m_old, m_lists);
  m_lists.clear();
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    grid(*bodies[b], m_grids[b]);
    PairList<Real> list = take(*bodies[b], *bodies[b], b, b);
    if (!bodies[b]->state.asleep) listWithin(*bodies[b], b, list);
    m_lists.push_back(std::move(list));
  }
  for (std::uint32_t a = 0; a < bodies.size(); ++a) {
    for (std::uint32_t b = a + 1; b < bodies.size(); ++b) {
      const double reach = double(bodies[a]->constants->radius) + double(bodies[b]->constants->radius) + skin;
      Eigen::AlignedBox3d grown = m_grids[a].bounds;
      if (grown.isEmpty() || m_grids[b].bounds.isEmpty()) continue;
      grown.min().array() -= reach;
      grown.max().array() += reach;
      if (!grown.intersects(m_grids[b].bounds)) continue;
      PairList<Real> list = take(*bodies[a], *bodies[b], a, b);
      if (!bodies[a]->state.asleep || !bodies[b]->state.asleep) listBetween(*bodies[a], *bodies[b], list);
      m_lists.push_back(std::move(list));
    }
  }
  listAwake(bodies);
}

template <class Real>
void PairLists<Real>::listAwake(std::span<const std::unique_ptr<Body<Real>>> bodies) {
  for (PairList<Real>& list : m_lists) {
    const Body<Real>&a = *bodies[list.first], &b = *bodies[list.second];
    list.awake.clear();
    list.elasticAsleep = 0;
    for (std::uint32_t k = 0; k < list.entries.size(); ++k) {
      const PairEntry& e = list.entries[k];
      if (!a.state.sleeping[e.first] || !b.state.sleeping[e.second])
        list.awake.push_back(k);
      else if (e.touching)
        list.elasticAsleep += double(list.memory[k].energy);
    }
  }
}

template <class Real>
void PairLists<Real>::listWithin(const Body<Real>& body, std::uint32_t place, PairList<Real>& list) {
  const ElementGrid& own = m_grids[place];
  const double distance = 2 * double(body.constants->radius) + m_skin;
  const double distance2 = distance * distance;
  const PairList<Real> old = list;
  list.entries.clear();
  // Pairs that sleep are as they were.
  for (const PairEntry& e : old.entries)
    if (body.state.sleeping[e.first] && body.state.sleeping[e.second]) list.entries.push_back(e);
  for (const std::uint32_t i : body.work.awake) {
    if (!body.state.alive[i]) continue;
    const auto cell = own.grid.cellOf(own.listed[i]);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          own.grid.visitCell(cell + Eigen::Vector3i(x, y, z), [&](std::uint32_t j) {
            if (j == i || (j < i && !body.state.sleeping[j])) return;  // the other finds it
            if ((own.listed[j] - own.listed[i]).squaredNorm() >= distance2) return;
            const std::uint32_t first = std::min(i, j), second = std::max(i, j);
            const std::uint32_t pair = pairOf(body, first, second);
            const bool joined = pair < body.constants->anchorBegin && body.state.intact[pair];
            if (joined && !body.constants->model.contactBesideSpring) return;
            list.entries.push_back({first, second, pair});
          });
        }
      }
    }
  }
  remember(list, old);
}

template <class Real>
void PairLists<Real>::listBetween(const Body<Real>& a, const Body<Real>& b, PairList<Real>& list) {
  const ElementGrid &gridA = m_grids[list.first], &gridB = m_grids[list.second];
  const Vec3<double> offset = a.state.origin - b.state.origin;  // a's coordinates -> b's
  const double distance = double(a.constants->radius) + double(b.constants->radius) + m_skin;
  const Vec3<double> reach = Vec3<double>::Constant(distance);
  const PairList<Real> old = list;
  list.entries.clear();
  for (std::uint32_t i = 0; i < a.elementCount(); ++i) {
    if (!a.state.alive[i]) continue;
    if (gridB.bounds.squaredExteriorDistance(a.state.origin + gridA.listed[i]) > distance * distance)
      continue;
    const Vec3<double> p = gridA.listed[i] + offset;
    gridB.grid.visitBox(p - reach, p + reach, [&](std::uint32_t j) {
      if ((gridB.listed[j] - p).squaredNorm() < distance * distance) list.entries.push_back({i, j, kNoPair});
    });
  }
  remember(list, old);
}

template <class Real>
void PairLists<Real>::addBroken(std::uint32_t body, const PairEntry& entry) {
  PairList<Real>& list = m_lists[body];
  const auto at = std::lower_bound(list.entries.begin(), list.entries.end(), entry, before);
  const auto place = std::uint32_t(at - list.entries.begin());
  list.memory.insert(list.memory.begin() + place, ContactMemory<Real>{});
  list.entries.insert(at, entry);
  const auto behind = std::lower_bound(list.awake.begin(), list.awake.end(), place);
  std::for_each(behind, list.awake.end(), [](std::uint32_t& k) { ++k; });
  list.awake.insert(behind, place);
}

template <class Real>
void PairLists<Real>::removeBody(std::uint32_t place) {
  if (place < m_grids.size()) m_grids.erase(m_grids.begin() + place);
  std::erase_if(m_lists, [place](const PairList<Real>& l) { return l.first == place || l.second == place; });
  for (PairList<Real>& l : m_lists) {  // what wakes before the next build looks at their bodies
    if (l.first > place) --l.first;
    if (l.second > place) --l.second;
  }
}

template <class Real>
void PairLists<Real>::insertBody(std::uint32_t place, std::uint32_t id) {
  if (place >= m_grids.size()) return;  // behind all that have been listed
  for (PairList<Real>& l : m_lists) {
    if (l.first >= place) ++l.first;
    if (l.second >= place) ++l.second;
  }
  m_grids.insert(m_grids.begin() + place, ElementGrid{});
  m_lists.insert(m_lists.begin() + place, {place, place, id, id, {}, {}, {}, {}, 0, 0});
}

template <class Real>
void PairLists<Real>::split(std::uint32_t place, std::span<const std::uint8_t> which, const Body<Real>& part,
                            std::uint32_t partPlace) {
  if (place >= m_grids.size()) return;  // it has not been listed
  PairList<Real> within = {partPlace, partPlace, part.id, part.id, m_lists[place].law, {}, {}, {}, 0, 0};
  std::vector<PairList<Real>> between;
  for (PairList<Real>& l : m_lists) {
    if (l.first != place && l.second != place) continue;
    PairList<Real> rest = {l.first, l.second, l.firstId, l.secondId, l.law, {}, {}, {}, 0, 0};
    const bool isFirst = l.first == place;
    PairList<Real> across = {isFirst ? l.second : l.first,
                             partPlace,
                             isFirst ? l.secondId : l.firstId,
                             part.id,
                             l.law,
                             {},
                             {},
                             {},
                             0,
                             0};
    for (std::size_t k = 0; k < l.entries.size(); ++k) {
      const PairEntry& e = l.entries[k];
      const bool first = isFirst && which[e.first], second = l.second == place && which[e.second];
      if (first != second)
        addAcross(across, e, l.memory[k], part, first);
      else
        add(first ? within : rest, e, l.memory[k]);
    }
    l = std::move(rest);
    sortEntries(across);
    between.push_back(std::move(across));
  }
  // Lists within bodies stand first. Of those that have not been listed yet there are none.
  m_lists.insert(m_lists.begin() + std::ptrdiff_t(m_grids.size()), std::move(within));
  std::ranges::move(between, std::back_inserter(m_lists));
  if (partPlace == m_grids.size()) m_grids.push_back(ElementGrid(m_grids[place]));
}

template <class Real>
double PairLists<Real>::endContactsOf(std::uint32_t id) {
  double energy = 0;
  for (PairList<Real>& list : m_lists) {
    if (list.firstId != id && list.secondId != id) continue;
    energy += std::exchange(list.elastic, 0);
    list.entries.clear();
    list.memory.clear();
    list.awake.clear();
    list.elasticAsleep = 0;
  }
  return energy;
}

template class PairLists<float>;
template class PairLists<double>;

}  // namespace rubble::edem
