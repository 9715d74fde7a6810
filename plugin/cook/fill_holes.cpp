#include "cook/fill_holes.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <utility>

#include "cook/soup_mesh.h"

namespace rubble::cooking {
namespace {

namespace Processing = CGAL::Polygon_mesh_processing;
using Half = TriangleMesh::Halfedge_index;

// Beyond this CGAL's search through all triangulations of a hole, with the cube of its edges, takes seconds.
constexpr std::size_t kMostSearchedEdges = 200;
// Of the size of a hole: what is flatter is triangulated in its plane.
constexpr double kFlatHole = 1e-3;

Eigen::Vector3d meshPlace(const TriangleMesh& mesh, TriangleMesh::Vertex_index vertex) {
  const MeshPoint& p = mesh.point(vertex);
  return {p.x(), p.y(), p.z()};
}

struct Outline {
  std::size_t edges = 0;
  double area = 0;  // of its projection along the direction that makes it largest [m^2]
  double across = 0;
};

Outline outlineOf(const TriangleMesh& mesh, Half border) {
  Outline outline;
  const Eigen::Vector3d origin = meshPlace(mesh, mesh.source(border));
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (const Half half : CGAL::halfedges_around_face(border, mesh)) {
    const Eigen::Vector3d from = meshPlace(mesh, mesh.source(half)) - origin;
    const Eigen::Vector3d to = meshPlace(mesh, mesh.target(half)) - origin;
    area += from.cross(to) / 2;
    outline.across = std::max(outline.across, to.norm());
    ++outline.edges;
  }
  outline.area = area.norm();
  return outline;
}

std::vector<MeshFace> fill(TriangleMesh& mesh, Half border, const Outline& outline) {
  std::vector<MeshFace> faces;
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
std::vector<Half> findHoles(const TriangleMesh& mesh) {
  std::vector<bool> isSeen(mesh.number_of_halfedges(), false);
  std::vector<Half> holes;
  for (const Half half : mesh.halfedges()) {
    if (!mesh.is_border(half) || isSeen[half]) continue;
    holes.push_back(half);
    for (const Half next : CGAL::halfedges_around_face(half, mesh)) isSeen[next] = true;
  }
  return holes;
}

}  // namespace

bool isManifold(const Soup& soup) {
  return triangleMeshOf(soup, allTriangles(soup)).number_of_faces() == soup.triangles.size();
}

Holes fillHoles(Soup& soup, const RepairOptions& options) {
  Holes holes;
  if (openEdges(soup).empty()) return holes;
  TriangleMesh mesh = triangleMeshOf(soup, allTriangles(soup));
  const auto sources = mesh.property_map<MeshFace, Source>("f:source").first;
  const auto parts = mesh.add_property_map<MeshFace, std::size_t>("f:part").first;
  std::vector<double> areas(Processing::connected_components(mesh, parts), 0);
  for (const MeshFace face : mesh.faces()) areas[parts[face]] += Processing::face_area(face, mesh);
  for (const Half border : findHoles(mesh)) {
    const MeshFace beside = mesh.face(mesh.opposite(border));
    const Outline outline = outlineOf(mesh, border);
    const bool isSmall = outline.edges <= options.mostHoleEdges || options.mostHoleEdges == 0;
    const double largest = options.largestHole * areas[parts[beside]];
    std::vector<MeshFace> faces;
    if (isSmall && outline.area <= largest) faces = fill(mesh, border, outline);
    double area = 0;
    for (const MeshFace face : faces) {
      area += Processing::face_area(face, mesh);
      sources[face] = {sources[beside].triangle, true};
    }
    if (area > largest)
      for (const MeshFace face : std::exchange(faces, {}))
        CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
    if (faces.empty()) {
      holes.tooLarge.push_back({outline.edges, std::max(area, outline.area)});
    } else {
      holes.filled.push_back({outline.edges, area});
    }
  }
  mesh.collect_garbage();
  soup = {};
  appendMesh(mesh, soup);
  return holes;
}

}  // namespace rubble::cooking
