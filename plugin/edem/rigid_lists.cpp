#include "edem/rigid_lists.h"

#include <algorithm>

#include "edem/edge_points.h"

namespace rubble::edem {

template <class Real>
void RigidLists<Real>::keep(std::span<const RigidState> states) {
  for (const RigidContact& c : m_contacts)
    if (c.touching || c.memory.range > 0 || c.faces.deepest > 0)
      m_kept.push_back({states[c.proxy].key, m_ids[c.body], c.element, c.memory, c.faces, c.touching});
  m_contacts.clear();
}

template <class Real>
void RigidLists<Real>::remember(std::uint64_t key, RigidContact& candidate) {
  const Kept wanted{key, m_ids[candidate.body], candidate.element, {}, {}, false};
  const auto found = std::lower_bound(m_kept.begin(), m_kept.end(), wanted,
                                      [](const Kept& a, const Kept& b) { return a.name() < b.name(); });
  if (found == m_kept.end() || found->name() != wanted.name()) return;
  candidate.touching = found->touching;
  candidate.memory = found->memory;
  candidate.faces = found->faces;
  found->taken = true;
}

// What did not come back into the lists has ended, unless its body or element sleeps.
template <class Real>
void RigidLists<Real>::endKept(Bodies bodies) {
  const auto asleep = [&](const Kept& k) {
    return std::any_of(bodies.begin(), bodies.end(), [&k](const auto& b) {
      return b->id == k.body && (b->state.asleep || b->state.sleeping[k.element]);
    });
  };
  std::erase_if(m_kept, [&](const Kept& k) {
    if (!k.taken && asleep(k)) return false;
    if (!k.taken) m_lost += k.memory.energy;
    return true;
  });
}

template <class Real>
double RigidLists<Real>::end(std::uint32_t id) {
  double energy = 0;
  std::erase_if(m_contacts, [&](const RigidContact& c) {
    if (m_ids[c.body] != id) return false;
    energy += c.memory.energy;
    return true;
  });
  std::erase_if(m_kept, [&](const Kept& k) {
    if (k.body != id) return false;
    energy += k.memory.energy;
    return true;
  });
  return energy;
}

template <class Real>
void RigidLists<Real>::split(std::span<const RigidState> states, std::uint32_t id,
                             std::span<const std::uint8_t> which, std::uint32_t newId) {
  keep(states);
  for (Kept& k : m_kept)
    if (k.body == id && which[k.element]) k.body = newId;
}

// As of one that is not there any more: what sleeps at it wakes.
template <class Real>
void RigidLists<Real>::part(std::uint64_t key) {
  for (Kept& k : m_kept)
    if (k.key == key) k.key = 0;
}

template <class Real>
void RigidLists<Real>::build(Bodies bodies, const PairLists<Real>& lists, std::span<const RigidProxy> proxies,
                             std::span<RigidState> states) {
  keep(states);
  std::sort(m_kept.begin(), m_kept.end(), [](const Kept& a, const Kept& b) { return a.name() < b.name(); });
  m_ids.clear();
  for (const auto& body : bodies) m_ids.push_back(body->id);
  for (std::uint32_t p = 0; p < proxies.size(); ++p) {
    states[p].listedPosition = proxies[p].position;
    states[p].listedOrientation = proxies[p].orientation;
    for (std::uint32_t b = 0; b < bodies.size(); ++b)
      if (!bodies[b]->state.asleep) listNear(proxies[p], states[p].key, p, b, *bodies[b], lists);
  }
  endKept(bodies);
}

// From the listing on, an element may move a whole skin (from one side of its listed place to the other) and
// the proxy half.
template <class Real>
double RigidLists<Real>::away(const PairLists<Real>& lists) {
  return 1.5 * lists.skin();
}

template <class Real>
template <class Visit>
void RigidLists<Real>::visitNear(const RigidProxy& proxy, std::uint32_t place, const Body<Real>& body,
                                 bool sleeping, const PairLists<Real>& lists, Visit&& visit) const {
  if (std::find(proxy.spared.begin(), proxy.spared.end(), body.id) != proxy.spared.end()) return;
  const ElementGrid& own = lists.grid(place);
  const double reach = body.reach() + away(lists);
  const auto grown = [](const Eigen::AlignedBox3d& box, double by) {
    return Eigen::AlignedBox3d(box.min().array() - by, box.max().array() + by);
  };
  Eigen::AlignedBox3d box = grown(proxy.bounds(), reach + 0.5 * lists.skin());
  if (!box.intersects(own.bounds)) return;
  // Grown again, for the box of a single element or of a flat layer has no volume for rounding to miss.
  box = grown(box.intersection(own.bounds), 0.25 * lists.skin());

  const bool bears = std::find(proxy.bears.begin(), proxy.bears.end(), body.id) != proxy.bears.end();
  const auto consider = [&](std::uint32_t i) {
    if (!body.state.alive[i] || bool(body.state.sleeping[i]) != sleeping) return;
    if (body.state.anchored[i] && proxy.isStatic()) return;  // it stands on that by its anchor
    if (bears && body.work.motions[body.work.motionOf[i]].fixed) return;
    const Eigen::Vector3d x = body.state.origin + body.work.position[i];
    const double near = body.constants->cells ? body.constants->cells->reach[i] + away(lists) : reach;
    const double distance = nearest(proxy, x, near).distance;
    if (distance < near) visit(i, x, distance);
  };
  const Vec3<double> low = box.min() - body.state.origin, high = box.max() - body.state.origin;
  const double gridCells = own.grid.cellsIn(low, high);
  if (!sleeping && gridCells > double(body.work.awake.size())) {
    for (const std::uint32_t i : body.work.awake) consider(i);
  } else if (gridCells > double(body.elementCount())) {
    for (std::uint32_t i = 0; i < body.elementCount(); ++i) consider(i);
  } else {
    own.grid.visitBox(low, high, consider);
  }
}

template <class Real>
void RigidLists<Real>::listNear(const RigidProxy& proxy, std::uint64_t key, std::uint32_t p,
                                std::uint32_t place, const Body<Real>& body, const PairLists<Real>& lists) {
  const std::size_t begin = m_contacts.size();
  visitNear(proxy, place, body, false, lists,
            [&](std::uint32_t i, const Eigen::Vector3d& x, double distance) {
              RigidContact candidate;
              candidate.proxy = p;
              candidate.body = place;
              candidate.element = i;
              if (body.constants->cells) {
                const Eigen::Vector3d at = proxy.orientation.conjugate() * (x - proxy.position);
                const double size = body.constants->cells->reach[i];
                candidate.edges = edgeWeights(proxy, *body.constants->cells, at, size, size + away(lists));
                candidate.balls = candidate.edges + ballWeights(proxy, at, size + away(lists));
                candidate.core = distance < body.constants->cells->core[i] + away(lists);
              }
              remember(key, candidate);
              m_contacts.push_back(candidate);
            });
  std::sort(m_contacts.begin() + std::ptrdiff_t(begin), m_contacts.end(),
            [](const RigidContact& a, const RigidContact& b) { return a.element < b.element; });
}

template <class Real>
const RigidContact* RigidLists<Real>::find(std::uint32_t proxy, std::uint32_t id,
                                           std::uint32_t element) const {
  // Places of bodies rise with their ids.
  const auto nameOf = [&](const RigidContact& c) { return std::tuple(c.proxy, m_ids[c.body], c.element); };
  const std::tuple wanted(proxy, id, element);
  const auto found = std::lower_bound(m_contacts.begin(), m_contacts.end(), wanted,
                                      [&](const RigidContact& c, const auto& w) { return nameOf(c) < w; });
  return found == m_contacts.end() || nameOf(*found) != wanted ? nullptr : &*found;
}

template <class Real>
double RigidLists<Real>::keptEnergy() const {
  double energy = 0;
  for (const Kept& k : m_kept) energy += k.memory.energy;
  return energy;
}

template <class Real>
void RigidLists<Real>::visitDisturbed(Bodies bodies, const PairLists<Real>& lists,
                                      std::span<const RigidProxy> proxies, std::span<const RigidState> states,
                                      const VisitElement& visit) const {
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const Body<Real>& body = *bodies[b];
    if (body.state.sleepingCount == 0 || body.state.asleep) continue;
    const auto visitSleeping = [&](std::uint32_t i) {
      if (body.state.sleeping[i]) visit(b, i);
    };
    for (std::uint32_t p = 0; p < proxies.size(); ++p)
      if (!states[p].still)
        visitNear(proxies[p], b, body, true, lists,
                  [&](std::uint32_t i, const Eigen::Vector3d&, double) { visit(b, i); });
    for (const Kept& k : m_kept) {
      const auto isThere = [&k](const RigidState& s) { return s.key == k.key; };
      if (k.body == body.id && std::none_of(states.begin(), states.end(), isThere)) visitSleeping(k.element);
    }
  }
}

template <class Real>
void RigidLists<Real>::visitAtMoving(std::span<const RigidState> states, const VisitElement& visit) const {
  for (const RigidContact& c : m_contacts)
    if (c.touching && !states[c.proxy].still) visit(c.body, c.element);
}

template <class Real>
bool RigidLists<Real>::expired(double skin, std::span<const Drift> drifts,
                               std::span<const RigidProxy> proxies,
                               std::span<const RigidState> states) const {
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    const RigidProxy& proxy = proxies[p];
    const double angle = states[p].listedOrientation.angularDistance(proxy.orientation);
    const Eigen::Vector3d moved = proxy.position - states[p].listedPosition - drifts[p].moved;
    if (moved.norm() + angle * proxy.reach() > 0.5 * skin) return true;
  }
  return false;
}

template class RigidLists<float>;
template class RigidLists<double>;

}  // namespace rubble::edem
