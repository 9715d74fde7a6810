#include "edem/corner_hits.h"

#include <algorithm>
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
  std::stable_sort(m_hits.begin(), m_hits.end(), [](const CornerHit& a, const CornerHit& b) {
    return nameOf(a) != nameOf(b) ? nameOf(a) < nameOf(b) : a.rank > b.rank;
  });
  const auto same = [](const CornerHit& a, const CornerHit& b) { return nameOf(a) == nameOf(b); };
  m_hits.erase(std::unique(m_hits.begin(), m_hits.end(), same), m_hits.end());
  std::stable_sort(m_hits.begin(), m_hits.end(), byCandidate);
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
