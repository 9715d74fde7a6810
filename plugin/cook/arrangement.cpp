#include "cook/arrangement.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "base/groups.h"

namespace rubble::cooking {
namespace {

using Flat = Exact::Point_2;
using Cuts = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Exact, CGAL::Default, CGAL::Exact_intersections_tag>>;

// Bounds for time and memory.
constexpr std::size_t kMostPlaces = 400'000;  // corners of facets
constexpr std::size_t kMostInPlane = 5'000;  // triangles that overlap in a plane: each facet asks all of them

std::array<CGAL::Orientation, 3> sidesOf(const std::array<Doubles::Point_3, 3>& plane,
                                         const std::array<Doubles::Point_3, 3>& points) {
  std::array<CGAL::Orientation, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) sides[k] = CGAL::orientation(plane[0], plane[1], plane[2], points[k]);
  return sides;
}

bool areAll(const std::array<CGAL::Orientation, 3>& sides, CGAL::Orientation side) {
  return sides[0] == side && sides[1] == side && sides[2] == side;
}

}  // namespace

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

}  // namespace rubble::cooking
