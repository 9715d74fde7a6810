#include "cook/mend_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "base/groups.h"
#include "cook/unite_parts.h"

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

// What is told of: where triangles merely touch, nothing is amiss.
bool pierce(const Soup& soup, const Crossing& crossing) {
  const Corners one = cornersOf(soup, crossing[0]), other = cornersOf(soup, crossing[1]);
  return pierces(one, other) || pierces(other, one);
}

void tell(const Soup& soup, const Crossing& crossing, Mended& mended) {
  if (mended.crossings++ == 0) mended.crossing = soup.vertices[soup.triangles[crossing[0]][0]];
}

// Shells that hang together by crossings or as cavities, and their number of solids.
struct Heap {
  std::vector<std::uint32_t> shells;
  std::size_t solids = 0;
};

std::vector<Heap> findHeaps(const std::vector<std::uint32_t>& hosts, const Crossed& crossed,
                            const std::vector<bool>& isWanted) {
  base::Groups groups(hosts.size());
  for (const auto& [a, b] : crossed)
    if (isWanted[a] && isWanted[b]) groups.join(a, b);
  for (std::uint32_t s = 0; s < hosts.size(); ++s)
    if (hosts[s] != kNoElement) groups.join(s, hosts[s]);
  std::vector<Heap> heaps(hosts.size());
  for (std::uint32_t s = 0; s < hosts.size(); ++s) {
    if (!isWanted[s]) continue;
    heaps[groups.of(s)].shells.push_back(s);
    heaps[groups.of(s)].solids += hosts[s] == kNoElement ? 1 : 0;
  }
  std::erase_if(heaps, [](const Heap& heap) { return heap.solids < 2; });
  return heaps;
}

// The triangles of a heap, solids turned outwards, with the shell of each.
struct HeapSoup {
  Soup soup;
  std::vector<std::uint32_t> shells;  // from 0 within the heap
  std::vector<Crossing> crossings;
};

HeapSoup soupOf(const Heap& heap, const Soup& soup, const Shells& shells,
                const std::vector<std::uint32_t>& hosts, const std::vector<Crossing>& crossings) {
  HeapSoup own;
  std::vector<std::uint32_t> ids(soup.triangles.size(), kNoElement),
      vertices(soup.vertices.size(), kNoElement);
  for (std::uint32_t s = 0; s < heap.shells.size(); ++s) {
    const Shell& shell = shells.list[heap.shells[s]];
    const bool isInwards = hosts[heap.shells[s]] == kNoElement && shell.volume < 0;
    for (const std::uint32_t t : shell.triangles) {
      ids[t] = std::uint32_t(own.soup.triangles.size());
      auto corners = soup.triangles[t];
      for (std::uint32_t& v : corners) {
        if (vertices[v] == kNoElement) {
          vertices[v] = std::uint32_t(own.soup.vertices.size());
          own.soup.vertices.push_back(soup.vertices[v]);
        }
        v = vertices[v];
      }
      if (isInwards) std::swap(corners[1], corners[2]);
      own.soup.triangles.push_back(corners);
      own.soup.sources.push_back(soup.sources[t]);
      own.shells.push_back(s);
    }
  }
  for (const auto& [a, b] : crossings)
    if (ids[a] != kNoElement && ids[b] != kNoElement)
      own.crossings.push_back({std::min(ids[a], ids[b]), std::max(ids[a], ids[b])});
  return own;
}

void append(const Soup& added, Soup& soup) {
  const auto first = std::uint32_t(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), added.vertices.begin(), added.vertices.end());
  for (const auto& [a, b, c] : added.triangles) soup.triangles.push_back({first + a, first + b, first + c});
  soup.sources.insert(soup.sources.end(), added.sources.begin(), added.sources.end());
}

// How fine a grid is that corners move to, where the union as it is passes through itself once it is rounded:
// what lay on each other but for a rounding then does, or is farther apart than roundings are [share of its
// size].
constexpr std::array kGrids = {0.0, 0x1p-42, 0x1p-36, 0x1p-30};

void moveToGrid(std::vector<Eigen::Vector3d>& places, double share) {
  if (share == 0) return;
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& place : places) bounds.extend(place);
  const double largest = std::max(bounds.max().cwiseAbs().maxCoeff(), bounds.min().cwiseAbs().maxCoeff());
  const double step = std::exp2(std::ceil(std::log2(largest))) * share;
  for (Eigen::Vector3d& place : places) place = (place / step).array().round() * step;
}

// What passes through each other once a union is rounded.
std::size_t countPierced(const HeapSoup& heap, const United& united) {
  Soup whole = heap.soup;
  std::vector<bool> isGone;
  for (const std::uint32_t shell : heap.shells) isGone.push_back(!united.isKept[shell]);
  dropTriangles(whole, isGone);
  append(united.soup, whole);
  const std::vector<Crossing> crossings = findCrossings(whole);
  return std::size_t(std::count_if(crossings.begin(), crossings.end(),
                                   [&whole](const Crossing& crossing) { return pierce(whole, crossing); }));
}

// The first that does not pass through itself, or else the best.
United unionOf(const HeapSoup& heap, std::size_t& pierced) {
  United best;
  for (const double grid : kGrids) {
    Soup moved = heap.soup;
    moveToGrid(moved.vertices, grid);
    United united = uniteShells(moved, heap.shells, grid == 0 ? heap.crossings : findCrossings(moved));
    const std::size_t own = united.refusal.empty() ? countPierced(heap, united) : 0;
    const bool isBetter = united.refusal.empty() && (!best.refusal.empty() || own < pierced);
    if (grid == 0 || isBetter) {
      best = std::move(united);
      pierced = own;
    }
    if (best.refusal.empty() && pierced == 0) break;
  }
  return best;
}

// The shells that cross none are left as they are, and so are those that cross themselves.
void uniteParts(Soup& soup, const std::vector<Crossing>& crossings, Mended& mended) {
  if (crossings.empty()) return;
  Shells shells = findShells(soup);
  Crossed crossed;
  for (const Crossing& crossing : crossings) {
    const std::uint32_t a = shells.of[crossing[0]], b = shells.of[crossing[1]];
    if (a != b)
      crossed.insert({std::min(a, b), std::max(a, b)});
    else if (!shells.list[a].isCrossed)
      shells.list[a].isCrossed = pierce(soup, crossing);
  }
  std::vector<bool> isWanted(shells.list.size(), false);
  for (const auto& [a, b] : crossed)
    for (const std::uint32_t shell : {a, b}) isWanted[shell] = !shells.list[shell].isCrossed;
  for (std::uint32_t s = 0; s < shells.list.size(); ++s)  // cavities of parts that cross others
    isWanted[s] = isWanted[s] || (!crossed.empty() && shells.list[s].volume < 0 && !shells.list[s].isCrossed);

  const std::vector<std::uint32_t> hosts = findHosts(soup, shells.list, crossed, isWanted);
  Soup fresh;
  std::vector<bool> isGone(soup.triangles.size(), false), isSettled(shells.list.size(), false);
  for (const Heap& heap : findHeaps(hosts, crossed, isWanted)) {
    const HeapSoup own = soupOf(heap, soup, shells, hosts, crossings);
    std::size_t pierced = 0;
    const United united = unionOf(own, pierced);
    if (!united.refusal.empty()) {
      mended.notUnited.push_back({heap.solids, united.refusal});
      continue;
    }
    for (std::uint32_t s = 0; s < heap.shells.size(); ++s) {
      isSettled[heap.shells[s]] = true;
      if (united.isKept[s]) continue;
      mended.united += hosts[heap.shells[s]] == kNoElement ? 1 : 0;
      for (const std::uint32_t t : shells.list[heap.shells[s]].triangles) isGone[t] = true;
    }
    if (pierced > 0 && !united.soup.vertices.empty() && mended.crossings == 0)
      mended.crossing = united.soup.vertices[united.soup.triangles[0][0]];
    mended.crossings += pierced;
    for (const Shell& shell : findShells(united.soup).list) mended.remaining += shell.volume > 0 ? 1 : 0;
    append(united.soup, fresh);
  }
  for (const Crossing& crossing : crossings) {
    const std::uint32_t a = shells.of[crossing[0]], b = shells.of[crossing[1]];
    if (!(isSettled[a] && isSettled[b]) && pierce(soup, crossing)) tell(soup, crossing, mended);
  }
  if (fresh.triangles.empty()) return;
  dropTriangles(soup, isGone);
  append(fresh, soup);
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
  if (options.unite) {
    uniteParts(soup, crossings, mended);
  } else {
    for (const Crossing& crossing : crossings)
      if (pierce(soup, crossing)) tell(soup, crossing, mended);
  }
  if (mended.crossings == 0) {
    turnOutwards(soup);
  } else if (volumeOf(soup) < 0) {  // which shell is within which cannot be told
    for (auto& triangle : soup.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mended;
}

}  // namespace rubble::cooking
