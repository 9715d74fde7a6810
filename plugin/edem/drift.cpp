#include "edem/drift.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "edem/body_queries.h"

namespace rubble::edem {
namespace {

using Box = Eigen::AlignedBox3d;

// A body or a rigid body.
struct Thing {
  Box box;  // however it turns
  bool moves = false;
  double mass = 0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::size_t group = 0;
};

// Without its box.
template <class Real>
Thing motionOf(const Body<Real>& body) {
  Thing thing;
  const bool held = body.state.anchorsIntact > 0 && !body.state.base.ride.moves();
  thing.moves = !body.state.asleep && body.state.sleepingCount == 0 && !held;
  if (!thing.moves) return thing;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < body.elementCount(); ++i) {
    if (!body.state.alive[i]) continue;
    thing.mass += body.constants->mass[i];
    momentum += body.constants->mass[i] * body.state.velocity[i].template cast<double>();
  }
  if (thing.mass > 0) thing.velocity = momentum / thing.mass;
  return thing;
}

Thing thingOf(const RigidProxy& proxy) {
  Thing thing;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(proxy.reach());
  if (proxy.reach() > 0) thing.box = Box(proxy.position - reach, proxy.position + reach);
  thing.moves = proxy.isDynamic();
  thing.mass = thing.moves ? 1 / proxy.inverseMass : 0;
  thing.velocity = proxy.velocity;
  return thing;
}

bool isUnder(const RigidProxy& proxy, const Box& box) {
  return std::any_of(proxy.parts.begin(), proxy.parts.end(), [&](const Collider& part) {
    if (part.kind != Collider::Kind::Plane) return false;
    const Eigen::Vector3d normal = proxy.orientation * (part.place.linear() * part.size);
    const Eigen::Vector3d lowest = (normal.array() > 0).select(box.min(), box.max());
    return nearest(part, proxy.orientation.conjugate() * (lowest - proxy.position)).distance <= 0;
  });
}

class Groups {
 public:
  Groups(std::vector<Thing>& things, std::size_t bodies, std::span<const RigidProxy> proxies, double skin,
         double left)
      : m_things(things), m_bodies(bodies), m_proxies(proxies), m_skin(skin), m_left(left) {
    for (std::size_t t = 0; t < things.size(); ++t) things[t].group = t;
  }

  // Joins what may meet on its ways. As that changes the ways, until there is nothing more to join.
  void join() {
    for (bool more = true; more;) {
      more = false;
      for (std::size_t b = 0; b < m_bodies; ++b) {
        for (std::size_t other = b + 1; other < m_things.size(); ++other) {
          if (m_things[b].group == m_things[other].group || !meet(b, other)) continue;
          unite(b, other);
          more = true;
        }
      }
    }
  }

 private:
  Box way(const Thing& thing) const {
    if (thing.box.isEmpty()) return thing.box;
    Box box = thing.box;
    box.extend(thing.box.translated(m_left * thing.velocity));
    box.min().array() -= m_skin;
    box.max().array() += m_skin;
    return box;
  }

  bool meet(std::size_t body, std::size_t other) const {
    const Box box = way(m_things[body]);
    return (other >= m_bodies && !box.isEmpty() && isUnder(m_proxies[other - m_bodies], box)) ||
           box.intersects(way(m_things[other]));
  }

  void unite(std::size_t a, std::size_t b) {
    const std::size_t from = m_things[b].group, to = m_things[a].group;
    bool moves = true;
    double mass = 0;
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    for (Thing& thing : m_things) {
      if (thing.group == from) thing.group = to;
      if (thing.group != to) continue;
      moves = moves && thing.moves;
      mass += thing.mass;
      momentum += thing.mass * thing.velocity;
    }
    for (Thing& thing : m_things) {
      if (thing.group != to) continue;
      thing.moves = moves;
      thing.velocity = moves && mass > 0 ? Eigen::Vector3d(momentum / mass) : Eigen::Vector3d::Zero();
    }
  }

  std::vector<Thing>& m_things;
  std::size_t m_bodies;
  std::span<const RigidProxy> m_proxies;
  double m_skin, m_left;
};

}  // namespace

void Drifts::advance(double step) {
  for (std::vector<Drift>* all : {&bodies, &proxies})
    for (Drift& drift : *all) drift.moved += step * drift.velocity;
}

bool Drifts::any() const {
  return std::any_of(bodies.begin(), bodies.end(), [](const Drift& d) { return !d.velocity.isZero(); });
}

template <class Real>
void findDrifts(std::span<const std::unique_ptr<Body<Real>>> bodies, std::span<const RigidProxy> proxies,
                double skin, double left, Drifts& drifts) {
  drifts.bodies.assign(bodies.size(), {});
  drifts.proxies.assign(proxies.size(), {});
  std::vector<Thing> things;
  things.reserve(bodies.size() + proxies.size());
  for (const auto& body : bodies) things.push_back(motionOf(*body));
  // What moves so little keeps its lists through the tick.
  const auto isFast = [&](const Thing& t) { return t.moves && t.velocity.norm() * left > 0.5 * skin; };
  if (std::none_of(things.begin(), things.end(), isFast)) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) things[b].box = boundsOf(*bodies[b]);
  for (const RigidProxy& proxy : proxies) things.push_back(thingOf(proxy));
  Groups(things, bodies.size(), proxies, skin, left).join();
  for (std::size_t t = 0; t < things.size(); ++t) {
    if (!things[t].moves) continue;
    Drift& drift = t < bodies.size() ? drifts.bodies[t] : drifts.proxies[t - bodies.size()];
    drift.velocity = things[t].velocity;
  }
}

template void findDrifts(std::span<const std::unique_ptr<Body<float>>>, std::span<const RigidProxy>, double,
                         double, Drifts&);
template void findDrifts(std::span<const std::unique_ptr<Body<double>>>, std::span<const RigidProxy>, double,
                         double, Drifts&);

}  // namespace rubble::edem
