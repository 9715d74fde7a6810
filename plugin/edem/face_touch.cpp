#include "edem/face_touch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "edem/fragment_motion.h"

namespace rubble::edem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Stiffness of a corner over k_n: four of them lie on a face as a box does.
constexpr double kCornerWeight = 0.25;
// Mean distance from the centroid over a face, by that of its corners: 0.54 of a square, 0.67 of a circle.
constexpr double kFaceSpread = 0.6;

// A ball of a rigid body, frame of the rigid body: a sphere, or a corner rounded by the margin.
template <class Visit>
void visitBalls(const Collider& part, Visit&& visit) {
  switch (part.kind) {
    case Collider::Kind::Plane:
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
  }
}

// Nearest point of a triangle [Ericson05, 5.1.5].
Eigen::Vector3d nearestOnTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

// Nearest point of the exposed faces that a ball at `centre` sees: from inside the cell all of them, from
// outside those whose front it is at.
struct NearestFace {
  double distance = kInfinity;
  bool inside = true;
  Eigen::Vector3d at;
  Eigen::Vector3d normal;  // of the face

  NearestFace(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
              const Eigen::Vector3d& centre, double radius) {
    const std::span<const CellFaces::Face> faces = cells.of(element);
    for (const CellFaces::Face& f : faces) inside = inside && f.normal.dot(centre) <= f.offset;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!exposure.faces[cells.firstFace[element] + f]) continue;
      const CellFaces::Face& face = faces[f];
      const double height = face.normal.dot(centre) - face.offset;
      if (inside ? -height >= distance : height <= 0 || height >= std::min(radius, distance)) continue;
      for (std::uint32_t t = 0; t < face.triangleCount; ++t) {
        const auto& corners = cells.triangles[face.firstTriangle + t];
        const Eigen::Vector3d q = nearestOnTriangle(cells.vertices[corners[0]], cells.vertices[corners[1]],
                                                    cells.vertices[corners[2]], centre);
        const double away = (q - centre).norm();
        if (away >= distance) continue;
        distance = away;
        at = q;
        normal = face.normal;
      }
    }
  }
};

}  // namespace

double FaceTouch::approach(const RigidProxy& proxy, const Eigen::Vector3d& at, double reach) {
  m_near.clear();
  m_nearest = {kInfinity, Eigen::Vector3d::UnitY()};
  for (const Collider& part : proxy.parts) {
    const SurfacePoint s = nearest(part, at);
    if (s.distance < m_nearest.distance) m_nearest = s;
    if (s.distance < reach) m_near.push_back({&part, s, Eigen::Vector3d::Zero()});
  }
  return m_nearest.distance;
}

void FaceTouch::find(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                     const ElementPose& pose, bool balls) {
  m_hits.clear();
  for (Near& n : m_near) n.normal = pose.turn.transpose() * n.centre.normal;
  if (exposure.count[element] > 0) {
    findPoints(cells, exposure, element, pose);
    if (balls) findBalls(cells, exposure, element, pose);
  }
  const double core = cells.core[element];
  if (m_nearest.distance < core)
    m_hits.push_back({Eigen::Vector3d::Zero(), pose.turn.transpose() * m_nearest.normal,
                      Eigen::Vector3d::Zero(), core - m_nearest.distance, 1});
}

void FaceTouch::findPoints(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                           const ElementPose& pose) {
  for (const ExposedPoint& p : exposure.of(cells, element)) {
    FaceHit hit{p.at, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0, 0};
    for (const Near& n : m_near) {
      if (n.part->kind == Collider::Kind::Sphere) continue;
      // Parts are convex: none lies above the plane at the point nearest to the element's centre.
      const double above = n.normal.dot(p.at) + n.centre.distance;
      if (-above <= hit.depth) continue;
      SurfacePoint s{above, n.normal};
      if (n.part->kind != Collider::Kind::Plane) {
        s = nearest(*n.part, pose.at + pose.turn * p.at);
        s.normal = pose.turn.transpose() * s.normal;
      }
      if (-s.distance <= hit.depth) continue;
      hit.depth = -s.distance;
      hit.normal = s.normal;
    }
    if (!(hit.depth > 0)) continue;
    hit.area = p.area / cells.unit;
    hit.weight = -hit.area.dot(hit.normal);
    if (hit.weight > 0) m_hits.push_back(hit);
  }
}

void FaceTouch::findBalls(const CellFaces& cells, const Exposure& exposure, std::uint32_t element,
                          const ElementPose& pose) {
  for (const Near& n : m_near) {
    visitBalls(*n.part, [&](const Eigen::Vector3d& centre, double radius, double weight) {
      const Eigen::Vector3d from = centre - pose.at;
      const double within = cells.reach[element] + radius;
      if (from.squaredNorm() >= within * within) return;
      const Eigen::Vector3d c = pose.turn.transpose() * from;
      const NearestFace face(cells, exposure, element, c, radius);
      const double depth = face.inside ? radius + face.distance : radius - face.distance;
      if (!(depth > 0) || !std::isfinite(face.distance)) return;
      Eigen::Vector3d normal = -face.normal;
      if (face.distance > 1e-9 * cells.reach[element])  // on the face the direction is rounding
        normal = (face.inside ? c - face.at : face.at - c) / face.distance;
      m_hits.push_back({face.at, normal, Eigen::Vector3d::Zero(), depth, weight});
    });
  }
}

FacePress::FacePress(std::span<const FaceHit> hits, const ContactLaw<double>& law, double sunk,
                     const ElementMotion& motion, const PartingMotion& fragment, const Steps& steps) {
  for (const FaceHit& hit : hits) {
    const double depth = hit.depth - sunk;
    if (!(depth > 0)) continue;
    const double speed = -hit.normal.dot(motion.centre + motion.spin.cross(hit.at));
    const double onset = steps.moved > 0 ? onsetShare(depth, speed, steps.moved) : 1;
    const double stiffness = hit.weight * law.stiffness;
    const double pushed = stiffness * depth * touchShare(depth, speed, steps.next, onset);
    const Eigen::Vector3d lever = hit.at.cross(hit.normal);
    const double dashpot = hit.weight * law.damping / std::sqrt(1 + lever.squaredNorm() / motion.gyration);
    const double parting = hit.normal.dot(fragment.centre + fragment.spin.cross(hit.at));
    const double kept = 1 - withheld(law.inelastic, parting, fragment.jolt, fragment.resting);
    const double whole = std::fmax(0.0, pushed + dashpot * speed), damped = kept * whole - pushed;
    elastic += pushed * hit.normal;
    damping += damped * hit.normal;
    elasticTorque += pushed * lever;
    dampingTorque += damped * lever;
    // A turned face has another share against the surface, and so another energy.
    const Eigen::Vector3d turned = 0.5 * law.stiffness * depth * depth * hit.area.cross(hit.normal);
    elasticTorque += turned;
    dampingTorque -= (1 - kept) * turned;
    energy += 0.5 * stiffness * depth * depth;
    full += whole;
    at += hit.weight * depth * hit.at;
    normal += hit.weight * depth * hit.normal;
    weight += hit.weight * depth;
  }
  if (!(weight > 0)) return;
  at /= weight;
  // Pressed from two sides alike there is no direction to slide in; any will do, without friction.
  const double length = normal.norm();
  normal = length > 1e-9 * weight ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitY();
  total = std::fmax(0.0, normal.dot(elastic + damping));
  for (const FaceHit& hit : hits) {
    const double depth = hit.depth - sunk;
    if (depth > 0) spread += kFaceSpread * hit.weight * depth / weight * normal.cross(hit.at - at).norm();
  }
}

double ballWeights(const RigidProxy& proxy, const Eigen::Vector3d& at, double reach) {
  double sum = 0;
  for (const Collider& part : proxy.parts) {
    visitBalls(part, [&](const Eigen::Vector3d& centre, double radius, double weight) {
      const double within = reach + radius;
      if ((centre - at).squaredNorm() < within * within) sum += weight;
    });
  }
  return sum;
}

}  // namespace rubble::edem
