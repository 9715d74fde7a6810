#include "edem/collider.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "edem/round_surfaces.h"

namespace rubble::edem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SurfacePoint nearestOnBox(const Eigen::Vector3d& half, const Eigen::Vector3d& p) {
  const Eigen::Vector3d outside = p.cwiseAbs() - half;
  if ((outside.array() <= 0).all()) {
    Eigen::Index axis = 0;
    const double depth = outside.maxCoeff(&axis);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    normal[axis] = p[axis] < 0 ? -1 : 1;
    return {depth, normal};
  }
  const Eigen::Vector3d away = p - p.cwiseMax(-half).cwiseMin(half);
  const double distance = away.norm();
  return {distance, away / distance};
}

Eigen::Vector3d nearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return a + t * ab;
}

// Nearest point of a convex polygon to a point above its plane.
Eigen::Vector3d nearestOnFace(const Hull::Face& face, const Eigen::Vector3d& p) {
  const std::size_t n = face.vertices.size();
  bool over = true;
  Eigen::Vector3d best = face.vertices[0];
  double least = kInfinity;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d &a = face.vertices[i], &b = face.vertices[(i + 1) % n];
    if (face.normal.cross(b - a).dot(p - a) >= 0) continue;
    over = false;
    const Eigen::Vector3d q = nearestOnSegment(a, b, p);
    if ((p - q).squaredNorm() < least) {
      least = (p - q).squaredNorm();
      best = q;
    }
  }
  return over ? Eigen::Vector3d(p - (face.normal.dot(p) - face.offset) * face.normal) : best;
}

SurfacePoint nearestOnHull(const Hull& hull, const Eigen::Vector3d& p) {
  SurfacePoint inside{-kInfinity, Eigen::Vector3d::UnitY()};
  double least = kInfinity;
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (const Hull::Face& face : hull.faces) {
    const double above = face.normal.dot(p) - face.offset;
    if (above > inside.distance) inside = {above, face.normal};
    if (above <= 0) continue;
    const Eigen::Vector3d q = nearestOnFace(face, p);
    if ((p - q).squaredNorm() < least) {
      least = (p - q).squaredNorm();
      best = q;
    }
  }
  if (inside.distance <= 0) return inside;
  const double distance = std::sqrt(least);
  if (!(distance > 0)) return inside;
  return {distance, (p - best) / distance};
}

// Either side can be touched.
SurfacePoint nearestOnMesh(const TriangleMesh& mesh, const Eigen::Vector3d& p, double reach) {
  const MeshPoint near = mesh.nearest(p, reach);
  if (!std::isfinite(near.distance)) return {kInfinity, Eigen::Vector3d::UnitY()};
  return {near.distance,
          near.distance > 0 ? Eigen::Vector3d((p - near.at) / near.distance) : mesh.normal(near.triangle)};
}

SurfacePoint nearestLocal(const Collider& c, const Eigen::Vector3d& p, double reach) {
  switch (c.kind) {
    case Collider::Kind::Plane:
      assert(std::abs(c.size.squaredNorm() - 1) < 1e-6);  // Bullet normalises in float
      return {c.size.dot(p) - c.offset, c.size};
    case Collider::Kind::Box:
      return nearestOnBox(c.size, p);
    case Collider::Kind::Hull:
      return nearestOnHull(*c.hull, p);
    case Collider::Kind::Capsule:
      return nearestOnCapsule(c.size.x(), c.size.y(), p);
    case Collider::Kind::Cylinder:
      return nearestOnCylinder(c.size.x(), c.size.y(), p);
    case Collider::Kind::Cone:
      return nearestOnCone(c.size.x(), c.size.y(), p);
    case Collider::Kind::Mesh:
      return nearestOnMesh(*c.mesh, p, reach);
    case Collider::Kind::Sphere:
      break;
  }
  const double length = p.norm();
  return {length - c.size.x(), length > 0 ? Eigen::Vector3d(p / length) : Eigen::Vector3d::UnitY()};
}

// Faces within 2.6 degrees are one plane.
constexpr double kLeastSharpness = 1e-3;

// Edges that two faces share, and no others: the faces are closed but for slivers.
void listEdges(Hull& hull) {
  hull.edges.clear();
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const Hull::Face& face = hull.faces[f];
    for (std::size_t v = 0; v < face.vertices.size(); ++v) {
      const Eigen::Vector3d &from = face.vertices[v], &to = face.vertices[(v + 1) % face.vertices.size()];
      for (std::size_t g = f + 1; g < hull.faces.size(); ++g) {
        const Hull::Face& other = hull.faces[g];
        const auto at = std::find(other.vertices.begin(), other.vertices.end(), to);
        if (at == other.vertices.end()) continue;
        if ((at + 1 == other.vertices.end() ? other.vertices.front() : at[1]) != from) continue;
        const double sharpness = 1 - face.normal.dot(other.normal);
        if (sharpness > kLeastSharpness)
          hull.edges.push_back({from, to - from, sharpness, {face.normal, other.normal}});
      }
    }
  }
}

}  // namespace

void listCorners(Hull& hull) {
  listEdges(hull);
  hull.corners.clear();
  std::size_t most = 3;
  for (const Hull::Face& face : hull.faces) {
    most = std::max(most, face.vertices.size());
    for (const Eigen::Vector3d& v : face.vertices)
      if (std::find(hull.corners.begin(), hull.corners.end(), v) == hull.corners.end())
        hull.corners.push_back(v);
  }
  // Lying on its largest face the hull has a contact's stiffness; a single corner is not softer than an
  // eighth.
  hull.cornerWeight = 1 / double(std::min<std::size_t>(most, 8));
}

Eigen::AlignedBox3d Collider::bounds() const {
  Eigen::AlignedBox3d local;
  switch (kind) {
    case Kind::Plane:
      return {Eigen::Vector3d::Constant(-kInfinity), Eigen::Vector3d::Constant(kInfinity)};
    case Kind::Sphere:
      local = {Eigen::Vector3d::Constant(-size.x()), Eigen::Vector3d::Constant(size.x())};
      break;
    case Kind::Box:
      local = {-size, size};
      break;
    case Kind::Hull:
      for (const Hull::Face& face : hull->faces)
        for (const Eigen::Vector3d& v : face.vertices) local.extend(v);
      break;
    case Kind::Mesh:
      local = mesh->bounds();
      break;
    case Kind::Capsule:
    case Kind::Cylinder:
    case Kind::Cone:
      local.max() = {size.x(), size.y() + (kind == Kind::Capsule ? size.x() : 0), size.x()};
      local.min() = -local.max();
      break;
  }
  const Eigen::Vector3d reach =
      place.linear().cwiseAbs() * (0.5 * local.sizes()) + Eigen::Vector3d::Constant(rounding);
  const Eigen::Vector3d centre = place * local.center();
  return {centre - reach, centre + reach};
}

double Collider::thickness() const {
  double least = kInfinity;
  switch (kind) {
    case Kind::Plane:
    case Kind::Mesh:
      return kInfinity;
    case Kind::Sphere:
    case Kind::Capsule:
      least = 2 * size.x();
      break;
    case Kind::Box:
      least = 2 * size.minCoeff();
      break;
    case Kind::Cylinder:
      least = 2 * std::min(size.x(), size.y());
      break;
    case Kind::Cone:  // heights of the triangle that it is cut to along its axis
      least = 2 * size.y() * std::min(1.0, 2 * size.x() / std::hypot(size.x(), 2 * size.y()));
      break;
    case Kind::Hull:
      for (const Hull::Face& face : hull->faces) {
        double width = 0;
        for (const Eigen::Vector3d& v : hull->corners)
          width = std::max(width, face.offset - face.normal.dot(v));
        least = std::min(least, width);
      }
      break;
  }
  return least + 2 * rounding;
}

SurfacePoint nearest(const Collider& collider, const Eigen::Vector3d& point, double reach) {
  SurfacePoint s =
      nearestLocal(collider, collider.place.inverse(Eigen::Isometry) * point, reach + collider.rounding);
  s.distance -= collider.rounding;
  s.normal = collider.place.linear() * s.normal;
  return s;
}

}  // namespace rubble::edem
