#include "cook/windings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <tuple>

namespace rubble::cooking {
namespace {

// A bound for time: boxes that are asked whether a line passes them.
constexpr std::size_t kMostLooks = 1'000'000'000;
constexpr std::uint32_t kBlock = 64;  // triangles whose boxes are asked together

int jumpOf(const Facet& facet) {  // from the front to the back
  int jump = 0;
  for (const Cover& cover : facet.covers) jump += cover.way;
  return jump;
}

bool isPassed(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& start, const Eigen::Array3d& pace) {
  const Eigen::Array3d one = (box.min() - start).array() * pace;
  const Eigen::Array3d other = (box.max() - start).array() * pace;
  const double enters = one.min(other).maxCoeff(), leaves = one.max(other).minCoeff();
  return leaves >= 0 && enters <= leaves;
}

// Boxes of the triangles, and what stands on a line through them.
class Views {
 public:
  explicit Views(const Arrangement& arrangement) : m_arrangement(arrangement), m_random(1) {
    const Soup& soup = arrangement.soup;
    for (const auto& triangle : soup.triangles) {
      auto& box = m_boxes.emplace_back();
      for (const std::uint32_t v : triangle) box.extend(soup.vertices[v]);
      m_bounds.extend(box);
    }
    const double slack = 1e-9 * m_bounds.diagonal().norm();
    for (auto& box : m_boxes) {
      box.min().array() -= slack;
      box.max().array() += slack;
    }
    for (std::size_t t = 0; t < m_boxes.size(); ++t) {
      if (t % kBlock == 0) m_blocks.emplace_back();
      m_blocks.back().extend(m_boxes[t]);
    }
  }

  /// How often surfaces go round the front of a facet.
  int roundsBefore(const Facet& facet) {
    m_looks += m_blocks.size();
    if (m_looks > kMostLooks) throw Refused{"they cut each other too often"};
    const auto& p = m_arrangement.places;
    const Place& a = p[facet.corners[0]];
    const Place& b = p[facet.corners[1]];
    const Place& c = p[facet.corners[2]];
    const Place eye = CGAL::centroid(a, b, c);
    for (int tries = 0; tries < 100; ++tries) {
      std::array<int, 3> way{};
      for (int& step : way) step = int(m_random() % 2001) - 1000;
      Exact::Vector_3 ahead(way[0], way[1], way[2]);
      const auto side = CGAL::orientation(a, b, c, eye + ahead);
      if (side == CGAL::COPLANAR) continue;
      const int sign = side == CGAL::POSITIVE ? 1 : -1;
      if (sign < 0) ahead = -ahead;
      const Eigen::Vector3d line(sign * way[0], sign * way[1], sign * way[2]);
      if (const auto rounds = countAhead(facet, eye, eye + ahead, line)) return *rounds;
    }
    throw Refused{"no line through them is clear"};
  }

 private:
  // Nothing where the line meets an edge.
  std::optional<int> countAhead(const Facet& facet, const Place& eye, const Place& ahead,
                                const Eigen::Vector3d& line) {
    const auto& [soup, placeOf, places] =
        std::tie(m_arrangement.soup, m_arrangement.placeOf, m_arrangement.places);
    const Eigen::Vector3d start(CGAL::to_double(eye.x()), CGAL::to_double(eye.y()), CGAL::to_double(eye.z()));
    const Eigen::Array3d pace = line.array().inverse();
    int rounds = 0;
    for (std::uint32_t t = 0; t < m_boxes.size(); ++t) {
      if (t % kBlock == 0 && !isPassed(m_blocks[t / kBlock], start, pace)) {
        t += kBlock - 1;
        continue;
      }
      ++m_looks;
      if (m_arrangement.isFlat[t] || !isPassed(m_boxes[t], start, pace)) continue;
      if (std::any_of(facet.covers.begin(), facet.covers.end(),
                      [t](const Cover& own) { return own.source == t; }))
        continue;
      std::array<const Place*, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = &places[placeOf[soup.triangles[t][k]]];
      std::array<CGAL::Orientation, 3> ways{};
      for (std::size_t k = 0; k < 3; ++k)
        ways[k] = CGAL::orientation(eye, ahead, *corners[k], *corners[(k + 1) % 3]);
      const bool isLeft = std::find(ways.begin(), ways.end(), CGAL::POSITIVE) != ways.end();
      const bool isRight = std::find(ways.begin(), ways.end(), CGAL::NEGATIVE) != ways.end();
      if (isLeft && isRight) continue;
      if (std::find(ways.begin(), ways.end(), CGAL::COPLANAR) != ways.end()) return std::nullopt;
      // Seen along the line the corners go round to the left where the triangle is passed outwards.
      const bool isOutwards = isLeft;
      const auto side = CGAL::orientation(*corners[0], *corners[1], *corners[2], eye);
      if (side == (isOutwards ? CGAL::NEGATIVE : CGAL::POSITIVE)) rounds += isOutwards ? 1 : -1;
    }
    return rounds;
  }

  const Arrangement& m_arrangement;
  std::vector<Eigen::AlignedBox3d> m_boxes, m_blocks;  // of triangles, and of so many that follow each other
  Eigen::AlignedBox3d m_bounds;
  std::mt19937 m_random;
  std::size_t m_looks = 0;
};

Soup facetSoup(const Arrangement& arrangement) {
  Soup soup;
  for (const Facet& facet : arrangement.facets) soup.triangles.push_back(facet.corners);
  return soup;
}

}  // namespace

// Across an edge of two facets nothing else ends, so what lies to both sides of one is known from the other.
void countWindings(Arrangement& arrangement) {
  std::vector<Facet>& facets = arrangement.facets;
  struct Step {
    std::uint32_t facet;
    bool turnAlike;
  };
  std::vector<std::vector<Step>> steps(facets.size());
  forEachEdge(sortedEdges(facetSoup(arrangement)), [&](std::span<const SoupEdge> sides) {
    if (sides.size() != 2) return;
    const bool turnAlike = sides[0].upward != sides[1].upward;
    steps[sides[0].triangle].push_back({sides[1].triangle, turnAlike});
    steps[sides[1].triangle].push_back({sides[0].triangle, turnAlike});
  });
  Views views(arrangement);
  std::vector<bool> isKnown(facets.size(), false);
  for (std::uint32_t seed = 0; seed < facets.size(); ++seed) {
    if (isKnown[seed]) continue;
    facets[seed].front = views.roundsBefore(facets[seed]);
    facets[seed].back = facets[seed].front + jumpOf(facets[seed]);
    isKnown[seed] = true;
    std::vector<std::uint32_t> patch = {seed};
    for (std::size_t at = 0; at < patch.size(); ++at)
      for (const auto& [next, turnAlike] : steps[patch[at]]) {
        if (isKnown[next]) continue;
        isKnown[next] = true;
        facets[next].front = turnAlike ? facets[patch[at]].front : facets[patch[at]].back;
        facets[next].back = turnAlike ? facets[patch[at]].back : facets[patch[at]].front;
        patch.push_back(next);
      }
  }
}

}  // namespace rubble::cooking
