#include "bullet/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <Eigen/Geometry>

namespace rubble::bullet {
RUBBLE_ABI_BEGIN

ConvexHull convexHullOf(std::span<const Eigen::Vector3d> points) {
  ConvexHull hull;
  if (points.empty()) return hull;
  btConvexHullComputer computer;
  computer.compute(points[0].data(), int(sizeof(Eigen::Vector3d)), int(points.size()), 0, 0);
  // Its own vertices are rounded to a ten thousandth of the hull.
  for (int i = 0; i < computer.vertices.size(); ++i)
    hull.points.push_back(points[std::size_t(computer.original_vertex_index[i])]);
  if (hull.points.empty()) return hull;
  const Eigen::Vector3d apex = hull.points[0];
  for (int f = 0; f < computer.faces.size(); ++f) {
    const auto* first = &computer.edges[computer.faces[f]];
    const Eigen::Vector3d corner = hull.points[std::size_t(first->getSourceVertex())];
    Eigen::Vector3d area = Eigen::Vector3d::Zero();  // twice
    for (const auto* e = first->getNextEdgeOfFace(); e->getNextEdgeOfFace() != first;
         e = e->getNextEdgeOfFace()) {
      const Eigen::Vector3d a = hull.points[std::size_t(e->getSourceVertex())] - corner,
                            b = hull.points[std::size_t(e->getTargetVertex())] - corner;
      area += a.cross(b);
    }
    const double volume = area.dot(corner - apex) / 6;
    hull.volume += std::abs(volume);  // seen from a corner all faces turn one way
    if (!(area.squaredNorm() > 0)) continue;
    const Eigen::Vector3d normal = area.normalized();
    hull.faces.push_back({normal, normal.dot(corner), area.norm() / 2});
  }
  return hull;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
