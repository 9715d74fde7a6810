#include "edem/mesh_side.h"

#include <limits>

namespace rubble::edem {
namespace {

// The element's centre is nearer to what a point is near to than its own points are, but for a little.
constexpr double kBeyondReach = 1.25;
// Triangles up to this many times as far as the nearest have a share.
constexpr double kNearTriangles = 4;
// Of the element's reach: nearer to the mesh than this the direction to it is rounding.
constexpr double kOnMesh = 1e-9;

bool isInFront(const TriangleMesh& mesh, std::uint32_t triangle, const Eigen::Vector3d& p) {
  return mesh.normal(triangle).dot(p - mesh.corner(triangle, 0)) >= 0;
}

}  // namespace

void MeshSide::look(const TriangleMesh& mesh, const Eigen::Vector3d& centre, double reach) {
  m_mesh = &mesh;
  m_centre = centre;
  mesh.gather(centre, kBeyondReach * reach, m_triangles);
  m_inFront.clear();
  for (const std::uint32_t t : m_triangles) m_inFront.push_back(isInFront(mesh, t, centre));
  m_nearest = mesh.nearest(m_triangles, centre);
  m_behind = !m_triangles.empty() && !isInFront(mesh, m_nearest.triangle, centre);
}

SurfacePoint MeshSide::centre() const {
  if (m_triangles.empty()) return {std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitY()};
  return {m_nearest.distance, m_nearest.distance > 0
                                  ? Eigen::Vector3d((m_centre - m_nearest.at) / m_nearest.distance)
                                  : normalOf(m_nearest.triangle)};
}

Eigen::Vector3d MeshSide::normalOf(std::uint32_t triangle) const {
  return m_behind ? Eigen::Vector3d(-m_mesh->normal(triangle)) : m_mesh->normal(triangle);
}

// Whether the way from the centre passes through the triangle, whose plane it crosses. Two triangles that
// share an edge ask about it with the same order of ends, and so get the same answer: none slips between.
bool MeshSide::crosses(std::uint32_t triangle, const Eigen::Vector3d& way) const {
  const TriangleMesh::Triangle& names = m_mesh->triangles()[triangle];
  int left = 0;
  for (unsigned c = 0; c < 3; ++c) {
    const unsigned next = (c + 1) % 3;
    const bool rising = names[c] < names[next];
    const Eigen::Vector3d from = m_mesh->corner(triangle, rising ? c : next) - m_centre,
                          to = m_mesh->corner(triangle, rising ? next : c) - m_centre;
    left += (way.dot(from.cross(to)) >= 0) == rising;
  }
  return left == 0 || left == 3;
}

bool MeshSide::isBeyond(const Eigen::Vector3d& point) const {
  bool beyond = false;
  for (std::size_t n = 0; n < m_triangles.size(); ++n) {
    const std::uint32_t t = m_triangles[n];
    if (isInFront(*m_mesh, t, point) == bool(m_inFront[n])) continue;
    beyond = beyond != crosses(t, point - m_centre);
  }
  return beyond;
}

SurfacePoint MeshSide::nearest(const Eigen::Vector3d& point) const {
  if (m_triangles.empty()) return {std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitY()};
  const MeshPoint near = m_mesh->nearest(m_triangles, point);
  const double side = isBeyond(point) ? -1 : 1;
  const Eigen::Vector3d normal = near.distance > kOnMesh * (point - m_centre).norm()
                                     ? Eigen::Vector3d(side / near.distance * (point - near.at))
                                     : normalOf(near.triangle);
  return {side * near.distance, normal};
}

// Shares (1 - (r - 1) / (kNear - 1))^2 of the triangles, r: distance over that of the nearest.
Facing MeshSide::facing(const Eigen::Vector3d& point, const Eigen::Vector3d& area) const {
  const MeshPoint nearest = m_mesh->nearest(m_triangles, point);
  Facing out;
  if (!(nearest.distance > kOnMesh * (point - m_centre).norm())) {
    out.normal = normalOf(nearest.triangle);
    out.weight = -area.dot(out.normal);
    return out;
  }
  double shares = 0;
  const auto visitNear = [&](auto&& act) {
    for (const std::uint32_t t : m_triangles) {
      const MeshPoint p = m_mesh->nearest(t, point);
      const double ratio = p.distance / nearest.distance,
                   left = (kNearTriangles - ratio) / (kNearTriangles - 1);
      if (left > 0) act(p, ratio, left);
    }
  };
  visitNear([&](const MeshPoint& p, double, double left) {
    shares += left * left;
    out.normal += left * left * normalOf(p.triangle);
  });
  out.normal /= shares;
  out.weight = -area.dot(out.normal);
  const Eigen::Vector3d away = (point - nearest.at) / nearest.distance;
  visitNear([&](const MeshPoint& p, double ratio, double left) {
    const double rise = -2 * left / (kNearTriangles - 1) / shares;  // of the share, with the ratio
    const Eigen::Vector3d steeper = (point - p.at) / p.distance - ratio * away;
    out.slope += rise * (-area.dot(normalOf(p.triangle)) - out.weight) / nearest.distance * steeper;
  });
  return out;
}

}  // namespace rubble::edem
