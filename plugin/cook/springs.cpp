#include "cook/springs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "base/groups.h"

namespace rubble::cooking {
namespace {

constexpr double kAnchorCosine = 0.98480775301220802;  // of 10 degrees

bool isAnchored(const RestrictedVoronoi& diagram, const SurfacePolygon& polygon,
                const Eigen::Vector3d& direction, double least) {
  for (std::uint32_t k = 0; k < polygon.count; ++k)
    if (direction.dot(diagram.vertices[diagram.surface.vertices[polygon.first + k]]) < least) return false;
  return true;
}

}  // namespace

std::vector<AssetSpring> findSprings(const RestrictedVoronoi& diagram, const SitePieces& pieces,
                                     double leastArea) {
  std::vector<AssetSpring> all;
  for (const Cap& cap : diagram.caps.caps) {
    const Eigen::Vector3d normal = (diagram.sites[cap.second] - diagram.sites[cap.first]).normalized();
    double area = 0;
    Eigen::Vector3d bent = Eigen::Vector3d::Zero();
    for (std::uint32_t t = cap.firstTriangle; t < cap.firstTriangle + cap.triangleCount; ++t) {
      if (pieces.trianglesFirst[t] != 0 || pieces.trianglesSecond[t] != 0) continue;
      const auto& [a, b, c] = diagram.caps.triangles[t];
      const Eigen::Vector3d& origin = diagram.vertices[a];
      const Eigen::Vector3d share = (diagram.vertices[b] - origin).cross(diagram.vertices[c] - origin) / 2;
      area += normal.dot(share);
      bent += share;
    }
    if (!cap.isFlat) area = bent.norm();
    if (area > 0) all.push_back({cap.first, cap.second, area});
  }
  base::Groups tied(diagram.cellCount());
  for (const AssetSpring& spring : all)
    if (spring.area >= leastArea) tied.join(spring.first, spring.second);
  std::vector<AssetSpring> springs;
  for (const AssetSpring& spring : all)
    if (spring.area >= leastArea || tied.of(spring.first) != tied.of(spring.second))
      springs.push_back(spring);
  return springs;
}

std::vector<AssetAnchor> findAnchors(const CheckedMesh& mesh, const RestrictedVoronoi& diagram,
                                     const SitePieces& pieces, const Eigen::Vector3d& direction,
                                     double band) {
  const Eigen::Vector3d along = direction.normalized();
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : mesh.vertices) furthest = std::max(furthest, along.dot(vertex));

  std::vector<AssetAnchor> anchors;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    double area = 0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const std::uint32_t p : diagram.polygonsOf.of(cell)) {
      const SurfacePolygon& polygon = diagram.surface.polygons[p];
      const Eigen::Vector3d& normal = mesh.normals[polygon.triangle];
      if (pieces.polygons[p] != 0 || along.dot(normal) < kAnchorCosine) continue;
      if (!isAnchored(diagram, polygon, along, furthest - band)) continue;
      diagram.visitPolygon(polygon, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const Eigen::Vector3d& a = diagram.vertices[i];
        const Eigen::Vector3d& b = diagram.vertices[j];
        const Eigen::Vector3d& c = diagram.vertices[k];
        const double share = normal.dot((b - a).cross(c - a)) / 2;
        area += share;
        moment += share / 3 * (a + b + c);
      });
    }
    if (area > 0) anchors.push_back({cell, area, moment / area});
  }
  return anchors;
}

}  // namespace rubble::cooking
