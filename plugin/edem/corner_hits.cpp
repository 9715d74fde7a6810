#include "edem/corner_hits.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace rubble::edem {
namespace {

bool byCandidate(const CornerHit& a, const CornerHit& b) {
  return a.candidate < b.candidate;
}

auto nameOf(const CornerHit& h) {
  return std::tie(h.proxy, h.hit.corner.part, h.hit.corner.edge, h.hit.corner.corner);
}

}  // namespace

void CornerHits::settle() {
  m_order.resize(m_hits.size());
  std::iota(m_order.begin(), m_order.end(), std::uint32_t(0));
  std::sort(m_order.begin(), m_order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const CornerHit &a = m_hits[i], &b = m_hits[j];
    if (nameOf(a) != nameOf(b)) return nameOf(a) < nameOf(b);
    return a.rank != b.rank ? a.rank > b.rank : i < j;
  });
  const auto same = [&](std::uint32_t i, std::uint32_t j) { return nameOf(m_hits[i]) == nameOf(m_hits[j]); };
  m_order.erase(std::unique(m_order.begin(), m_order.end(), same), m_order.end());
  // They are in order as they were added.
  std::sort(m_order.begin(), m_order.end());
  for (std::size_t place = 0; place < m_order.size(); ++place)
    if (m_order[place] != place) m_hits[place] = m_hits[m_order[place]];
  m_hits.erase(m_hits.begin() + std::ptrdiff_t(m_order.size()), m_hits.end());
}

void CornerHits::renew(std::uint32_t proxy, std::uint32_t candidate, std::span<const FaceHit> hits) {
  std::erase_if(m_hits, [&](const CornerHit& h) { return h.candidate == candidate; });
  for (const FaceHit& hit : hits) {
    const CornerHit own{proxy, candidate, hit, hit.depth};
    const auto isThis = [&](const CornerHit& h) { return nameOf(h) == nameOf(own); };
    if (hit.beyond > 0 || std::any_of(m_hits.begin(), m_hits.end(), isThis)) continue;
    m_hits.insert(std::upper_bound(m_hits.begin(), m_hits.end(), own, byCandidate), own);
  }
}

std::span<const CornerHit> CornerHits::of(std::uint32_t candidate) const {
  const auto [begin, end] =
      std::equal_range(m_hits.begin(), m_hits.end(), CornerHit{0, candidate, {}, 0}, byCandidate);
  return {begin, end};
}

}  // namespace rubble::edem
