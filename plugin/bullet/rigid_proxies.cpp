#include "bullet/rigid_proxies.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btMultiSphereShape.h>
#include <BulletCollision/CollisionShapes/btShapeHull.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/CollisionShapes/btUniformScalingShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <LinearMath/btConvexHullComputer.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/hash.h"
#include "bullet/convert.h"
#include "bullet/locked_motion.h"
#include "bullet/multibody_links.h"

namespace rubble::bullet {
RUBBLE_ABI_BEGIN
namespace {

std::uint64_t hashOf(const std::vector<Eigen::Vector3d>& points) {
  base::Fnv1a hash;
  for (const Eigen::Vector3d& p : points) hash.addAll(p);
  return hash.value();
}

std::shared_ptr<const edem::Hull> makeHull(const std::vector<Eigen::Vector3d>& points) {
  std::vector<btVector3> input;
  for (const Eigen::Vector3d& p : points) input.push_back(toBullet(p));
  btConvexHullComputer computer;
  computer.compute(&input[0][0], int(sizeof(btVector3)), int(input.size()), 0, 0);
  auto hull = std::make_shared<edem::Hull>();
  for (int f = 0; f < computer.faces.size(); ++f) {
    edem::Hull::Face face;
    const btConvexHullComputer::Edge* first = &computer.edges[computer.faces[f]];
    const btConvexHullComputer::Edge* edge = first;
    do {
      face.vertices.push_back(toEigen(computer.vertices[edge->getSourceVertex()]));
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    // Newell's normal: right for faces with nearly collinear corners.
    Eigen::Vector3d area = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
      area += face.vertices[i].cross(face.vertices[(i + 1) % face.vertices.size()]);
      middle += face.vertices[i] / double(face.vertices.size());
    }
    if (!(area.norm() > 0)) continue;
    face.normal = area.normalized();
    face.offset = face.normal.dot(middle);
    hull->faces.push_back(std::move(face));
  }
  // Bullet does not promise the side its faces turn; the inside is where the points' mean is.
  Eigen::Vector3d inside = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) inside += p / double(points.size());
  for (edem::Hull::Face& face : hull->faces) {
    if (face.normal.dot(inside) <= face.offset) continue;
    face.normal = -face.normal;
    face.offset = -face.offset;
    std::reverse(face.vertices.begin(), face.vertices.end());
  }
  edem::listCorners(*hull);
  return hull;
}

// What an application or a joint has spoiled would spoil the elements.
bool isFinite(const edem::RigidProxy& proxy) {
  return proxy.position.allFinite() && proxy.orientation.coeffs().allFinite() && proxy.velocity.allFinite() &&
         proxy.spin.allFinite() && proxy.acceleration.allFinite() && proxy.angularAcceleration.allFinite() &&
         std::isfinite(proxy.inverseMass) && proxy.inverseInertia.allFinite();
}

// Turns y to the axis `up`.
Eigen::Matrix3d upright(int up) {
  Eigen::Matrix3d turn;
  turn << Eigen::Vector3d::Unit((up + 2) % 3), Eigen::Vector3d::Unit(up), Eigen::Vector3d::Unit((up + 1) % 3);
  return turn;
}

}  // namespace

std::uint64_t keyOf(const btCollisionObject& object) {
  const btBroadphaseProxy* handle = object.getBroadphaseHandle();
  return handle ? std::uint64_t(std::uint32_t(handle->m_uniqueId)) + 1 : 0;
}

std::shared_ptr<const edem::Hull> RigidProxies::hullOf(const btCollisionShape& shape,
                                                       const std::vector<Eigen::Vector3d>& points) {
  CachedHull& cached = m_hulls[&shape];
  const std::uint64_t hash = hashOf(points);
  if (!cached.hull || cached.points != hash) cached = {hash, makeHull(points)};
  return cached.hull;
}

bool RigidProxies::addRound(const btCollisionShape& shape, edem::Collider c,
                            std::vector<edem::Collider>& parts) {
  using Kind = edem::Collider::Kind;
  int up = 1;
  switch (shape.getShapeType()) {
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      c.kind = Kind::Capsule;
      c.size = {double(capsule.getRadius()), double(capsule.getHalfHeight()), 0};
      up = capsule.getUpAxis();
      break;
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      up = cylinder.getUpAxis();
      c.kind = Kind::Cylinder;
      c.rounding = double(cylinder.getMargin());
      c.size = {double(cylinder.getRadius()) - c.rounding, double(cylinder.getHalfExtentsWithoutMargin()[up]),
                0};
      break;
    }
    case CONE_SHAPE_PROXYTYPE: {
      const auto& cone = static_cast<const btConeShape&>(shape);
      c.kind = Kind::Cone;
      c.rounding = double(cone.getMargin());  // Bullet's cone is larger by it all round
      c.size = {double(cone.getRadius()), 0.5 * double(cone.getHeight()), 0};
      up = cone.getConeUpIndex();
      break;
    }
    default:
      return false;
  }
  if (!(c.size.head<2>().minCoeff() >= 0) || !(c.size.x() + c.rounding > 0)) return false;
  c.place.linear() = c.place.linear() * upright(up);
  parts.push_back(c);
  return true;
}

bool RigidProxies::addSpheres(const btMultiSphereShape& shape, edem::Collider c,
                              std::vector<edem::Collider>& parts) {
  const btVector3& scale = shape.getLocalScaling();
  const int count = shape.getSphereCount();
  if (count < 1 || count > 2 || scale.x() != scale.y() || scale.x() != scale.z()) return false;
  if (count == 2 && shape.getSphereRadius(0) != shape.getSphereRadius(1)) return false;
  const Eigen::Vector3d a = toEigen(shape.getSpherePosition(0) * scale),
                        b = toEigen(shape.getSpherePosition(count - 1) * scale);
  const double half = 0.5 * (b - a).norm();
  c.kind = half > 0 ? edem::Collider::Kind::Capsule : edem::Collider::Kind::Sphere;
  c.size = {double(shape.getSphereRadius(0) * scale.x()), half, 0};
  c.place.translation() += c.place.linear() * (0.5 * (a + b));
  c.place.linear() = c.place.linear() *
                     Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), b - a).toRotationMatrix();
  parts.push_back(c);
  return true;
}

// False where the child is no solid in closed form: its hull is then taken with that of others.
bool RigidProxies::addScaled(const btUniformScalingShape& shape, const edem::Collider& c,
                             std::vector<edem::Collider>& parts) {
  std::vector<edem::Collider> own;
  const btConvexShape& child = *shape.getChildShape();
  if (!addSolid(child, edem::Collider(), own)) return false;
  const double by = double(shape.getUniformScalingFactor());
  for (edem::Collider& part : own) {
    part.size *= by;
    part.rounding *= by;
    part.place.translation() *= by;
    part.place = c.place * part.place;
    parts.push_back(part);
  }
  return true;
}

// Shapes with a signed distance in closed form, but for planes.
bool RigidProxies::addSolid(const btCollisionShape& shape, edem::Collider c,
                            std::vector<edem::Collider>& parts) {
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
      c.kind = edem::Collider::Kind::Sphere;
      c.size.x() = double(static_cast<const btSphereShape&>(shape).getRadius());
      parts.push_back(c);
      return true;
    case BOX_SHAPE_PROXYTYPE:
      c.kind = edem::Collider::Kind::Box;
      c.size = toEigen(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
      parts.push_back(c);
      return true;
    case MULTI_SPHERE_SHAPE_PROXYTYPE:
      return addSpheres(static_cast<const btMultiSphereShape&>(shape), c, parts);
    case UNIFORM_SCALING_SHAPE_PROXYTYPE:
      return addScaled(static_cast<const btUniformScalingShape&>(shape), c, parts);
    default:
      return addRound(shape, c, parts);
  }
}

// One part for each box: where two of them have a triangle, the deeper counts.
void RigidProxies::addTriangles(const btConcaveShape& shape, edem::Collider c, const Asked& asked,
                                std::vector<edem::Collider>& parts) {
  c.kind = edem::Collider::Kind::Mesh;
  c.rounding = double(shape.getMargin());
  const Eigen::Isometry3d back = (asked.body * c.place).inverse(Eigen::Isometry);
  for (const Eigen::AlignedBox3d& box : asked.boxes) {
    const Eigen::Vector3d half = back.linear().cwiseAbs() * (0.5 * box.sizes()) +
                                 Eigen::Vector3d::Constant(c.rounding),
                          middle = back * box.center();
    c.mesh = m_meshes.of(shape, {middle - half, middle + half});
    if (c.mesh) parts.push_back(c);
  }
}

void RigidProxies::addShape(const btCollisionShape& shape, const Eigen::Isometry3d& place, const Asked& asked,
                            std::vector<edem::Collider>& parts) {
  edem::Collider c;
  c.place = place;
  if (addSolid(shape, c, parts)) return;
  std::vector<Eigen::Vector3d> points;
  switch (shape.getShapeType()) {
    case STATIC_PLANE_PROXYTYPE: {
      const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
      c.kind = edem::Collider::Kind::Plane;
      c.size = toEigen(plane.getPlaneNormal());
      c.offset = double(plane.getPlaneConstant());
      parts.push_back(c);
      return;
    }
    case COMPOUND_SHAPE_PROXYTYPE: {
      const auto& compound = static_cast<const btCompoundShape&>(shape);
      for (int i = 0; i < compound.getNumChildShapes(); ++i)
        addShape(*compound.getChildShape(i), place * toEigen(compound.getChildTransform(i)), asked, parts);
      return;
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape);
      for (int i = 0; i < hull.getNumPoints(); ++i) points.push_back(toEigen(hull.getScaledPoint(i)));
      c.rounding = double(hull.getMargin());
      break;
    }
    default:
      if (shape.isConcave() && shape.getShapeType() != EMPTY_SHAPE_PROXYTYPE)
        return addTriangles(static_cast<const btConcaveShape&>(shape), c, asked, parts);
      if (!shape.isConvex()) break;
      // Any other convex shape by the 42 directions of Bullet's own hull of it, margin included.
      btShapeHull sampled(static_cast<const btConvexShape*>(&shape));
      if (sampled.buildHull(0))
        for (int i = 0; i < sampled.numVertices(); ++i)
          points.push_back(toEigen(sampled.getVertexPointer()[i]));
      break;
  }
  if (points.size() >= 4) {
    c.kind = edem::Collider::Kind::Hull;
    c.hull = hullOf(shape, points);
    if (c.hull->faces.size() >= 4) {
      parts.push_back(c);
      return;
    }
  }
  refuse(shape);
}

// Once for each kind, and once more for the first of it that has no volume.
void RigidProxies::refuse(const btCollisionShape& shape) {
  const bool flat = shape.isConvex();
  const int type = 2 * shape.getShapeType() + (flat ? 1 : 0);
  if (std::find(m_refused.begin(), m_refused.end(), type) != m_refused.end()) return;
  m_refused.push_back(type);
  if (shape.getShapeType() == SOFTBODY_SHAPE_PROXYTYPE) {  // elements meet its nodes (SoftContacts)
    if (m_log) m_log(LogLevel::Warning, "debris pass through soft bodies");
    return;
  }
  if (m_log)
    m_log(LogLevel::Warning, std::string("shape ") + shape.getName() +
                                 " does not touch the elements of destructible bodies: " +
                                 (flat ? "it has no volume (its points lie in a plane, on a line or on one "
                                         "place); give it thickness"
                                       : "it is none of Bullet's convex or concave shapes"));
}

edem::RigidProxy RigidProxies::make(const btCollisionObject& object,
                                    std::span<const Eigen::AlignedBox3d> boxes) {
  edem::RigidProxy proxy;
  proxy.position = toEigen(object.getWorldTransform().getOrigin());
  proxy.orientation = toEigen(object.getWorldTransform().getRotation()).normalized();
  proxy.friction = double(object.getFriction());
  proxy.restitution = double(object.getRestitution());
  proxy.key = keyOf(object);
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  // Bullet's manual makes kinematic bodies of static ones and leaves the flag for static set.
  proxy.kinematic = object.isKinematicObject();
  if (rigid && (proxy.kinematic || !object.isStaticObject())) {
    proxy.velocity = toEigen(rigid->getLinearVelocity());
    proxy.spin = toEigen(rigid->getAngularVelocity());
    const bool locked = rigid->getLinearFactor().isZero() && rigid->getAngularFactor().isZero();
    proxy.inverseMass = proxy.kinematic || locked ? 0.0 : double(rigid->getInvMass());
  }
  if (const auto* link = btMultiBodyLinkCollider::upcast(&object)) {
    const LinkMotion motion = motionOf(*link);
    proxy.velocity = motion.head<3>();
    proxy.spin = motion.tail<3>();
    proxy.kinematic = !motion.isZero(0);  // of mass 0 but on its way, for who asks between the ticks
  }
  if (proxy.isDynamic()) {
    // All that Bullet's solver will integrate in this tick: gravity and the application's forces.
    proxy.acceleration = proxy.inverseMass * toEigen(rigid->getTotalForce());
    proxy.inverseInertia = toEigen(rigid->getInvInertiaDiagLocal());
    proxy.angularAcceleration =
        toEigen(btVector3(rigid->getInvInertiaTensorWorld() * rigid->getTotalTorque()));
    if ((proxy.mobility = lockedMobility(*rigid))) {
      const auto most = [](const Eigen::Matrix3d& share) {
        return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(share, Eigen::EigenvaluesOnly).eigenvalues()[2];
      };
      const double moves = most(proxy.mobility->topLeftCorner<3, 3>());
      if (moves > 0) proxy.inverseMass = moves;  // one that only turns is no static one
      proxy.inverseInertia.setConstant(most(proxy.mobility->bottomRightCorner<3, 3>()));
    }
  }
  if (isFinite(proxy)) {
    Eigen::Isometry3d body(proxy.orientation);
    body.pretranslate(proxy.position);
    addShape(*object.getCollisionShape(), Eigen::Isometry3d::Identity(), {body, boxes}, proxy.parts);
  } else if (m_log && !std::exchange(m_toldOfNumbers, true)) {
    m_log(LogLevel::Warning,
          "a rigid body's place, velocity or forces are not finite numbers: it does not touch destructible "
          "bodies while they are so");
  }
  return proxy;
}

RUBBLE_ABI_END
}  // namespace rubble::bullet
