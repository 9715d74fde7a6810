#include "edem/pair_lists.h"

#include <cassert>

#include <algorithm>

namespace rubble::edem {
namespace {

// The pair's place in Body::range, or kNoPair for two elements that are free of each other.
template <class Real>
std::uint32_t pairOf(const Body<Real>& body, std::uint32_t i, std::uint32_t j) {
  const auto begin = body.pairs.begin() + body.pairOffsets[i],
             end = body.pairs.begin() + body.pairOffsets[i + 1];
  const auto found = std::lower_bound(
      begin, end, j, [](const PairIndex& p, std::uint32_t partner) { return p.partner < partner; });
  return found != end && found->partner == j ? found->pair : kNoPair;
}

}  // namespace

template <class Real>
void PairLists<Real>::build(std::span<const std::unique_ptr<Body<Real>>> bodies, double skin) {
  assert(skin >= 0);
  m_skin = skin;
  m_grids.resize(bodies.size());
  while (m_lists.size() < bodies.size()) m_lists.emplace_back();
  while (m_lists.size() > bodies.size()) {
    m_spare.push_back(std::move(m_lists.back()));
    m_lists.pop_back();
  }
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const Body<Real>& body = *bodies[b];
    ElementGrid<Real>& grid = m_grids[b];
    grid.listed = body.position;
    grid.grid.build(grid.listed, body.alive, Real(2) * body.radius + Real(skin));
    grid.bounds.setEmpty();
    for (std::size_t i = 0; i < body.elementCount(); ++i)
      if (body.alive[i]) grid.bounds.extend(body.origin + grid.listed[i].template cast<double>());
    m_lists[b].first = m_lists[b].second = b;
    m_lists[b].entries.clear();
    if (!body.asleep) listWithin(body, b, m_lists[b]);
  }
  for (std::uint32_t a = 0; a < bodies.size(); ++a) {
    for (std::uint32_t b = a + 1; b < bodies.size(); ++b) {
      if (bodies[a]->asleep && bodies[b]->asleep) continue;
      const double reach = double(bodies[a]->radius) + double(bodies[b]->radius) + skin;
      Eigen::AlignedBox3d grown = m_grids[a].bounds;
      if (grown.isEmpty() || m_grids[b].bounds.isEmpty()) continue;
      grown.min().array() -= reach;
      grown.max().array() += reach;
      if (!grown.intersects(m_grids[b].bounds)) continue;
      PairList list;
      if (!m_spare.empty()) {
        list = std::move(m_spare.back());
        m_spare.pop_back();
      }
      list.first = a;
      list.second = b;
      list.entries.clear();
      listBetween(*bodies[a], *bodies[b], m_grids[a], m_grids[b], list);
      m_lists.push_back(std::move(list));
    }
  }
}

template <class Real>
void PairLists<Real>::listWithin(const Body<Real>& body, std::uint32_t place, PairList& list) {
  const ElementGrid<Real>& own = m_grids[place];
  const Real distance = Real(2) * body.radius + Real(m_skin);
  const Real distance2 = distance * distance;
  for (std::uint32_t i = 0; i < body.elementCount(); ++i) {
    if (!body.alive[i]) continue;
    const auto cell = own.grid.cellOf(own.listed[i]);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          own.grid.visitCell(cell + Eigen::Vector3i(x, y, z), [&](std::uint32_t j) {
            if (j <= i || (own.listed[j] - own.listed[i]).squaredNorm() >= distance2) return;
            const std::uint32_t pair = pairOf(body, i, j);
            const bool joined = pair < body.anchorBegin && body.intact[pair];
            if (joined && !body.model.contactBesideSpring) return;
            list.entries.push_back({i, j, pair});
          });
        }
      }
    }
  }
}

template <class Real>
void PairLists<Real>::listBetween(const Body<Real>& a, const Body<Real>& b, const ElementGrid<Real>& gridA,
                                  const ElementGrid<Real>& gridB, PairList& list) {
  const Vec3<Real> offset = (a.origin - b.origin).template cast<Real>();  // a's coordinates -> b's
  const Real distance = a.radius + b.radius + Real(m_skin);
  const Vec3<Real> reach = Vec3<Real>::Constant(distance);
  for (std::uint32_t i = 0; i < a.elementCount(); ++i) {
    if (!a.alive[i]) continue;
    if (gridB.bounds.squaredExteriorDistance(a.origin + gridA.listed[i].template cast<double>()) >
        double(distance) * double(distance))
      continue;
    const Vec3<Real> p = gridA.listed[i] + offset;
    gridB.grid.visitBox(p - reach, p + reach, [&](std::uint32_t j) {
      if ((gridB.listed[j] - p).squaredNorm() < distance * distance) list.entries.push_back({i, j, kNoPair});
    });
  }
}

template <class Real>
void PairLists<Real>::addBroken(std::uint32_t body, const PairEntry& entry) {
  m_lists[body].entries.push_back(entry);
}

template class PairLists<float>;
template class PairLists<double>;

}  // namespace rubble::edem
