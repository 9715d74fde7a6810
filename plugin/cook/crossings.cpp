#include "cook/crossings.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "cook/soup_mesh.h"

namespace rubble::cooking {
namespace {

using Corners = std::array<MeshPoint, 3>;

Corners cornersOf(const Soup& soup, std::uint32_t triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = meshPoint(soup.vertices[soup.triangles[triangle][k]]);
  return corners;
}

bool pierces(const Corners& one, const Corners& other) {
  const auto& [a, b, c] = other;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshPoint &p = one[k], &q = one[(k + 1) % 3];
    const CGAL::Orientation from = CGAL::orientation(a, b, c, p), to = CGAL::orientation(a, b, c, q);
    if (from == CGAL::COPLANAR || to == CGAL::COPLANAR || from == to) continue;
    const CGAL::Orientation side = CGAL::orientation(p, q, a, b);
    if (side != CGAL::COPLANAR && side == CGAL::orientation(p, q, b, c) &&
        side == CGAL::orientation(p, q, c, a))
      return true;
  }
  return false;
}

}  // namespace

std::vector<Crossing> findCrossings(const Soup& soup) {
  TriangleMesh mesh = triangleMeshOf(soup, allTriangles(soup));
  std::vector<MeshFace> faces;
  for (const MeshFace face : mesh.faces())
    if (!CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(face, mesh)) faces.push_back(face);
  std::vector<std::pair<MeshFace, MeshFace>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(faces, mesh, std::back_inserter(pairs));
  std::vector<Crossing> crossings;
  for (const auto& [a, b] : pairs) crossings.push_back({std::uint32_t(a), std::uint32_t(b)});
  for (Crossing& crossing : crossings) std::sort(crossing.begin(), crossing.end());
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

bool isPierced(const Soup& soup, const Crossing& crossing) {
  const Corners one = cornersOf(soup, crossing[0]), other = cornersOf(soup, crossing[1]);
  return pierces(one, other) || pierces(other, one);
}

}  // namespace rubble::cooking
