#include "cook/ear_clipping.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rubble::cooking {
namespace {

// The outline of a face on a surface of slivers has thousands of corners, nearly on one line. So corners are
// in a ring, from which one is taken at no cost, and in the order of their places along one axis, so that
// an ear is compared with those beside it alone.
class EarRing {
 public:
  EarRing(const FlatLoop& loop, std::vector<std::array<std::uint32_t, 3>>& triangles)
      : m_loop(loop), m_triangles(triangles), m_next(loop.size()), m_before(loop.size()) {
    const auto n = std::uint32_t(loop.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      m_next[k] = k + 1 == n ? 0 : k + 1;
      m_before[k] = k == 0 ? n - 1 : k - 1;
    }
    if (n > kFew) sortAlong();
  }

  std::size_t clip() {
    std::size_t left = m_loop.size();
    std::uint32_t at = 0;
    while (left >= 3) {
      std::size_t tried = 0;
      for (; tried < left && !isEar(at); ++tried) at = m_next[at];
      const std::uint32_t ear = tried < left ? at : mostConvex(left);
      const std::uint32_t before = m_before[ear];
      const std::uint32_t next = m_next[ear];
      m_triangles.push_back({m_loop[before].id, m_loop[ear].id, m_loop[next].id});
      if (left == 3) break;
      take(ear);
      --left;
      at = m_next[next];  // past the next corner: ears taken in turn give rounder triangles than a fan
    }
    return m_compared;
  }

 private:
  static constexpr std::uint32_t kFew = 32;  // are compared faster than sorted

  void sortAlong() {
    Eigen::Vector2d low = m_loop[0].place;
    Eigen::Vector2d high = low;
    for (const FlatPoint& point : m_loop) {
      low = low.cwiseMin(point.place);
      high = high.cwiseMax(point.place);
    }
    m_axis = (high - low).x() >= (high - low).y() ? 0 : 1;
    // A corner that turn() puts on the left of a line is right of it by this at most: eight roundings of the
    // longest difference.
    m_rounding = 4 * std::numeric_limits<double>::epsilon() * (high - low).norm();
    m_order.assign(m_loop.size(), 0);
    std::iota(m_order.begin(), m_order.end(), 0u);
    std::sort(m_order.begin(), m_order.end(), [this](std::uint32_t a, std::uint32_t b) {
      return std::pair(along(a), a) < std::pair(along(b), b);
    });
    m_rank.assign(m_loop.size(), 0);
    for (std::uint32_t r = 0; r < m_order.size(); ++r) m_rank[m_order[r]] = r;
    m_skip.assign(m_loop.size() + 1, 0);
    std::iota(m_skip.begin(), m_skip.end(), 0u);
  }

  double along(std::uint32_t corner) const { return m_loop[corner].place[m_axis]; }

  void take(std::uint32_t corner) {
    m_next[m_before[corner]] = m_next[corner];
    m_before[m_next[corner]] = m_before[corner];
    if (corner == m_first) m_first = m_next[corner];
    if (!m_skip.empty()) m_skip[m_rank[corner]] = m_rank[corner] + 1;
  }

  // The first rank from here on that is left.
  std::uint32_t leftFrom(std::uint32_t rank) {
    while (m_skip[rank] != rank) rank = m_skip[rank] = m_skip[m_skip[rank]];
    return rank;
  }

  bool isEar(std::uint32_t b) {
    const std::uint32_t a = m_before[b];
    const std::uint32_t c = m_next[b];
    const double area = turn(m_loop[a], m_loop[b], m_loop[c]);
    if (area <= 0) return false;
    // How far along the axis turn() may take a corner for one in the triangle: a tip of angle t reaches
    // farther by rounding / sin(t / 2).
    const double longest = std::max({(m_loop[b].place - m_loop[a].place).squaredNorm(),
                                     (m_loop[c].place - m_loop[b].place).squaredNorm(),
                                     (m_loop[a].place - m_loop[c].place).squaredNorm()});
    const bool isClear = area > 16 * std::numeric_limits<double>::epsilon() * longest;
    if (m_skip.empty() || !isClear) return isFreeOfAll(a, b, c);
    const double reach = 4 * m_rounding * longest / area;
    const double from = std::min({along(a), along(b), along(c)}) - reach;
    const double to = std::max({along(a), along(b), along(c)}) + reach;
    const auto start = std::lower_bound(m_order.begin(), m_order.end(), from,
                                        [this](std::uint32_t p, double place) { return along(p) < place; });
    for (std::uint32_t r = leftFrom(std::uint32_t(start - m_order.begin()));
         r < m_order.size() && along(m_order[r]) <= to; r = leftFrom(r + 1))
      if (blocks(a, b, c, m_order[r])) return false;
    return true;
  }

  bool isFreeOfAll(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (std::uint32_t p = m_next[c]; p != a; p = m_next[p])
      if (blocks(a, b, c, p)) return false;
    return true;
  }

  bool blocks(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) {
    ++m_compared;
    const FlatPoint& point = m_loop[p];
    if (point.id == m_loop[a].id || point.id == m_loop[b].id || point.id == m_loop[c].id)
      return false;  // bridges repeat corners
    return turn(m_loop[a], m_loop[b], point) >= 0 && turn(m_loop[b], m_loop[c], point) >= 0 &&
           turn(m_loop[c], m_loop[a], point) >= 0;
  }

  // Slivers may have no ear in rounded arithmetic; then the corner that turns left the most has to do.
  std::uint32_t mostConvex(std::size_t left) const {
    std::uint32_t best = m_first;
    double bestTurn = -std::numeric_limits<double>::infinity();
    for (std::uint32_t k = m_first; left > 0; --left, k = m_next[k]) {
      const double value = turn(m_loop[m_before[k]], m_loop[k], m_loop[m_next[k]]);
      if (value <= bestTurn) continue;
      bestTurn = value;
      best = k;
    }
    return best;
  }

  const FlatLoop& m_loop;
  std::vector<std::array<std::uint32_t, 3>>& m_triangles;
  std::vector<std::uint32_t> m_next, m_before;
  std::uint32_t m_first = 0;  // in the loop, of those left
  int m_axis = 0;
  double m_rounding = 0;               // [m]
  std::vector<std::uint32_t> m_order;  // along the axis; none of few corners
  std::vector<std::uint32_t> m_rank;   // of each corner in that order
  std::vector<std::uint32_t> m_skip;   // of each rank, towards the next that is left
  std::size_t m_compared = 0;
};

}  // namespace

std::size_t clipEars(const FlatLoop& loop, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  return EarRing(loop, triangles).clip();
}

}  // namespace rubble::cooking
