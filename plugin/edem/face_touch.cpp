#include "edem/face_touch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "edem/edge_points.h"
#include "edem/facing.h"
#include "edem/fragment_motion.h"
#include "edem/nearest_face.h"

namespace rubble::edem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Copied: GCC zeroes so much by a string instruction, which was more than half of findPoints' time.
const FaceHit kNoHit;
// Stiffness of a corner over k_n: four of them lie on a face as a box does.
constexpr double kCornerWeight = 0.25;
// The same of a capsule's ends and a cone's tip: the two ends of what lies are one contact.
constexpr double kEndWeight = 0.5;
// An edge this near to another part of its body, over h, is in a seam. So is a point of an edge this near to
// two cells that a spring joins, and in both: where they gape by less it does not fall between them.
constexpr double kSeam = 1e-3;
// A side of a rigid body that is beyond one of a cell by less than this, over h, is flush with it: its edge
// presses the cell. Beyond that the cell's vertices, as far inside the body, bear before they are as deep.
constexpr double kFlush = 0.05;
static_assert(kCornerSlack > kFlush + kSeam);
// A point that weighs more than this, over that of its area, will press with the next turn: it stands
// upright.
constexpr double kUpright = -0.1;
// Mean distance from the centroid over a face, by that of its corners: 0.54 of a square, 0.67 of a circle.
constexpr double kFaceSpread = 0.6;

// Normal of the flat end of a cylinder or a cone that a point is at, axes of the element. What points weigh
// against that changes by turns alone: with the normal's own changes it would have no energy. A mantle is met
// by edges.
Eigen::Vector3d endNormal(const Collider& part, const ElementPose& pose, const Eigen::Vector3d& at) {
  const Eigen::Vector3d axis = part.place.linear().col(1);
  const bool top = part.kind == Collider::Kind::Cylinder &&
                   axis.dot(pose.at + pose.turn * at - part.place.translation()) > 0;
  return pose.turn.transpose() * (top ? axis : Eigen::Vector3d(-axis));
}

// A ball of a rigid body, frame of the rigid body: a sphere, an end of a capsule, or a corner rounded by the
// margin.
template <class Visit>
void visitBalls(const Collider& part, Visit&& visit) {
  switch (part.kind) {
    case Collider::Kind::Plane:
    case Collider::Kind::Mesh:
      return;
    case Collider::Kind::Sphere:
      visit(Eigen::Vector3d(part.place.translation()), part.size.x() + part.rounding, 1.0);
      return;
    case Collider::Kind::Box:
      for (int corner = 0; corner < 8; ++corner) {
        Eigen::Vector3d at = part.size;
        for (int axis = 0; axis < 3; ++axis)
          if (corner >> axis & 1) at[axis] = -at[axis];
        visit(Eigen::Vector3d(part.place * at), part.rounding, kCornerWeight);
      }
      return;
    case Collider::Kind::Hull:
      for (const Eigen::Vector3d& at : part.hull->corners)
        visit(Eigen::Vector3d(part.place * at), part.rounding, part.hull->cornerWeight);
      return;
    case Collider::Kind::Capsule:
      for (const double end : {-part.size.y(), part.size.y()})
        visit(Eigen::Vector3d(part.place * Eigen::Vector3d(0, end, 0)), part.size.x() + part.rounding,
              kEndWeight);
      return;
    case Collider::Kind::Cone:
      visit(Eigen::Vector3d(part.place * Eigen::Vector3d(0, part.size.y(), 0)), part.rounding, kEndWeight);
      return;
    case Collider::Kind::Cylinder:
      return;  // all rim
  }
}

// Normals of the sides of a box that meet in a corner, axes of the element; none of other parts.
std::span<const Eigen::Vector3d> sidesAt(const Collider& part, std::uint32_t corner, const ElementPose& pose,
                                         std::array<Eigen::Vector3d, 3>& sides) {
  if (part.kind != Collider::Kind::Box) return {};
  for (int axis = 0; axis < 3; ++axis)
    sides[axis] = pose.turn.transpose() * (corner >> axis & 1 ? -1 : 1) * part.place.linear().col(axis);
  return sides;
}

}  // namespace

double FaceTouch::approach(const RigidProxy& proxy, const Eigen::Vector3d& at, double reach) {
  m_near.clear();
  m_nearest = {kInfinity, Eigen::Vector3d::UnitY()};
  m_sideCount = 0;
  m_gap = kInfinity;
  for (std::uint32_t p = 0; p < proxy.parts.size(); ++p) {
    const Collider& part = proxy.parts[p];
    const bool looks = part.kind == Collider::Kind::Mesh && std::isfinite(reach);
    const SurfacePoint s = looks ? lookAtMesh(part, at, reach) : nearest(part, at);
    if (s.distance < m_nearest.distance) m_nearest = s;
    if (s.distance >= reach) {
      m_gap = std::min(
          m_gap, std::isfinite(s.distance) ? s.distance - reach : 0);  // of a mesh: it was not sought further
      continue;
    }
    m_near.push_back({&part, p, s, Eigen::Vector3d::Zero(), m_sideCount});
    if (looks) ++m_sideCount;
  }
  return m_nearest.distance;
}

void FaceTouch::find(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                     const ElementPose& pose, bool balls) {
  m_hits.clear();
  m_deepest = 0;
  if (exposure.count[element] > 0) {
    turnNormals(pose);
    leaveOutApart(cells, element, 0);
    findPoints(cells, exposure, element, pose);
    for (const Near& n : m_near) {
      if (balls && !hasCorners(*n.part)) findBalls(n, cells, exposure, element, pose);
      if (n.part->isRound()) findEdges(n, cells, exposure, element, pose);
    }
  }
  const double core = cells.core[element];
  if (m_nearest.distance < core) {
    FaceHit& hit = m_hits.emplace_back(kNoHit);
    hit.normal = pose.turn.transpose() * m_nearest.normal;
    hit.depth = core - m_nearest.distance;
    hit.weight = 1;
  }
  for (const FaceHit& hit : m_hits) m_deepest = std::max(m_deepest, hit.depth);
}

void FaceTouch::findCorners(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                            const ElementPose& pose, bool beyond) {
  m_hits.clear();
  if (exposure.count[element] == 0) return;
  turnNormals(pose);
  if (!beyond) leaveOutApart(cells, element, kCornerSlack * std::sqrt(cells.unit));
  for (const Near& n : m_near) {
    if (!hasCorners(*n.part)) continue;
    findBalls(n, cells, exposure, element, pose);
    if (hasEdges(*n.part)) findEdgePoints(n, cells, exposure, element, pose);
    if (n.part->isRound()) findRims(n, cells, exposure, element, pose);
  }
}

void FaceTouch::turnNormals(const ElementPose& pose) {
  for (Near& n : m_near) n.normal = pose.turn.transpose() * n.centre.normal;
}

// A convex part is all below the plane at its point that is nearest to the element's centre. Most cells that
// are near a body are above it.
void FaceTouch::leaveOutApart(const CellFaces& cells, std::uint32_t element, double slack) {
  const auto gapTo = [&](const Near& n) {
    if (n.part->kind == Collider::Kind::Mesh) return 0.0;
    double least = kInfinity;
    for (std::uint32_t v = cells.firstVertex[element]; v < cells.firstVertex[element + 1] && least > slack;
         ++v)
      least = std::min(least, scalarDot(n.normal, cells.vertices[v]) + n.centre.distance);
    return least;
  };
  std::erase_if(m_near, [&](const Near& n) {
    const double gap = gapTo(n);
    m_gap = std::min(m_gap, gap);
    return gap > slack;
  });
}

// Searches no further than an element with its centre at `at` reaches, at least to its core.
SurfacePoint FaceTouch::lookAtMesh(const Collider& part, const Eigen::Vector3d& at, double reach) {
  if (m_sideCount == m_sides.size()) m_sides.emplace_back();
  MeshSide& side = m_sides[m_sideCount];
  side.look(*part.mesh, part.place.inverse(Eigen::Isometry) * at, reach + part.rounding);
  SurfacePoint s = side.centre();
  s.distance -= part.rounding;
  s.normal = part.place.linear() * s.normal;
  return s;
}

SurfacePoint FaceTouch::nearestOf(const Near& near, const Eigen::Vector3d& point) const {
  const Collider& part = *near.part;
  if (part.kind != Collider::Kind::Mesh) return nearest(part, point);
  const MeshSide& side = m_sides[near.side];
  const Eigen::Vector3d local = part.place.inverse(Eigen::Isometry) * point;
  if (!(part.rounding > 0) && !side.isBeyond(local)) return {0, Eigen::Vector3d::Zero()};  // not in it
  SurfacePoint s = side.nearest(local);
  s.distance -= part.rounding;
  s.normal = part.place.linear() * s.normal;
  return s;
}

Facing FaceTouch::facingOf(const Near& near, const Eigen::Vector3d& point,
                           const Eigen::Vector3d& area) const {
  const Collider& part = *near.part;
  if (part.kind != Collider::Kind::Mesh) return facing(part, point, area);
  const Eigen::Matrix3d& axes = part.place.linear();
  Facing f = m_sides[near.side].facing(part.place.inverse(Eigen::Isometry) * point, axes.transpose() * area);
  f.normal = axes * f.normal;
  f.slope = axes * f.slope;
  return f;
}

void FaceTouch::findPoints(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                           const ElementPose& pose) {
  for (const ExposedPoint& p : exposure.of(cells, element)) {
    SurfacePoint surface{0, Eigen::Vector3d::Zero()};
    const Near* deepest = nullptr;
    for (const Near& n : m_near) {
      if (!pressesPoints(*n.part)) continue;
      // Parts are convex: none lies above the plane at the point nearest to the element's centre. A mesh has
      // nothing nearer than that point.
      const double above = n.part->kind == Collider::Kind::Mesh ? n.centre.distance - p.at.norm()
                                                                : n.normal.dot(p.at) + n.centre.distance;
      if (above >= surface.distance) continue;
      SurfacePoint s{above, n.normal};
      if (n.part->kind != Collider::Kind::Plane) {
        s = nearestOf(n, pose.at + pose.turn * p.at);
        s.normal = pose.turn.transpose() * s.normal;
      }
      if (s.distance >= surface.distance) continue;
      surface = s;
      deepest = &n;
    }
    if (!(surface.distance < 0)) continue;
    FaceHit& hit = m_hits.emplace_back(kNoHit);
    hit.at = p.at;
    hit.depth = -surface.distance;
    hit.normal = surface.normal;
    const Eigen::Vector3d area = p.area / cells.unit;
    Eigen::Vector3d normal;
    if (deepest->part->kind == Collider::Kind::Plane) {
      normal = deepest->normal;
      hit.weight = -area.dot(normal);
    } else if (deepest->part->isRound()) {
      normal = endNormal(*deepest->part, pose, p.at);
      hit.weight = -area.dot(normal);
    } else {
      const Facing f = facingOf(*deepest, pose.at + pose.turn * p.at, pose.turn * area);
      normal = pose.turn.transpose() * f.normal;
      hit.weight = f.weight;
      hit.sliding = -(pose.turn.transpose() * f.slope);
    }
    hit.turning = area.cross(normal);
    if (!(hit.weight > 0)) {
      if (hit.weight > kUpright * area.norm()) m_deepest = std::max(m_deepest, hit.depth);
      m_hits.pop_back();
    }
  }
}

bool FaceTouch::ballHit(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                        const Eigen::Vector3d& centre, double radius, FaceHit& hit, double slack,
                        std::span<const Eigen::Vector3d> sides) {
  const NearestFace face(cells, exposure, element, centre, radius, sides, kFlush * std::sqrt(cells.unit));
  const double depth = face.inside ? radius + face.distance : radius - face.distance;
  if (!(depth > 0) || !std::isfinite(face.distance)) return false;
  Eigen::Vector3d normal = -face.normal;
  if (face.distance > 1e-9 * cells.reach[element])  // on the face the direction is rounding
    normal = (face.inside ? centre - face.at : face.at - centre) / face.distance;
  hit = {};
  hit.at = face.at;
  hit.normal = normal;
  hit.depth = depth;
  if (face.inside && face.beyond > slack) hit.beyond = face.beyond;
  return true;
}

void FaceTouch::findBalls(const Near& near, const CellFaces& cells, const Exposure& exposure,
                          std::uint32_t element, const ElementPose& pose) {
  const bool corners = hasCorners(*near.part);
  std::uint32_t corner = 0;
  std::array<Eigen::Vector3d, 3> sides;
  visitBalls(*near.part, [&](const Eigen::Vector3d& centre, double radius, double weight) {
    ++corner;
    const Eigen::Vector3d from = centre - pose.at;
    const double within = cells.reach[element] + radius;
    if (from.squaredNorm() >= within * within) return;
    const Eigen::Vector3d c = pose.turn.transpose() * from;
    FaceHit hit;
    if (!ballHit(cells, exposure, element, c, radius, hit, 0, sidesAt(*near.part, corner - 1, pose, sides)))
      return;
    if (hit.beyond > 0 && !corners) return;
    hit.weight = weight;
    if (corners) hit.corner = {near.index, corner};
    m_hits.push_back(hit);
  });
}

void FaceTouch::findEdgePoints(const Near& near, const CellFaces& cells, const Exposure& exposure,
                               std::uint32_t element, const ElementPose& pose) {
  const Collider& part = *near.part;
  const double h = std::sqrt(cells.unit), reach = cells.reach[element] + part.rounding;
  const Eigen::Vector3d centre = part.place.inverse(Eigen::Isometry) * pose.at;
  visitEdgeRows(part, h, centre, reach,
                [&](const EdgeRow& row, const EdgeRow::Range& range, std::uint32_t number,
                    const std::array<Eigen::Vector3d, 2>& normals) {
                  std::array<Eigen::Vector3d, 2> sides;
                  for (unsigned s = 0; s < 2; ++s)
                    sides[s] = pose.turn.transpose() * (part.place.linear() * normals[s]);
                  for (std::uint32_t p = range.first; p < range.last; ++p) {
                    const Eigen::Vector3d at = part.place * row.at(p);
                    FaceHit hit;
                    if (!ballHit(cells, exposure, element, pose.turn.transpose() * (at - pose.at),
                                 part.rounding, hit, kSeam * h, sides))
                      continue;
                    if (isInAnother(near, at, kSeam * h)) continue;
                    hit.weight = row.weight();
                    hit.corner = {near.index, row.nameOf(p), number};
                    m_hits.push_back(hit);
                  }
                });
}

bool FaceTouch::isInAnother(const Near& near, const Eigen::Vector3d& at, double slack) const {
  return std::any_of(m_near.begin(), m_near.end(), [&](const Near& n) {
    return n.index != near.index && nearest(*n.part, at).distance < slack;
  });
}

void FaceTouch::withhold(const ContactLaw<double>& law, const PartingMotion& fragment) {
  for (FaceHit& hit : m_hits) {
    const double parting = scalarDot(hit.normal, velocityAt(hit.at, fragment.centre, fragment.spin));
    hit.withheld = withheld(law.inelastic, parting, fragment.jolt, fragment.resting);
  }
}

FacePress facePress(std::span<const FaceHit> hits, const ContactLaw<double>& law, const ElementMotion& motion,
                    const Steps& steps) {
  FacePress press;
  Eigen::Vector3d elastic = press.elastic, damping = press.damping, elasticTorque = press.elasticTorque,
                  dampingTorque = press.dampingTorque, at = press.at, normal = press.normal;
  double full = 0, energy = 0, weight = 0;
  for (const FaceHit& hit : hits) {
    const double depth = hit.depth;
    const double speed = -scalarDot(hit.normal, velocityAt(hit.at, motion.centre, motion.spin));
    const double onset = steps.moved > 0 ? onsetShare(depth + hit.yielded, speed, steps.moved) : 1;
    const double stiffness = hit.weight * law.stiffness;
    const double pushed = stiffness * depth * touchShare(depth, speed, steps.next, onset);
    const Eigen::Vector3d lever = scalarCross(hit.at, hit.normal);
    const double dashpot =
        hit.weight * law.damping / std::sqrt(1 + scalarDot(lever, lever) / motion.gyration);
    const double kept = 1 - hit.withheld;
    const double both = pushed + dashpot * speed, whole = both > 0 ? both : 0;
    const double damped = kept * whole - pushed;
    addScaled(pushed, hit.normal, elastic);
    addScaled(damped, hit.normal, damping);
    addScaled(pushed, lever, elasticTorque);
    addScaled(damped, lever, dampingTorque);
    // The forces of the weight's changes.
    const double half = 0.5 * law.stiffness * depth * depth;
    Eigen::Vector3d turned(half * hit.turning.x(), half * hit.turning.y(), half * hit.turning.z());
    if (!hit.sliding.isZero(0)) {  // planes have none
      const Eigen::Vector3d slid = half * hit.sliding;
      turned += hit.at.cross(slid);
      elastic += slid;
      damping -= (1 - kept) * slid;
    }
    addScaled(1, turned, elasticTorque);
    addScaled(-(1 - kept), turned, dampingTorque);
    energy += 0.5 * stiffness * depth * depth;
    full += whole;
    press.stiffness += hit.weight;
    addScaled(hit.weight * depth, hit.at, at);
    addScaled(hit.weight * depth, hit.normal, normal);
    weight += hit.weight * depth;
  }
  press.elastic = elastic;
  press.damping = damping;
  press.elasticTorque = elasticTorque;
  press.dampingTorque = dampingTorque;
  press.full = full;
  press.energy = energy;
  press.weight = weight;
  if (!(weight > 0)) return press;
  at /= weight;
  // Pressed from two sides alike there is no direction to slide in; any will do, without friction.
  const double length = normal.norm();
  normal = length > 1e-9 * weight ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitY();
  press.total = std::fmax(0.0, normal.dot(elastic + damping));
  double spread = 0;
  for (const FaceHit& hit : hits) {
    const Eigen::Vector3d across =
        scalarCross(normal, {hit.at.x() - at.x(), hit.at.y() - at.y(), hit.at.z() - at.z()});
    spread += hit.weight * hit.depth * std::sqrt(scalarDot(across, across));
  }
  press.spread = spread * (kFaceSpread / weight);
  press.at = at;
  press.normal = normal;
  return press;
}

double ballWeights(const RigidProxy& proxy, const Eigen::Vector3d& at, double reach) {
  double sum = 0;
  for (const Collider& part : proxy.parts) {
    visitBalls(part, [&](const Eigen::Vector3d& centre, double radius, double weight) {
      const double within = reach + radius;
      if ((centre - at).squaredNorm() < within * within) sum += weight;
    });
    for (const Rim& rim : Rims(part)) {
      const double within = reach + rim.radius + part.rounding;
      if ((rim.centre - at).squaredNorm() < within * within) sum += 1 + kRimWeight;  // its corners are 1
    }
  }
  return sum;
}

}  // namespace rubble::edem
