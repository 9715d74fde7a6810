#include "cook/springs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <sstream>

#include "base/groups.h"
#include "rubble/error.h"

namespace rubble::cooking {
namespace {

constexpr double kAnchorCosine = 0.98480775301220802;  // of 10 degrees

bool isAnchored(const RestrictedVoronoi& diagram, const SurfacePolygon& polygon,
                const Eigen::Vector3d& direction, double least) {
  for (std::uint32_t k = 0; k < polygon.count; ++k)
    if (direction.dot(diagram.vertices[diagram.surface.vertices[polygon.first + k]]) < least) return false;
  return true;
}

// What the direction of a wish takes.
struct Facing {
  std::optional<Eigen::Vector3d> along;  // of unit length
  double least = 0;                      // of its vertices along it [m]

  bool takes(const RestrictedVoronoi& diagram, const SurfacePolygon& polygon,
             const Eigen::Vector3d& normal) const {
    return along && along->dot(normal) >= kAnchorCosine && isAnchored(diagram, polygon, *along, least);
  }
};

Facing facingOf(const CheckedMesh& mesh, const AnchorWish& wish) {
  if (!wish.direction) return {};
  const Eigen::Vector3d along = wish.direction->normalized();
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : mesh.vertices) furthest = std::max(furthest, along.dot(vertex));
  return {along, furthest - wish.band};
}

// Outer surface of one cell that is tied at one point.
struct FlatSide {
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();  // normal of its first polygon
  double area = 0;                                   // [m^2]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [m^3]

  void add(const RestrictedVoronoi& diagram, const SurfacePolygon& polygon, const Eigen::Vector3d& normal) {
    diagram.visitPolygon(polygon, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
      const Eigen::Vector3d& a = diagram.vertices[i];
      const Eigen::Vector3d& b = diagram.vertices[j];
      const Eigen::Vector3d& c = diagram.vertices[k];
      const double share = normal.dot((b - a).cross(c - a)) / 2;
      area += share;
      moment += share / 3 * (a + b + c);
    });
  }
  Eigen::Vector3d centroid() const { return moment / area; }
  AssetAnchor anchorOf(std::uint32_t cell) const { return {cell, area, centroid()}; }
};

FlatSide& sideOf(std::vector<FlatSide>& sides, const Eigen::Vector3d& normal) {
  for (FlatSide& side : sides)
    if (side.facing.dot(normal) >= kAnchorCosine) return side;
  sides.emplace_back().facing = normal;
  return sides.back();
}

// Marks the regions that have the point.
bool isIn(const std::vector<Eigen::AlignedBox3d>& regions, const Eigen::Vector3d& point,
          std::vector<std::uint8_t>& found) {
  bool any = false;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (!regions[r].contains(point)) continue;
    any = true;
    found[r] = 1;
  }
  return any;
}

[[noreturn]] void refuseRegion(Eigen::AlignedBox3d region, Eigen::AlignedBox3d bounds,
                               const Eigen::Vector3d& origin) {
  std::ostringstream text;
  const Eigen::IOFormat commas(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  const auto add = [&](Eigen::AlignedBox3d& box) {
    box.translate(origin);
    text << box.min().transpose().format(commas) << " to " << box.max().transpose().format(commas) << " m";
  };
  text << "no outer face has its centroid in the anchor box ";
  add(region);
  text << "; the mesh is from ";
  add(bounds);
  throw Error(text.str());
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
                                     const SitePieces& pieces, const AnchorWish& wish) {
  std::vector<AssetAnchor> anchors;
  if (!wish.direction && wish.regions.empty()) return anchors;
  const Facing facing = facingOf(mesh, wish);
  std::vector<std::uint8_t> found(wish.regions.size(), 0);
  std::vector<FlatSide> sides;
  for (std::uint32_t cell = 0; cell < diagram.cellCount(); ++cell) {
    FlatSide faced;
    sides.clear();
    for (const std::uint32_t p : diagram.polygonsOf.of(cell)) {
      if (pieces.polygons[p] != 0) continue;
      const SurfacePolygon& polygon = diagram.surface.polygons[p];
      const Eigen::Vector3d& normal = mesh.normals[polygon.triangle];
      if (facing.takes(diagram, polygon, normal)) {
        faced.add(diagram, polygon, normal);
      } else if (!wish.regions.empty()) {
        sideOf(sides, normal).add(diagram, polygon, normal);
      }
    }
    if (faced.area > 0) anchors.push_back(faced.anchorOf(cell));
    for (const FlatSide& side : sides)
      if (side.area > 0 && isIn(wish.regions, side.centroid(), found)) anchors.push_back(side.anchorOf(cell));
    // What a region finds is found, though the direction has it already.
    if (faced.area > 0) isIn(wish.regions, faced.centroid(), found);
  }
  for (std::size_t r = 0; r < found.size(); ++r)
    if (!found[r]) refuseRegion(wish.regions[r], mesh.bounds, wish.origin);
  return anchors;
}

}  // namespace rubble::cooking
