#include "edem/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "edem/triangle.h"

namespace rubble::edem {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// Distances that differ by less are those of one point, on an edge or a vertex.
constexpr double kSamePlace = 1 + 1e-9;

// The nearest so far. On an edge that two triangles share the one whose plane is further off tells the side
// of the surface.
class Nearest {
 public:
  Nearest(const TriangleMesh& mesh, const Eigen::Vector3d& to, double reach)
      : m_mesh(mesh), m_to(to), m_reach(reach) {}

  void consider(std::uint32_t triangle) {
    const MeshPoint p = m_mesh.nearest(triangle, m_to);
    if (p.distance > m_reach || p.distance > m_best.distance * kSamePlace) return;
    const double height = std::abs(m_mesh.normal(triangle).dot(m_to - p.at));
    if (p.distance * kSamePlace < m_best.distance || height > m_height ||
        (height == m_height && triangle < m_best.triangle)) {
      m_best = p;
      m_height = height;
    }
  }
  const MeshPoint& best() const { return m_best; }

  // For Eigen::BVMinimize. Boxes a little further than the nearest are looked into too, for its neighbours.
  using Scalar = double;
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const {
    const double distance = std::sqrt(box.squaredExteriorDistance(m_to)) / kSamePlace;
    return distance > m_reach ? kFar : distance;
  }
  double minimumOnObject(std::uint32_t triangle) {
    consider(triangle);
    return std::min(m_best.distance * kSamePlace, std::numeric_limits<double>::max());
  }

 private:
  const TriangleMesh& m_mesh;
  const Eigen::Vector3d& m_to;
  const double m_reach;
  MeshPoint m_best{Eigen::Vector3d::Zero(), 0, kFar};
  double m_height = -1;
};

// For Eigen::BVIntersect.
struct Within {
  const TriangleMesh& mesh;
  const Eigen::Vector3d& place;
  double reach;
  std::vector<std::uint32_t>& found;

  bool intersectVolume(const Eigen::AlignedBox3d& box) const {
    return box.squaredExteriorDistance(place) <= reach * reach;
  }
  bool intersectObject(std::uint32_t triangle) const {
    if (mesh.nearest(triangle, place).distance <= reach) found.push_back(triangle);
    return false;
  }
};

// A side of a triangle, by its two vertices, the lower first.
struct MeshEdge {
  std::uint32_t low, high, triangle;
  bool rising;  // as the triangle goes round
  auto ends() const { return std::tie(low, high); }
};

std::vector<MeshEdge> edgesOf(std::span<const TriangleMesh::Triangle> triangles) {
  std::vector<MeshEdge> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (unsigned c = 0; c < 3; ++c) {
      const std::uint32_t from = triangles[t][c], to = triangles[t][(c + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const MeshEdge& a, const MeshEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles)
    : m_vertices(std::move(vertices)), m_triangles(std::move(triangles)) {
  const auto areaOf = [this](const Triangle& t) -> Eigen::Vector3d {
    const Eigen::Vector3d& a = m_vertices[t[0]];
    return (m_vertices[t[1]] - a).cross(m_vertices[t[2]] - a);
  };
  std::erase_if(m_triangles, [&](const Triangle& t) { return !(areaOf(t).norm() > 0); });
  turnAlike();
  std::vector<std::uint32_t> order;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::uint32_t t = 0; t < m_triangles.size(); ++t) {
    m_normals.push_back(areaOf(m_triangles[t]).normalized());
    Eigen::AlignedBox3d box(corner(t, 0));
    box.extend(corner(t, 1));
    box.extend(corner(t, 2));
    m_bounds.extend(box);
    boxes.push_back(box);
    order.push_back(t);
  }
  m_tree.init(order.begin(), order.end(), boxes.begin(), boxes.end());
}

// From triangle to triangle over the edges that two of them share.
void TriangleMesh::turnAlike() {
  const std::vector<MeshEdge> edges = edgesOf(m_triangles);
  struct Neighbour {
    std::uint32_t of, triangle;
    bool alike;
  };
  std::vector<Neighbour> neighbours;
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const MeshEdge &a = edges[e], &b = edges[e + 1];
    if (a.ends() != b.ends()) continue;
    neighbours.push_back({a.triangle, b.triangle, a.rising != b.rising});
    neighbours.push_back({b.triangle, a.triangle, a.rising != b.rising});
  }
  std::sort(neighbours.begin(), neighbours.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::tie(a.of, a.triangle) < std::tie(b.of, b.triangle);
  });
  std::vector<std::uint8_t> seen(m_triangles.size(), 0);
  std::vector<std::pair<std::uint32_t, bool>> waiting;  // with whether it is to be turned
  for (std::uint32_t first = 0; first < m_triangles.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    waiting.push_back({first, false});
    while (!waiting.empty()) {
      const auto [t, turned] = waiting.back();
      waiting.pop_back();
      if (turned) std::swap(m_triangles[t][1], m_triangles[t][2]);
      const auto isBefore = [](const Neighbour& n, std::uint32_t of) { return n.of < of; };
      auto n = std::lower_bound(neighbours.begin(), neighbours.end(), t, isBefore);
      for (; n != neighbours.end() && n->of == t; ++n) {
        if (std::exchange(seen[n->triangle], std::uint8_t(1))) continue;
        waiting.push_back({n->triangle, turned == n->alike});
      }
    }
  }
}

MeshPoint TriangleMesh::nearest(std::uint32_t triangle, const Eigen::Vector3d& to) const {
  const Eigen::Vector3d at =
      nearestOnTriangle(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2), to);
  return {at, triangle, (to - at).norm()};
}

MeshPoint TriangleMesh::nearest(const Eigen::Vector3d& to, double reach) const {
  Nearest search(*this, to, reach);
  Eigen::BVMinimize(m_tree, search);
  return search.best();
}

MeshPoint TriangleMesh::nearest(std::span<const std::uint32_t> triangles, const Eigen::Vector3d& to) const {
  Nearest search(*this, to, kFar);
  for (const std::uint32_t t : triangles) search.consider(t);
  return search.best();
}

void TriangleMesh::gather(const Eigen::Vector3d& place, double reach,
                          std::vector<std::uint32_t>& found) const {
  found.clear();
  Within within{*this, place, reach, found};
  Eigen::BVIntersect(m_tree, within);
  std::sort(found.begin(), found.end());
}

}  // namespace rubble::edem
