// Every triangle is cut where others meet it, into facets that meet others only at whole edges; a facet is on
// the surface of the union if some surface goes round the one side of it and none round the other.
#include "cook/unite_parts.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "base/groups.h"
#include "cook/shells.h"
#include "cook/surface_sides.h"

namespace rubble::cooking {
namespace {

using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Place = Exact::Point_3;
using Flat = Exact::Point_2;
using Cuts = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Exact, CGAL::Default, CGAL::Exact_intersections_tag>>;

// Bounds for time and memory: of a union of the most triangles some tens of seconds.
constexpr std::size_t kMostTriangles = 200'000;
constexpr std::size_t kMostCrossings = 400'000;
constexpr std::size_t kMostPlaces = 400'000;  // corners of facets
constexpr std::size_t kMostInPlane = 5'000;  // triangles that overlap in a plane: each facet asks all of them
constexpr std::size_t kMostLooks = 4'000'000'000;  // at a triangle from a facet

// Of the union, by rounding [share].
constexpr double kVolumeLost = 1e-9;

// Closed pieces that are smaller are left out [share of the union].
constexpr double kDust = 1e-12;

struct Refused {
  std::string why;
};

// A triangle that a facet is a piece of.
struct Cover {
  std::uint32_t source;
  int way;  // 1: turns as the facet does; -1: against it
};

struct Facet {
  std::array<std::uint32_t, 3> corners;  // places
  std::vector<Cover> covers;
  int front = 0, back = 0;  // how often surfaces go round there
};

class Arrangement {
 public:
  Arrangement(const Soup& soup, const std::vector<Crossing>& crossings);

  std::vector<Facet> facets;
  std::vector<Place> places;             // exact
  std::vector<Eigen::Vector3d> rounded;  // the same
  const Soup& soup;
  std::vector<std::uint32_t> placeOf;  // vertices of the soup
  std::vector<bool> isFlat;            // triangles without area, which are left out

 private:
  struct Segment {
    Place from, to;  // the same for a point
  };

  std::uint32_t idOf(const Place& place);
  Doubles::Point_3 point(std::uint32_t triangle, std::size_t corner) const;
  const Place& place(std::uint32_t triangle, std::size_t corner) const;
  bool liesIn(std::uint32_t triangle, const Doubles::Point_3& point) const;
  void addPierced(std::uint32_t edges, std::uint32_t triangle, const std::array<CGAL::Orientation, 3>& sides,
                  std::vector<Place>& ends) const;
  std::optional<Segment> commonOf(std::uint32_t a, std::uint32_t b) const;
  void cut(const std::vector<std::uint32_t>& triangles, const std::vector<Segment>& segments);

  std::map<Place, std::uint32_t> m_ids;
};

std::array<CGAL::Orientation, 3> sidesOf(const std::array<Doubles::Point_3, 3>& plane,
                                         const std::array<Doubles::Point_3, 3>& points) {
  std::array<CGAL::Orientation, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) sides[k] = CGAL::orientation(plane[0], plane[1], plane[2], points[k]);
  return sides;
}

bool areAll(const std::array<CGAL::Orientation, 3>& sides, CGAL::Orientation side) {
  return sides[0] == side && sides[1] == side && sides[2] == side;
}

Arrangement::Arrangement(const Soup& given, const std::vector<Crossing>& crossings) : soup(given) {
  for (const Eigen::Vector3d& p : soup.vertices) placeOf.push_back(idOf(Place(p.x(), p.y(), p.z())));
  const auto count = std::uint32_t(soup.triangles.size());
  for (std::uint32_t t = 0; t < count; ++t)
    isFlat.push_back(CGAL::collinear(point(t, 0), point(t, 1), point(t, 2)));

  base::Groups planes(count);
  std::vector<bool> isMet(count, false);
  std::vector<Crossing> inSpace;
  for (const auto& [a, b] : crossings) {
    if (isFlat[a] || isFlat[b]) continue;
    isMet[a] = isMet[b] = true;
    if (areAll(sidesOf({point(a, 0), point(a, 1), point(a, 2)}, {point(b, 0), point(b, 1), point(b, 2)}),
               CGAL::COPLANAR))
      planes.join(a, b);
    else
      inSpace.push_back({a, b});
  }
  std::vector<std::vector<std::uint32_t>> triangles(count);
  for (std::uint32_t t = 0; t < count; ++t)
    if (!isFlat[t]) triangles[planes.of(t)].push_back(t);
  std::vector<std::vector<Segment>> segments(count);
  for (const auto& [a, b] : inSpace) {
    const std::optional<Segment> common = commonOf(a, b);
    if (!common) continue;
    segments[planes.of(a)].push_back(*common);
    segments[planes.of(b)].push_back(*common);
  }
  for (std::uint32_t plane = 0; plane < count; ++plane) {
    if (triangles[plane].empty()) continue;
    const std::uint32_t t = triangles[plane][0];
    if (triangles[plane].size() > 1 || isMet[t]) {
      cut(triangles[plane], segments[plane]);
    } else {
      const auto& [a, b, c] = soup.triangles[t];
      facets.push_back({{placeOf[a], placeOf[b], placeOf[c]}, {{t, 1}}});
    }
  }
  for (const Place& p : places) {
    const auto& exact = CGAL::exact(p);
    rounded.emplace_back(CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z()));
  }
}

std::uint32_t Arrangement::idOf(const Place& place) {
  const auto [at, isNew] = m_ids.try_emplace(place, std::uint32_t(places.size()));
  if (isNew) {
    places.push_back(place);
    if (places.size() > kMostPlaces + soup.vertices.size()) throw Refused{"they cut each other too often"};
  }
  return at->second;
}

Doubles::Point_3 Arrangement::point(std::uint32_t triangle, std::size_t corner) const {
  const Eigen::Vector3d& p = soup.vertices[soup.triangles[triangle][corner]];
  return {p.x(), p.y(), p.z()};
}

const Place& Arrangement::place(std::uint32_t triangle, std::size_t corner) const {
  return places[placeOf[soup.triangles[triangle][corner]]];
}

// A point of its plane.
bool Arrangement::liesIn(std::uint32_t t, const Doubles::Point_3& p) const {
  return Doubles::Triangle_3(point(t, 0), point(t, 1), point(t, 2)).has_on(p);
}

// Where edges go through a triangle from one side to the other, or end on it.
void Arrangement::addPierced(std::uint32_t edges, std::uint32_t triangle,
                             const std::array<CGAL::Orientation, 3>& sides, std::vector<Place>& ends) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Doubles::Point_3 p = point(edges, k), q = point(edges, next);
    if (sides[k] == CGAL::COPLANAR && liesIn(triangle, p)) ends.push_back(place(edges, k));
    if (sides[k] == CGAL::COPLANAR || sides[next] == CGAL::COPLANAR || sides[k] == sides[next]) continue;
    bool isLeft = false, isRight = false;
    for (std::size_t side = 0; side < 3; ++side) {
      const auto way = CGAL::orientation(p, q, point(triangle, side), point(triangle, (side + 1) % 3));
      isLeft = isLeft || way == CGAL::POSITIVE;
      isRight = isRight || way == CGAL::NEGATIVE;
    }
    if (isLeft && isRight) continue;
    ends.push_back(Exact().construct_plane_line_intersection_point_3_object()(
        place(triangle, 0), place(triangle, 1), place(triangle, 2), place(edges, k), place(edges, next)));
  }
}

// Of triangles that lie in no common plane.
std::optional<Arrangement::Segment> Arrangement::commonOf(std::uint32_t a, std::uint32_t b) const {
  const std::array<Doubles::Point_3, 3> one = {point(a, 0), point(a, 1), point(a, 2)};
  const std::array<Doubles::Point_3, 3> other = {point(b, 0), point(b, 1), point(b, 2)};
  std::vector<Place> ends;
  addPierced(a, b, sidesOf(other, one), ends);
  addPierced(b, a, sidesOf(one, other), ends);
  if (ends.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(ends.begin(), ends.end());  // all lie on a line
  return Segment{*least, *most};
}

// Triangles of a plane that overlap or touch there, cut together, so that their facets are the same.
void Arrangement::cut(const std::vector<std::uint32_t>& triangles, const std::vector<Segment>& segments) {
  if (triangles.size() > kMostInPlane) throw Refused{"too many of their triangles overlap in a plane"};
  const std::uint32_t first = triangles[0];
  std::size_t across = 0;
  const auto flat = [&across](const Place& p) {
    return across == 0 ? Flat(p.y(), p.z()) : across == 1 ? Flat(p.z(), p.x()) : Flat(p.x(), p.y());
  };
  const auto turnOf = [&](std::uint32_t t) {
    return CGAL::orientation(flat(place(t, 0)), flat(place(t, 1)), flat(place(t, 2)));
  };
  const auto& [i, j, k] = soup.triangles[first];
  const Eigen::Vector3d& origin = soup.vertices[i];
  (soup.vertices[j] - origin).cross(soup.vertices[k] - origin).cwiseAbs().maxCoeff(&across);
  for (std::size_t tries = 0; tries < 3 && turnOf(first) == CGAL::COLLINEAR; ++tries)
    across = (across + 1) % 3;

  Cuts cuts;
  std::map<Flat, std::uint32_t> known;
  const auto learn = [&](const Place& p) { known.try_emplace(flat(p), idOf(p)); };
  for (const std::uint32_t t : triangles)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      learn(place(t, corner));
      cuts.insert_constraint(flat(place(t, corner)), flat(place(t, (corner + 1) % 3)));
    }
  for (const auto& [from, to] : segments) {
    learn(from);
    learn(to);
    if (from == to)
      cuts.insert(flat(from));
    else
      cuts.insert_constraint(flat(from), flat(to));
    if (cuts.number_of_vertices() > kMostPlaces) throw Refused{"they cut each other too often"};
  }
  const auto idAt = [&](const Flat& p) {
    const auto at = known.find(p);
    if (at != known.end()) return at->second;
    const auto& x = p.x();
    const auto& y = p.y();
    const auto on = [&](int height) {
      return across == 0 ? Place(height, x, y) : across == 1 ? Place(y, height, x) : Place(x, y, height);
    };
    const std::uint32_t id = idOf(Exact().construct_plane_line_intersection_point_3_object()(
        place(first, 0), place(first, 1), place(first, 2), on(0), on(1)));
    known.emplace(p, id);
    return id;
  };
  struct Outline {
    std::array<Flat, 3> corners;
    CGAL::Orientation turn;
    CGAL::Bbox_2 bounds;
  };
  std::vector<Outline> outlines;
  for (const std::uint32_t t : triangles) {
    Outline& own = outlines.emplace_back(
        Outline{{flat(place(t, 0)), flat(place(t, 1)), flat(place(t, 2))}, turnOf(t), {}});
    for (const Flat& corner : own.corners) own.bounds += corner.bbox();
  }
  for (const auto face : cuts.finite_face_handles()) {
    Facet facet;
    for (int corner = 0; corner < 3; ++corner)
      facet.corners[std::size_t(corner)] = idAt(face->vertex(corner)->point());
    const Flat middle =
        CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [corners, turn, bounds] = outlines[t];
      bool isWithin = triangles.size() == 1;
      if (!isWithin && CGAL::do_overlap(bounds, middle.bbox())) {
        isWithin = true;
        for (std::size_t side = 0; side < 3 && isWithin; ++side)
          isWithin = CGAL::orientation(corners[side], corners[(side + 1) % 3], middle) == turn;
      }
      if (isWithin) facet.covers.push_back({triangles[t], turn == CGAL::POSITIVE ? 1 : -1});
    }
    if (!facet.covers.empty()) facets.push_back(std::move(facet));
  }
}

int jumpOf(const Facet& facet) {  // from the front to the back
  int jump = 0;
  for (const Cover& cover : facet.covers) jump += cover.way;
  return jump;
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
  }

  /// How often surfaces go round the front of a facet.
  int roundsBefore(const Facet& facet) {
    m_looks += m_boxes.size();
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
                                const Eigen::Vector3d& line) const {
    const auto& [soup, placeOf, places] =
        std::tie(m_arrangement.soup, m_arrangement.placeOf, m_arrangement.places);
    const Eigen::Vector3d start(CGAL::to_double(eye.x()), CGAL::to_double(eye.y()), CGAL::to_double(eye.z()));
    const Eigen::Array3d pace = line.array().inverse();
    int rounds = 0;
    for (std::uint32_t t = 0; t < m_boxes.size(); ++t) {
      const Eigen::Array3d one = (m_boxes[t].min() - start).array() * pace;
      const Eigen::Array3d other = (m_boxes[t].max() - start).array() * pace;
      const double enters = one.min(other).maxCoeff(), leaves = one.max(other).minCoeff();
      if (leaves < 0 || enters > leaves || m_arrangement.isFlat[t]) continue;
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
  std::vector<Eigen::AlignedBox3d> m_boxes;
  Eigen::AlignedBox3d m_bounds;
  std::mt19937 m_random;
  std::size_t m_looks = 0;
};

Soup facetSoup(const Arrangement& arrangement) {
  Soup soup;
  for (const Facet& facet : arrangement.facets) soup.triangles.push_back(facet.corners);
  return soup;
}

// Across an edge of two facets nothing else ends, so what lies to both sides of one is known from the other.
void countRounds(Arrangement& arrangement) {
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

bool isKeptAsGiven(const Facet& facet) {
  return facet.covers.size() == 1 && std::min(facet.front, facet.back) == 0 &&
         std::max(facet.front, facet.back) == 1;
}

// Corners that rounding brought to the same place become one. Triangles that have not three corners left go,
// and so does each two that lie on each other, back to back.
void joinRounded(Soup& soup) {
  std::map<std::array<double, 3>, std::uint32_t> ids;
  std::vector<std::uint32_t> idOf;
  for (std::uint32_t v = 0; v < soup.vertices.size(); ++v) {
    const Eigen::Vector3d& p = soup.vertices[v];
    idOf.push_back(ids.try_emplace({p.x(), p.y(), p.z()}, v).first->second);
  }
  std::vector<bool> isSpare(soup.triangles.size(), false);
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> lone;  // by corners from the least on
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    auto& corners = soup.triangles[t];
    for (std::uint32_t& v : corners) v = idOf[v];
    const auto& [a, b, c] = corners;
    isSpare[t] = a == b || b == c || c == a;
    if (isSpare[t]) continue;
    std::array<std::uint32_t, 3> key = corners;
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    const auto behind = lone.find({key[0], key[2], key[1]});
    if (behind == lone.end() || behind->second.empty()) {
      lone[key].push_back(t);
    } else {
      isSpare[t] = isSpare[behind->second.back()] = true;
      behind->second.pop_back();
    }
  }
  dropTriangles(soup, isSpare);
}

// Shells that lie between what was meant to lie on each other.
void dropDust(Soup& soup, double least) {
  const Shells shells = findShells(soup);
  std::vector<bool> isDust(soup.triangles.size());
  for (std::size_t t = 0; t < isDust.size(); ++t)
    isDust[t] = std::abs(shells.list[shells.of[t]].volume) < least;
  dropTriangles(soup, isDust);
}

Soup surfaceOf(const Arrangement& arrangement, const std::vector<std::uint32_t>& shells,
               const std::vector<bool>& isKept) {
  Soup soup{arrangement.rounded, {}, {}};
  for (const Facet& facet : arrangement.facets) {
    if ((facet.front > 0) == (facet.back > 0)) continue;
    const int way = facet.back > 0 ? 1 : -1;
    for (const auto& [source, own] : facet.covers) {
      if (own != way) continue;
      if (isKept[shells[source]]) break;
      auto corners = facet.corners;
      if (way < 0) std::swap(corners[1], corners[2]);
      soup.triangles.push_back(corners);
      soup.sources.push_back(arrangement.soup.sources[source]);
      break;
    }
  }
  return soup;
}

United unite(const Soup& soup, const std::vector<std::uint32_t>& shells,
             const std::vector<Crossing>& crossings, bool keepsLone) {
  if (soup.triangles.size() > kMostTriangles || crossings.size() > kMostCrossings)
    throw Refused{"they are too large"};
  Arrangement arrangement(soup, crossings);
  countRounds(arrangement);
  United united;
  united.isKept.assign(*std::max_element(shells.begin(), shells.end()) + 1, keepsLone);
  for (const Facet& facet : arrangement.facets) {
    if (facet.front < 0 || facet.back < 0) throw Refused{"they are inside out in places"};
    if (isKeptAsGiven(facet)) continue;
    for (const Cover& cover : facet.covers) united.isKept[shells[cover.source]] = false;
  }
  united.soup = surfaceOf(arrangement, shells, united.isKept);
  if (united.soup.triangles.empty()) return united;
  const Eigen::Vector3d origin = soup.vertices[soup.triangles[0][0]];
  for (std::uint32_t t = 0; t < united.soup.triangles.size(); ++t)
    united.volume += volumeAbout(united.soup, t, origin);
  joinRounded(united.soup);
  const bool isSurface = makeSided(united.soup) && openEdges(united.soup).empty();
  if (isSurface) dropDust(united.soup, kDust * united.volume);
  if (!isSurface || !(std::abs(volumeOf(united.soup) - united.volume) <= kVolumeLost * united.volume))
    united.refusal = "their union has details too fine for numbers of 64 bits";
  return united;
}

}  // namespace

United uniteShells(const Soup& soup, const std::vector<std::uint32_t>& shells,
                   const std::vector<Crossing>& crossings, bool keepsLone) {
  try {
    return unite(soup, shells, crossings, keepsLone);
  } catch (const Refused& refused) {
    United none;
    none.refusal = refused.why;
    return none;
  }
}

}  // namespace rubble::cooking
