#include "cook/checked_mesh.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "base/number_text.h"
#include "rubble/limits.h"

namespace rubble {

SurfaceMesh boxMesh(const Eigen::Vector3d& size, const Eigen::Vector3d& centre) {
  for (const double edge : size)
    if (!limits::kLength.hold(edge))
      throw Error("box: edge of " + base::numberText(edge) + " m is not allowed, must be " +
                  limits::kLength.text() + " m");
  SurfaceMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {  // bit 0: x, bit 1: y, bit 2: z
    const Eigen::Vector3d side(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    mesh.vertices.push_back(centre + size.cwiseProduct(side));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

namespace cooking {
namespace {

// Beyond this no double arithmetic on squares and volumes is sure to stay finite and meaningful [m].
constexpr double kLargestCoordinate = 1e9;
// A closed mesh whose volume is below this share of its diagonal cubed is taken for one without inside.
constexpr double kSmallestVolumeShare = 1e-12;

template <class... Parts>
[[noreturn]] void fail(const Parts&... parts) {
  std::ostringstream text;
  text << "mesh: ";
  (text << ... << parts);
  throw Error(text.str());
}

std::string place(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return text.str();
}

void checkCorners(const SurfaceMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (a == b || b == c || c == a) fail("triangle ", t, " names vertex ", a == b ? a : c, " twice");
  }
}

// Copies the triangles and the vertices that they use; a stray vertex would widen the bounds.
void copyUsed(const SurfaceMesh& mesh, CheckedMesh& checked) {
  std::vector<std::uint32_t> newIndex(mesh.vertices.size(), kNoElement);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) newIndex[v] = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (newIndex[v] == kNoElement) continue;
    newIndex[v] = std::uint32_t(checked.vertices.size());
    checked.vertices.push_back(mesh.vertices[v]);
    checked.bounds.extend(mesh.vertices[v]);
  }
  checked.triangles = mesh.triangles;
  for (auto& triangle : checked.triangles)
    for (std::uint32_t& v : triangle) v = newIndex[v];
}

struct HalfEdge {
  std::uint32_t low, high;  // vertices
  std::uint32_t triangle, side;
  bool upward;  // runs from low to high
};

std::vector<HalfEdge> sortedHalfEdges(const CheckedMesh& mesh) {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t a = mesh.triangles[t][side];
      const std::uint32_t b = mesh.triangles[t][(side + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), t, side, a < b});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) < std::tie(b.low, b.high, b.triangle, b.side);
  });
  return halves;
}

void matchEdges(CheckedMesh& mesh) {
  mesh.triangleEdges.resize(mesh.triangles.size());
  mesh.neighbours.resize(mesh.triangles.size());
  const std::vector<HalfEdge> halves = sortedHalfEdges(mesh);
  for (std::size_t at = 0; at < halves.size();) {
    const HalfEdge& first = halves[at];
    std::size_t end = at + 1;
    while (end < halves.size() && halves[end].low == first.low && halves[end].high == first.high) ++end;
    const auto where = [&mesh, &first] {
      return "the edge from " + place(mesh.vertices[first.low]) + " to " + place(mesh.vertices[first.high]);
    };
    if (end == at + 1) fail("not closed: ", where(), " has one triangle only (", first.triangle, ')');
    if (end > at + 2) fail("not manifold: ", where(), " has ", end - at, " triangles");
    const HalfEdge& second = halves[at + 1];
    if (first.upward == second.upward)
      fail("inconsistent orientation: triangles ", first.triangle, " and ", second.triangle,
           " turn opposite ways about ", where());
    const auto edge = std::uint32_t(mesh.edges.size());
    mesh.edges.push_back({first.low, first.high});
    mesh.triangleEdges[first.triangle][first.side] = edge;
    mesh.triangleEdges[second.triangle][second.side] = edge;
    mesh.neighbours[first.triangle][first.side] = second.triangle;
    mesh.neighbours[second.triangle][second.side] = first.triangle;
    at = end;
  }
}

// The corners of a vertex, one after the other across sides, are all that it has: where surfaces touch in one
// corner there are more.
void checkFans(const CheckedMesh& mesh) {
  std::vector<std::uint32_t> fanOf(mesh.vertices.size(), kNoElement);  // a triangle of it
  std::vector<std::array<bool, 3>> isMet(mesh.triangles.size(), {false, false, false});
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (isMet[t][k]) continue;
      const std::uint32_t v = mesh.triangles[t][k];
      if (fanOf[v] != kNoElement)
        fail("not manifold: surfaces touch in one corner alone, at ", place(mesh.vertices[v]), ", triangles ",
             fanOf[v], " and ", t, "; let each have a vertex of its own there, as a repair does");
      fanOf[v] = t;
      std::uint32_t triangle = t;
      for (std::size_t corner = k; !isMet[triangle][corner];) {
        isMet[triangle][corner] = true;
        const std::uint32_t edge = mesh.triangleEdges[triangle][corner];
        triangle = mesh.neighbours[triangle][corner];
        const auto& edges = mesh.triangleEdges[triangle];
        corner = (std::size_t(std::find(edges.begin(), edges.end(), edge) - edges.begin()) + 1) % 3;
      }
    }
}

void measureVolume(CheckedMesh& mesh) {
  const Eigen::Vector3d origin = mesh.bounds.center();
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices[a] - origin;
    sum += p.dot((mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin)) / 6;
  }
  mesh.volume = sum;
  const double least = kSmallestVolumeShare * std::pow(mesh.diagonal(), 3);
  if (!(std::abs(sum) > least))
    fail("zero volume: ", sum, " m^3 inside bounds ", mesh.diagonal(), " m across");
  if (sum < 0) fail("inward orientation: its volume is ", sum, " m^3; swap two corners of every triangle");
}

// A triangle without area takes the normal of a neighbour that has one: scans and CAD exports are full of
// them, and only shading and orientation of patches ask.
void computeNormals(CheckedMesh& mesh) {
  mesh.normals.assign(mesh.triangles.size(), Eigen::Vector3d::Zero());
  std::vector<std::uint32_t> flat;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d area =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    const double length = area.norm();
    if (length > 0) {
      mesh.normals[t] = area / length;
    } else {
      flat.push_back(t);
    }
  }
  for (const std::uint32_t t : flat) {
    for (const std::uint32_t neighbour : mesh.neighbours[t])
      if (!mesh.normals[neighbour].isZero()) mesh.normals[t] = mesh.normals[neighbour];
    if (mesh.normals[t].isZero()) mesh.normals[t] = Eigen::Vector3d::UnitZ();
  }
}

}  // namespace

void checkNumbers(const SurfaceMesh& mesh) {
  if (mesh.vertices.empty() || mesh.triangles.empty())
    fail("empty: ", mesh.vertices.size(), " vertices, ", mesh.triangles.size(), " triangles");
  if (mesh.vertices.size() >= kNoElement || mesh.triangles.size() >= kNoElement / 3)
    fail("too large: ", mesh.vertices.size(), " vertices, ", mesh.triangles.size(), " triangles");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) fail("vertex ", v, " is not finite");
    if (mesh.vertices[v].cwiseAbs().maxCoeff() > kLargestCoordinate)
      fail("vertex ", v, " at ", place(mesh.vertices[v]), " is farther than ", kLargestCoordinate,
           " m from the origin");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t])
      if (v >= mesh.vertices.size())
        fail("index out of range: triangle ", t, " names vertex ", v, " of ", mesh.vertices.size());
  }
}

CheckedMesh checkMesh(const SurfaceMesh& mesh) {
  checkNumbers(mesh);
  checkCorners(mesh);
  CheckedMesh checked;
  copyUsed(mesh, checked);
  matchEdges(checked);
  checkFans(checked);
  measureVolume(checked);
  computeNormals(checked);
  return checked;
}

}  // namespace cooking
}  // namespace rubble
