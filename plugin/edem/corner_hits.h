// Corners of rigid bodies in the cells of elements. Each presses the cell that it is deepest in: where cells
// bend into each other it is in two of them, and pressed by both it would gain energy. Where they gape, or
// where the next one has no face outside, it is in none and goes on pressing that which it was in.
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
  double rank;  ///< its depth and what it is favoured by; less than 0 where it is out of the cell [m]
};

class CornerHits {
 public:
  void clear() { m_hits.clear(); }
  /// Of a contact; in rising order of contacts. `wasIn(hit)`: whether it was in that cell at the last
  /// instant; to the depth of a point of an edge that was `favour` [m] is added where it is compared with
  /// others'.
  template <class WasIn>
  void add(std::uint32_t proxy, std::uint32_t candidate, std::span<const FaceHit> hits, double favour,
           WasIn&& wasIn) {
    for (const FaceHit& hit : hits) {
      const bool stays = (hit.beyond > 0 || hit.corner.edge != 0) && wasIn(hit);
      if (hit.beyond > 0 && !stays) continue;
      const double within = hit.depth + (stays ? favour : 0);
      m_hits.push_back({proxy, candidate, hit, hit.beyond > 0 ? -hit.beyond : within});
    }
  }
  /// Leaves each corner the deepest of its hits; of equals the first.
  void settle();
  /// Takes the hits of a contact anew, but for corners that press another or are out of the cell.
  void renew(std::uint32_t proxy, std::uint32_t candidate, std::span<const FaceHit> hits);
  std::span<const CornerHit> of(std::uint32_t candidate) const;

 private:
  std::vector<CornerHit> m_hits;       // rising in candidate
  std::vector<std::uint32_t> m_order;  // scratch
};

}  // namespace rubble::edem
