// Corners of rigid bodies in the cells of elements. Each presses the cell that it is deepest in: where cells
// bend into each other or gape it is in two or in none of them, and pressed by both it would gain energy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edem/face_touch.h"

namespace rubble::edem {

struct CornerHit {
  std::uint32_t proxy;
  std::uint32_t candidate;  ///< contact of the proxy and an element, by place
  FaceHit hit;
  double rank;  ///< its depth and what it is favoured by [m]
};

class CornerHits {
 public:
  void clear() { m_hits.clear(); }
  /// Of a contact; in rising order of contacts.
  /// `favour(hit)` [m] is added to its depth where that is compared with others'.
  template <class Favour>
  void add(std::uint32_t proxy, std::uint32_t candidate, std::span<const FaceHit> hits, Favour&& favour) {
    for (const FaceHit& hit : hits) m_hits.push_back({proxy, candidate, hit, hit.depth + favour(hit)});
  }
  /// Leaves each corner the deepest of its hits; of equals the first.
  void settle();
  /// Takes the hits of a contact anew, but for corners that press another.
  void renew(std::uint32_t proxy, std::uint32_t candidate, std::span<const FaceHit> hits);
  std::span<const CornerHit> of(std::uint32_t candidate) const;

 private:
  std::vector<CornerHit> m_hits;  // rising in candidate
};

}  // namespace rubble::edem
