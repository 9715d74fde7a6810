#include "cook/mend_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "base/groups.h"

namespace rubble::cooking {
namespace {

namespace Processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Face = Mesh::Face_index;
using Half = Mesh::Halfedge_index;
using Sources = Mesh::Property_map<Face, Source>;

// Beyond this CGAL's search through all triangulations of a hole, with the cube of its edges, takes seconds.
constexpr std::size_t kMostSearchedEdges = 200;
// Of the size of a hole: what is flatter is triangulated in its plane.
constexpr double kFlatHole = 1e-3;
// An overlap of parts below this share of the cubed size of the mesh is none: they touch.
constexpr double kNoOverlap = 1e-12;

Sources sourcesOf(Mesh& mesh) {
  return mesh.add_property_map<Face, Source>("f:source").first;
}

// The triangles `chosen` as a mesh of their own.
Mesh meshOf(const Soup& soup, const std::vector<std::uint32_t>& chosen) {
  Mesh mesh;
  const Sources sources = sourcesOf(mesh);
  std::vector<Mesh::Vertex_index> vertices(soup.vertices.size());
  for (const std::uint32_t t : chosen) {
    std::array<Mesh::Vertex_index, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      Mesh::Vertex_index& vertex = vertices[soup.triangles[t][k]];
      const Eigen::Vector3d& p = soup.vertices[soup.triangles[t][k]];
      if (!vertex.is_valid()) vertex = mesh.add_vertex(Point(p.x(), p.y(), p.z()));
      corners[k] = vertex;
    }
    const Face face = mesh.add_face(corners[0], corners[1], corners[2]);
    if (face.is_valid()) sources[face] = soup.sources[t];
  }
  return mesh;
}

void append(const Mesh& mesh, Soup& soup) {
  const auto sources = mesh.property_map<Face, Source>("f:source").first;
  std::vector<std::uint32_t> ids(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), kNoElement);
  for (const Face face : mesh.faces()) {
    auto& triangle = soup.triangles.emplace_back();
    std::size_t k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) {
      std::uint32_t& id = ids[vertex];
      if (id == kNoElement) {
        id = std::uint32_t(soup.vertices.size());
        const Point& p = mesh.point(vertex);
        soup.vertices.emplace_back(p.x(), p.y(), p.z());
      }
      triangle[k++] = id;
    }
    soup.sources.push_back(sources[face]);
  }
}

std::vector<std::uint32_t> allOf(const Soup& soup) {
  std::vector<std::uint32_t> all(soup.triangles.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return all;
}

Eigen::Vector3d place(const Mesh& mesh, Mesh::Vertex_index vertex) {
  const Point& p = mesh.point(vertex);
  return {p.x(), p.y(), p.z()};
}

struct Outline {
  std::size_t edges = 0;
  double area = 0;  // of its projection along the direction that makes it largest [m^2]
  double across = 0;
};

Outline outlineOf(const Mesh& mesh, Half border) {
  Outline outline;
  const Eigen::Vector3d origin = place(mesh, mesh.source(border));
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (const Half half : CGAL::halfedges_around_face(border, mesh)) {
    const Eigen::Vector3d from = place(mesh, mesh.source(half)) - origin;
    const Eigen::Vector3d to = place(mesh, mesh.target(half)) - origin;
    area += from.cross(to) / 2;
    outline.across = std::max(outline.across, to.norm());
    ++outline.edges;
  }
  outline.area = area.norm();
  return outline;
}

std::vector<Face> fill(Mesh& mesh, Half border, const Outline& outline) {
  std::vector<Face> faces;
  if (outline.edges == 3) {
    CGAL::Euler::fill_hole(border, mesh);
    return {mesh.face(border)};
  }
  Processing::triangulate_hole(mesh, border, std::back_inserter(faces),
                               CGAL::parameters::use_2d_constrained_delaunay_triangulation(true)
                                   .threshold_distance(kFlatHole * outline.across)
                                   .do_not_use_cubic_algorithm(outline.edges > kMostSearchedEdges));
  return faces;
}

// A halfedge of each hole's outline.
std::vector<Half> findHoles(const Mesh& mesh) {
  std::vector<bool> isSeen(mesh.number_of_halfedges(), false);
  std::vector<Half> holes;
  for (const Half half : mesh.halfedges()) {
    if (!mesh.is_border(half) || isSeen[half]) continue;
    holes.push_back(half);
    for (const Half next : CGAL::halfedges_around_face(half, mesh)) isSeen[next] = true;
  }
  return holes;
}

void fillHoles(Soup& soup, const RepairOptions& options, Mended& mended) {
  if (openEdges(soup).empty()) return;
  Mesh mesh = meshOf(soup, allOf(soup));
  const Sources sources = mesh.property_map<Face, Source>("f:source").first;
  const auto parts = mesh.add_property_map<Face, std::size_t>("f:part").first;
  std::vector<double> areas(Processing::connected_components(mesh, parts), 0);
  for (const Face face : mesh.faces()) areas[parts[face]] += Processing::face_area(face, mesh);
  for (const Half border : findHoles(mesh)) {
    const Face beside = mesh.face(mesh.opposite(border));
    const Outline outline = outlineOf(mesh, border);
    const bool isSmall = outline.edges <= options.mostHoleEdges || options.mostHoleEdges == 0;
    const double largest = options.largestHole * areas[parts[beside]];
    std::vector<Face> faces;
    if (isSmall && outline.area <= largest) faces = fill(mesh, border, outline);
    double area = 0;
    for (const Face face : faces) {
      area += Processing::face_area(face, mesh);
      sources[face] = {sources[beside].triangle, true};
    }
    if (area > largest)
      for (const Face face : std::exchange(faces, {})) CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
    if (faces.empty()) {
      mended.tooLarge.push_back({outline.edges, std::max(area, outline.area)});
    } else {
      mended.filled.push_back({outline.edges, area});
    }
  }
  mesh.collect_garbage();
  soup = {};
  append(mesh, soup);
}

// Tells the pieces of a cut triangle whence they come.
struct KeepSources : Processing::Corefinement::Default_visitor<Mesh> {
  void before_subface_creations(Face face, Mesh& mesh) { whole = sourcesOf(mesh)[face]; }
  void after_subface_created(Face face, Mesh& mesh) { sourcesOf(mesh)[face] = whole; }
  void after_face_copy(Face from, const Mesh& source, Face to, Mesh& target) {
    sourcesOf(target)[to] = source.property_map<Face, Source>("f:source").first[from];
  }
  Source whole;
};

std::optional<Mesh> unionOf(Mesh first, Mesh second) {
  Mesh result;
  sourcesOf(result);
  try {
    if (!Processing::corefine_and_compute_union(
            first, second, result, CGAL::parameters::visitor(KeepSources()).throw_on_self_intersection(true)))
      return std::nullopt;
  } catch (const std::exception&) {  // passes through itself, or is too nearly flat for CGAL
    return std::nullopt;
  }
  if (!result.is_valid(false) || !CGAL::is_closed(result) || !CGAL::is_triangle_mesh(result))
    return std::nullopt;
  return result;
}

// 0 where they only touch, at edges and corners.
double overlapOf(Mesh first, Mesh second) {
  Mesh result;
  sourcesOf(result);
  try {
    if (!Processing::corefine_and_compute_intersection(
            first, second, result, CGAL::parameters::visitor(KeepSources()).throw_on_self_intersection(true)))
      return 1;
  } catch (const std::exception&) {
    return 1;
  }
  return result.is_empty() ? 0 : std::abs(CGAL::to_double(Processing::volume(result)));
}

// A closed surface of the soup.
struct Shell {
  std::vector<std::uint32_t> triangles;
  double volume = 0;       // [m^3]; inwards below 0
  bool isCrossed = false;  // passes through itself
};

struct Shells {
  std::vector<Shell> list;
  std::vector<std::uint32_t> of;  // a triangle
};

Shells findShells(const Soup& soup) {
  base::Groups groups(soup.vertices.size());
  for (const auto& [a, b, c] : soup.triangles) {
    groups.join(a, b);
    groups.join(b, c);
  }
  Shells shells;
  std::vector<std::uint32_t> shellOf(soup.vertices.size(), kNoElement);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    std::uint32_t& shell = shellOf[groups.of(a)];
    if (shell == kNoElement) {
      shell = std::uint32_t(shells.list.size());
      shells.list.emplace_back();
    }
    Shell& own = shells.list[shell];
    own.triangles.push_back(t);
    const Eigen::Vector3d& origin = soup.vertices[soup.triangles[own.triangles[0]][0]];
    own.volume +=
        (soup.vertices[a] - origin).dot((soup.vertices[b] - origin).cross(soup.vertices[c] - origin)) / 6;
    shells.of.push_back(shell);
  }
  return shells;
}

using Crossing = std::array<std::uint32_t, 2>;  // triangles

std::vector<Crossing> findCrossings(const Soup& soup) {
  Mesh mesh = meshOf(soup, allOf(soup));
  std::vector<Face> faces;
  for (const Face face : mesh.faces())
    if (!Processing::is_degenerate_triangle_face(face, mesh)) faces.push_back(face);
  std::vector<std::pair<Face, Face>> pairs;
  Processing::self_intersections(faces, mesh, std::back_inserter(pairs));
  std::vector<Crossing> crossings;
  for (const auto& [a, b] : pairs) crossings.push_back({std::uint32_t(a), std::uint32_t(b)});
  for (Crossing& crossing : crossings) std::sort(crossing.begin(), crossing.end());
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

using Crossed = std::set<std::array<std::uint32_t, 2>>;  // shells, the smaller first

// A solid with the shells it was made of.
struct Part {
  std::vector<std::uint32_t> shells;
  Mesh mesh;
  bool isPinched = false;  // touches itself
};

bool meet(const Part& a, const Part& b, const Crossed& crossed) {
  for (const std::uint32_t own : a.shells)
    for (const std::uint32_t other : b.shells)
      if (crossed.contains({std::min(own, other), std::max(own, other)})) return true;
  return false;
}

bool canCut(const Part& a, const Part& b, const Crossed& crossed) {
  return !a.isPinched && !b.isPinched && meet(a, b, crossed);
}

// Shells turned inwards that lie inside of one turned outwards which they do not cross are its cavities, also
// where something else crosses both. Shells that stand alone have no host.
std::vector<std::uint32_t> findHosts(const Soup& soup, const std::vector<Shell>& shells,
                                     const Crossed& crossed, const std::vector<bool>& isWanted) {
  std::vector<std::uint32_t> hosts(shells.size(), kNoElement);
  for (std::uint32_t outer = 0; outer < shells.size(); ++outer) {
    if (!isWanted[outer] || shells[outer].volume <= 0) continue;
    const Mesh mesh = meshOf(soup, shells[outer].triangles);
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> sideOf(mesh);
    for (std::uint32_t inner = 0; inner < shells.size(); ++inner) {
      if (!isWanted[inner] || shells[inner].volume >= 0) continue;
      if (crossed.contains({std::min(inner, outer), std::max(inner, outer)})) continue;
      const Eigen::Vector3d& p = soup.vertices[soup.triangles[shells[inner].triangles[0]][0]];
      if (sideOf(Point(p.x(), p.y(), p.z())) != CGAL::ON_BOUNDED_SIDE) continue;
      if (hosts[inner] == kNoElement || shells[outer].volume < shells[hosts[inner]].volume)
        hosts[inner] = outer;
    }
  }
  return hosts;
}

// Solids of the wanted shells, turned outwards and with their cavities, ready to be cut.
std::vector<Part> partsOf(const Soup& soup, const std::vector<Shell>& shells, const Crossed& crossed,
                          const std::vector<bool>& isWanted) {
  const std::vector<std::uint32_t> hosts = findHosts(soup, shells, crossed, isWanted);
  std::vector<Part> parts;
  std::vector<std::vector<std::uint32_t>> shellsOf(shells.size());
  for (std::uint32_t s = 0; s < shells.size(); ++s)
    if (isWanted[s]) shellsOf[hosts[s] == kNoElement ? s : hosts[s]].push_back(s);
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    if (shellsOf[s].empty()) continue;
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t shell : shellsOf[s])
      triangles.insert(triangles.end(), shells[shell].triangles.begin(), shells[shell].triangles.end());
    Mesh mesh = meshOf(soup, triangles);
    if (shells[s].volume < 0) Processing::reverse_face_orientations(mesh);
    Processing::remove_degenerate_faces(mesh);
    mesh.collect_garbage();
    const bool isPinched = Processing::does_self_intersect(mesh);  // also once flat triangles are gone
    parts.push_back({std::move(shellsOf[s]), std::move(mesh), isPinched});
  }
  return parts;
}

// Unites as many of the parts as can be. A union may touch itself, at a corner or an edge: CGAL cannot cut
// such a one again, it reads memory that is none. So it is taken only if `pinchedToo`.
void unite(std::vector<Part>& parts, const Crossed& crossed, bool pinchedToo) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size();) {
      auto whole = canCut(parts[i], parts[j], crossed) ? unionOf(parts[i].mesh, parts[j].mesh) : std::nullopt;
      const bool isPinched = whole && Processing::does_self_intersect(*whole);
      if (!whole || (isPinched && !pinchedToo)) {
        ++j;
        continue;
      }
      parts[i].mesh = *std::move(whole);
      parts[i].isPinched = isPinched;
      parts[i].shells.insert(parts[i].shells.end(), parts[j].shells.begin(), parts[j].shells.end());
      parts.erase(parts.begin() + std::ptrdiff_t(j));
      j = i + 1;  // what did not meet it before may now
    }
}

double cubedSize(const Soup& soup) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : soup.vertices) bounds.extend(vertex);
  return std::pow(bounds.diagonal().norm(), 3);
}

using Corners = std::array<Point, 3>;

Corners cornersOf(const Soup& soup, std::uint32_t triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& p = soup.vertices[soup.triangles[triangle][k]];
    corners[k] = Point(p.x(), p.y(), p.z());
  }
  return corners;
}

// Whether an edge of one goes through the inside of the other: they do not merely touch.
bool pierces(const Corners& one, const Corners& other) {
  const auto& [a, b, c] = other;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &p = one[k], &q = one[(k + 1) % 3];
    const CGAL::Orientation from = CGAL::orientation(a, b, c, p), to = CGAL::orientation(a, b, c, q);
    if (from == CGAL::COPLANAR || to == CGAL::COPLANAR || from == to) continue;
    const CGAL::Orientation side = CGAL::orientation(p, q, a, b);
    if (side != CGAL::COPLANAR && side == CGAL::orientation(p, q, b, c) &&
        side == CGAL::orientation(p, q, c, a))
      return true;
  }
  return false;
}

// Leaves what passes through another as it is, and says where.
void tellCrossings(const Soup& soup, const std::vector<Crossing>& crossings, Mended& mended) {
  for (const auto& [a, b] : crossings) {
    const Corners one = cornersOf(soup, a), other = cornersOf(soup, b);
    if (!pierces(one, other) && !pierces(other, one)) continue;
    if (mended.crossings++ == 0) mended.crossing = soup.vertices[soup.triangles[a][0]];
  }
}

// The shells that cross none are left as they are, and so are those that cross themselves.
void uniteParts(Soup& soup, const std::vector<Crossing>& crossings, Mended& mended) {
  if (crossings.empty()) return;
  Shells shells = findShells(soup);
  Crossed crossed;
  for (const auto& [a, b] : crossings)
    if (shells.of[a] == shells.of[b]) {
      shells.list[shells.of[a]].isCrossed = true;
    } else {
      crossed.insert({std::min(shells.of[a], shells.of[b]), std::max(shells.of[a], shells.of[b])});
    }
  std::vector<bool> isWanted(shells.list.size(), false);
  for (const auto& [a, b] : crossed)
    for (const std::uint32_t shell : {a, b}) isWanted[shell] = !shells.list[shell].isCrossed;
  for (std::uint32_t s = 0; s < shells.list.size(); ++s)  // cavities of parts that cross others
    isWanted[s] = isWanted[s] || (!crossed.empty() && shells.list[s].volume < 0 && !shells.list[s].isCrossed);

  std::vector<Part> parts = partsOf(soup, shells.list, crossed, isWanted);
  const std::size_t before = parts.size();
  unite(parts, crossed, false);
  unite(parts, crossed, true);
  std::set<std::array<std::uint32_t, 2>> apart;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j)
      if (meet(parts[i], parts[j], crossed) &&
          (!canCut(parts[i], parts[j], crossed) ||
           overlapOf(parts[i].mesh, parts[j].mesh) > kNoOverlap * cubedSize(soup)))
        for (const std::uint32_t own : parts[i].shells)
          for (const std::uint32_t other : parts[j].shells)
            apart.insert({std::min(own, other), std::max(own, other)});
  for (const auto& [a, b] : crossings) {
    const std::uint32_t s = shells.of[a], t = shells.of[b];
    const bool isLeft = !isWanted[s] || !isWanted[t] || apart.contains({std::min(s, t), std::max(s, t)});
    if (isLeft && mended.crossings++ == 0) mended.crossing = soup.vertices[soup.triangles[a][0]];
  }
  if (parts.size() == before) return;
  for (const Part& part : parts)
    if (part.shells.size() > 1) ++mended.remaining;
  mended.united = before - parts.size() + mended.remaining;
  Soup united;
  for (const Part& part : parts) append(part.mesh, united);
  for (std::uint32_t s = 0; s < shells.list.size(); ++s)
    if (!isWanted[s]) append(meshOf(soup, shells.list[s].triangles), united);
  soup = std::move(united);
}

double volumeOf(const Soup& soup) {
  double volume = 0;
  for (const Shell& shell : findShells(soup).list) volume += shell.volume;
  return volume;
}

// Whether CGAL takes all of its triangles: not where two edges have the same ends.
bool isMesh(const Soup& soup) {
  return meshOf(soup, allOf(soup)).number_of_faces() == soup.triangles.size();
}

void turnOutwards(Soup& soup) {
  if (!isMesh(soup)) return;  // left for the check of the mesh to name
  Mesh mesh = meshOf(soup, allOf(soup));
  Processing::orient_to_bound_a_volume(mesh);
  soup = {};
  append(mesh, soup);
}

}  // namespace

Mended mendSurface(Soup& soup, const RepairOptions& options) {
  Mended mended;
  if (!isMesh(soup)) return mended;
  fillHoles(soup, options, mended);
  if (!openEdges(soup).empty()) return mended;
  const std::vector<Crossing> crossings = findCrossings(soup);
  if (options.unite)
    uniteParts(soup, crossings, mended);
  else
    tellCrossings(soup, crossings, mended);
  if (mended.crossings == 0) {
    turnOutwards(soup);
  } else if (volumeOf(soup) < 0) {  // which shell is within which cannot be told
    for (auto& triangle : soup.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mended;
}

}  // namespace rubble::cooking
