#include "edem/round_touch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "edem/face_touch.h"

namespace rubble::edem {
namespace {

// Below this share of its axis across a face, a rim has no deepest point there.
constexpr double kAlong = 1e-6;
// Steps to the deepest point of an edge: a third are halvings, to 1e-5 of its length at a ridge.
constexpr int kMostSteps = 48;

struct DeepestPoint {
  double share;  // of the way from the edge's first end
  SurfacePoint surface;
};

// Deepest point of an edge in a collider. The signed distance of a convex body is convex, so its slope rises
// along the edge: where that is zero, by the rule of false position [Illinois]. At a ridge of the distance
// the slope jumps; of the normals on both sides that share is taken which does not push along the edge, the
// gradient of the depth.
DeepestPoint deepestOn(const Collider& part, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d way = to - from;
  const auto at = [&](double share) { return nearest(part, from + share * way); };
  const auto slopeOf = [&](const DeepestPoint& p) { return p.surface.normal.dot(way); };
  DeepestPoint low{0, at(0)}, high{1, at(1)};
  double lowSlope = slopeOf(low), highSlope = slopeOf(high);
  if (lowSlope >= 0) return low;
  if (highSlope <= 0) return high;
  const double flat = 1e-10 * way.norm();
  int side = 0;
  for (int n = 0; n < kMostSteps; ++n) {
    // At a jump of the slope false position creeps; every third step halves.
    const double share = n % 3 == 2
                             ? 0.5 * (low.share + high.share)
                             : low.share - lowSlope * (high.share - low.share) / (highSlope - lowSlope);
    const DeepestPoint next{share, at(share)};
    const double slope = slopeOf(next);
    if (std::abs(slope) < flat) return next;
    if (slope < 0) {
      low = next;
      lowSlope = slope;
      if (side < 0) highSlope *= 0.5;
      side = -1;
    } else {
      high = next;
      highSlope = slope;
      if (side > 0) lowSlope *= 0.5;
      side = 1;
    }
  }
  const double down = -slopeOf(low), up = slopeOf(high);
  low.surface.normal = (up * low.surface.normal + down * high.surface.normal) / (up + down);
  low.surface.distance = std::min(low.surface.distance, high.surface.distance);
  return low;
}

}  // namespace

Rims::Rims(const Collider& part) {
  if (part.kind != Collider::Kind::Cylinder && part.kind != Collider::Kind::Cone) return;
  const Eigen::Vector3d axis = part.place.linear().col(1), across = part.place.linear().col(0);
  m_count = part.kind == Collider::Kind::Cylinder ? 2 : 1;
  for (std::size_t i = 0; i < m_count; ++i)
    m_rims[i] = {part.place.translation() + (i == 0 ? -1.0 : 1.0) * part.size.y() * axis, axis, across,
                 part.size.x()};
}

// An edge counts by how far the axis lies across it in the plane of its face: one along it, or under a flat
// end, has no deepest point.
void FaceTouch::findEdges(const Near& near, const CellFaces& cells, const Exposure& exposure,
                          std::uint32_t element, const ElementPose& pose) {
  const Collider& part = *near.part;
  const Eigen::Vector3d axis = pose.turn.transpose() * part.place.linear().col(1);
  visitEdges(cells, exposure, element,
             [&](const CellFaces::Face& face, std::uint32_t from, std::uint32_t to) {
               const Eigen::Vector3d &a = cells.vertices[from], &b = cells.vertices[to];
               // No part lies above the plane at the point nearest to the element's centre.
               if (std::min(near.normal.dot(a), near.normal.dot(b)) + near.centre.distance >= 0) return;
               const DeepestPoint deepest = deepestOn(part, pose.at + pose.turn * a, pose.at + pose.turn * b);
               if (deepest.surface.distance >= 0) return;
               FaceHit hit;
               hit.at = a + deepest.share * (b - a);
               hit.normal = pose.turn.transpose() * deepest.surface.normal;
               hit.depth = -deepest.surface.distance;
               const Eigen::Vector3d across = face.normal.cross(b - a).normalized();
               const double share = across.dot(axis);
               hit.weight = kEdgeWeight * share * share;
               hit.turning = -2 * kEdgeWeight * share * across.cross(axis);
               if (hit.weight > 0) m_hits.push_back(hit);
             });
}

void FaceTouch::findRims(const Near& near, const CellFaces& cells, const Exposure& exposure,
                         std::uint32_t element, const ElementPose& pose) {
  const double rounding = near.part->rounding;
  // Corners of a rim are named before its deepest point; 1 is the tip of a cone.
  CornerName first{near.index, 2};
  for (const Rim& rim : Rims(*near.part)) {
    const CornerName name = std::exchange(first, {near.index, first.corner + kRimCorners + 1});
    const Eigen::Vector3d from = rim.centre - pose.at;
    const double within = cells.reach[element] + rim.radius + rounding;
    if (from.squaredNorm() >= within * within) continue;
    const Rim own{pose.turn.transpose() * from, pose.turn.transpose() * rim.axis,
                  pose.turn.transpose() * rim.across, rim.radius};
    findRimCorners(own, rounding, name, cells, exposure, element);
    findRimDeepest(own, rounding, {near.index, name.corner + kRimCorners}, cells, exposure, element);
  }
}

// Corners count by how far the rim stands on a face, and lying it has none to roll over.
void FaceTouch::findRimCorners(const Rim& rim, double rounding, CornerName first, const CellFaces& cells,
                               const Exposure& exposure, std::uint32_t element) {
  double along = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const std::span<const CellFaces::Face> faces = cells.of(element);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!exposure.faces[cells.firstFace[element] + f]) continue;
    const double share = faces[f].normal.dot(rim.axis);
    if (std::abs(share) <= std::abs(along)) continue;
    along = share;
    normal = faces[f].normal;
  }
  if (std::abs(along) < kAlong) return;
  const Eigen::Vector3d aside = rim.axis.cross(rim.across);
  constexpr double kWeight = 1.0 / kRimCorners;
  for (int corner = 0; corner < kRimCorners; ++corner) {
    const double angle = 2 * std::numbers::pi / kRimCorners * corner;
    const Eigen::Vector3d at =
        rim.centre + rim.radius * (std::cos(angle) * rim.across + std::sin(angle) * aside);
    FaceHit hit;
    if (!ballHit(cells, exposure, element, at, rounding, hit)) continue;
    hit.weight = kWeight * along * along;
    hit.turning = -2 * kWeight * along * normal.cross(rim.axis);
    hit.corner = {first.part, first.corner + std::uint32_t(corner)};
    m_hits.push_back(hit);
  }
}

// The point of a rim that is deepest under a face; of all faces the one with most energy, for what passes
// from one to the other then does so without a jump.
void FaceTouch::findRimDeepest(const Rim& rim, double rounding, CornerName name, const CellFaces& cells,
                               const Exposure& exposure, std::uint32_t element) {
  const std::span<const CellFaces::Face> faces = cells.of(element);
  std::optional<FaceHit> most;
  double energy = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!exposure.faces[cells.firstFace[element] + f]) continue;
    const Eigen::Vector3d& normal = faces[f].normal;
    const double along = normal.dot(rim.axis);
    const Eigen::Vector3d down = along * rim.axis - normal;
    const double size = down.norm();
    if (size < kAlong) continue;
    const Eigen::Vector3d at = rim.centre + rim.radius / size * down;
    FaceHit hit;
    if (normal.dot(at) - faces[f].offset >= rounding || !ballHit(cells, exposure, element, at, rounding, hit))
      continue;
    hit.weight = kRimWeight * size * size;
    if (hit.weight * hit.depth * hit.depth <= energy) continue;
    energy = hit.weight * hit.depth * hit.depth;
    // The point stays below as the body turns, so what pushes it along the rim turns nothing.
    const Eigen::Vector3d tangent = rim.axis.cross(down) / size;
    hit.turning = 2 * kRimWeight *
                  (along * normal.cross(rim.axis) +
                   size * rim.radius / hit.depth * hit.normal.dot(tangent) * normal.cross(tangent));
    hit.corner = name;
    most = hit;
  }
  if (most) m_hits.push_back(*most);
}

}  // namespace rubble::edem
