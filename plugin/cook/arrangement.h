// Triangles of a soup cut wherever they meet, by exact numbers.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cook/crossings.h"
#include "cook/soup.h"

namespace rubble::cooking {

using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Place = Exact::Point_3;

/// What is thrown where there is no union.
struct Refused {
  std::string why;
};

/// A triangle that a facet is a piece of.
struct Cover {
  std::uint32_t source;
  int way;  ///< 1: turns as the facet does; -1: against it
};

/// A piece of a plane that no triangle goes on beyond.
struct Facet {
  std::array<std::uint32_t, 3> corners;  ///< places
  std::vector<Cover> covers;
  int front = 0, back = 0;  ///< how often surfaces go round there
};

/// All places where triangles of a soup meet, and all triangles cut there, each two in their common plane
/// alike.
class Arrangement {
 public:
  Arrangement(const Soup& soup, const std::vector<Crossing>& crossings);

  std::vector<Facet> facets;
  std::vector<Place> places;             ///< exact
  std::vector<Eigen::Vector3d> rounded;  ///< the same
  const Soup& soup;
  std::vector<std::uint32_t> placeOf;  ///< of vertices of the soup
  std::vector<bool> isFlat;            ///< triangles without area, which are left out

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

}  // namespace rubble::cooking
