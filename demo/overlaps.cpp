// Depths are those of the contacts: elements are spheres to one another, and bodies of Bullet are what the
// plugin makes of them; among themselves Bullet measures. Spheres at a surface may protrude a little and
// count up to it, so no overlap is told that is none.
#include "demo/overlaps.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>
#include <cstdio>
#include <span>
#include <string>

#include "bullet/convert.h"
#include "bullet/rigid_proxies.h"
#include "demo/input_error.h"
#include "edem/grid.h"

namespace rubble::demo {
namespace {

// Places are rounded.
constexpr double kTouching = 0.25;  // [radius of an element]
constexpr double kStanding = 1;     // [radius of an element] in a static body
constexpr double kBodies = 0.1;     // [smallest half extent] of bodies of Bullet in one another

std::string place(const char* list, std::size_t index) {
  return std::string(list) + "." + std::to_string(index);
}

// Three digits are enough to move something by.
std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", length);
  return text;
}

// How far an element reaches: to its sphere, or to the solid's surface where that is nearer [m].
double reachOf(const Asset& asset, std::uint32_t element) {
  double reach = asset.radius;
  for (const CellFace& face : asset.cellFaces(element))
    if (face.neighbour == kNoElement)
      reach = std::min(
          reach, face.normal.cast<double>().dot(face.centroid.cast<double>() - asset.positions[element]));
  return std::max(0.0, reach);
}

// An object in the world's frame.
struct Elements {
  explicit Elements(const StandingObject& object) : radius(object.asset->radius) {
    for (std::uint32_t i = 0; i < object.asset->elementCount(); ++i) {
      centres.push_back(object.pose * object.asset->positions[i]);
      reaches.push_back(reachOf(*object.asset, i));
    }
    for (const CellVertex& vertex : object.asset->vertices)
      vertices.push_back(object.pose * vertex.position.cast<double>());
    for (const Eigen::Vector3d& vertex : vertices) bounds.extend(vertex);
  }
  double radius;  // [m]
  std::vector<Eigen::Vector3d> centres, vertices;
  std::vector<double> reaches;  // of each element [m]
  Eigen::AlignedBox3d bounds;   // of the solid
};

// How deep the object reaches into the collider of a body at `pose` [m]; 0 and less where they are apart.
double depthIn(edem::Collider collider, const Eigen::Isometry3d& pose, const Elements& object) {
  collider.rounding = 0;  // of hulls; what the scene says is their corners
  const Eigen::Isometry3d toBody = pose.inverse(Eigen::Isometry);
  double deepest = 0;
  for (std::size_t i = 0; i < object.centres.size(); ++i)
    deepest =
        std::max(deepest, object.reaches[i] - edem::nearest(collider, toBody * object.centres[i]).distance);
  for (const Eigen::Vector3d& vertex : object.vertices)
    deepest = std::max(deepest, -edem::nearest(collider, toBody * vertex).distance);
  return deepest;
}

double depthIn(const btRigidBody& body, const Elements& object, bullet::RigidProxies& proxies) {
  const edem::RigidProxy proxy = proxies.make(body, std::span(&object.bounds, 1));
  if (!proxy.bounds().intersects(object.bounds)) return 0;
  const Eigen::Isometry3d pose = Eigen::Translation3d(proxy.position) * proxy.orientation;
  double deepest = 0;
  for (const edem::Collider& part : proxy.parts) deepest = std::max(deepest, depthIn(part, pose, object));
  return deepest;
}

// How deep elements of one object reach into those of another [m].
double depthIn(const Elements& a, const Elements& b) {
  if (!a.bounds.intersects(b.bounds)) return 0;
  const double reach = a.radius + b.radius;
  edem::Grid<double> grid;
  const std::vector<std::uint8_t> all(b.centres.size(), 1);
  grid.build(b.centres, all, reach);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(reach);
  double deepest = 0;
  for (std::size_t i = 0; i < a.centres.size(); ++i) {
    const Eigen::Vector3d& centre = a.centres[i];
    if (b.bounds.squaredExteriorDistance(centre) > reach * reach) continue;
    grid.visitBox(centre - around, centre + around, [&](std::uint32_t other) {
      deepest = std::max(deepest, a.reaches[i] + b.reaches[other] - (b.centres[other] - centre).norm());
    });
  }
  return deepest;
}

// Deepest contact [m].
struct Deepest : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& contact, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    depth = std::max(depth, -double(contact.getDistance()));
    return 0;
  }
  double depth = 0;
};

// What Bullet puts around the corners of a hull, or of a compound's hulls at most [m]; other shapes have
// their margin inside.
double around(const btCollisionShape& shape) {
  if (shape.getShapeType() == CONVEX_HULL_SHAPE_PROXYTYPE) return double(shape.getMargin());
  double most = 0;
  if (shape.getShapeType() != COMPOUND_SHAPE_PROXYTYPE) return most;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    most = std::max(most, around(*compound.getChildShape(i)));
  return most;
}

double around(const btRigidBody& body) {
  return around(*body.getCollisionShape());
}

// How far one of two bodies of Bullet is from being outside of the other [m].
double depthIn(btRigidBody& a, btRigidBody& b, btDynamicsWorld& world) {
  Deepest deepest;
  world.contactPairTest(&a, &b, deepest);
  return std::max(0.0, deepest.depth - around(a) - around(b));
}

Eigen::AlignedBox3d boundsOf(const btRigidBody& body) {
  btVector3 low, high;
  body.getAabb(low, high);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(around(body));
  return {bullet::toEigen(low) + margin, bullet::toEigen(high) - margin};
}

double smallestHalf(const btRigidBody& body) {
  btVector3 low, high;
  body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
  const btVector3 size = high - low;
  return double(size[size.minAxis()]) / 2 - around(body);
}

// What makes an end of it: lifting where that alone does, as over a floor.
std::string remedy(const Eigen::AlignedBox3d& bounds, const btRigidBody& solid, double depth) {
  constexpr double kRounding = 1.01;
  const btCollisionShape& shape = *solid.getCollisionShape();
  bool isBelow = false;
  if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) {
    const btVector3 normal =
        solid.getWorldTransform().getBasis() * static_cast<const btStaticPlaneShape&>(shape).getPlaneNormal();
    isBelow = double(normal.y()) * kRounding >= 1;
  } else {
    isBelow = boundsOf(solid).max().y() - bounds.min().y() <= kRounding * depth;
  }
  return isBelow ? "lift it by as much" : "move one of them";
}

void warnOfBodies(const Scene& scene, const StartingBodies& bodies, const LogFunction& log) {
  if (!log) return;
  for (std::size_t i = 0; i < bodies.impactors.size(); ++i) {
    btRigidBody& impactor = *bodies.impactors[i];
    const std::string name = place("impactors", i);
    const auto warn = [&](const std::string& other, double depth, const std::string& then) {
      log(LogLevel::Warning, scene.blamed(name, {other}) + ": " + name + ": starts " + metres(depth) +
                                 " inside of " + other + ": " + then);
    };
    for (std::size_t k = 0; k < bodies.statics.size(); ++k) {
      const double depth = depthIn(impactor, *bodies.statics[k], bodies.world);
      if (depth > kBodies * smallestHalf(impactor))
        warn(place("statics", k), depth,
             "Bullet pushes it out; " + remedy(boundsOf(impactor), *bodies.statics[k], depth));
    }
    for (std::size_t k = 0; k < i; ++k) {
      const double depth = depthIn(impactor, *bodies.impactors[k], bodies.world);
      if (depth > kBodies * std::min(smallestHalf(impactor), smallestHalf(*bodies.impactors[k])))
        warn(place("impactors", k), depth, "Bullet pushes them apart; move one of them");
    }
  }
}

void refuseDeep(const Scene& scene, const std::string& one, const std::string& other, double depth,
                double radius) {
  if (depth <= kTouching * radius) return;
  throw InputError(scene.blamed(one, {other}), one,
                   "starts " + metres(depth) + " inside of " + other + ", must be at most " +
                       metres(kTouching * radius) + " (a quarter of the elements' radius)");
}

}  // namespace

void checkOverlaps(const Scene& scene, const StartingBodies& bodies, const LogFunction& log) {
  bullet::RigidProxies proxies({});
  std::vector<Elements> objects;
  for (const StandingObject& object : bodies.objects) objects.emplace_back(object);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Elements& object = objects[i];
    const std::string name = place("objects", i);
    for (std::size_t k = 0; k < bodies.impactors.size(); ++k)
      refuseDeep(scene, place("impactors", k), name, depthIn(*bodies.impactors[k], object, proxies),
                 object.radius);
    for (std::size_t k = 0; k < i; ++k)
      refuseDeep(scene, name, place("objects", k), depthIn(object, objects[k]),
                 std::min(object.radius, objects[k].radius));
    for (std::size_t k = 0; k < bodies.statics.size(); ++k) {
      const double depth = depthIn(*bodies.statics[k], object, proxies);
      if (!log || depth <= kStanding * object.radius) continue;
      log(LogLevel::Warning,
          scene.blamed(name, {place("statics", k)}) + ": " + name + ": starts " + metres(depth) +
              " inside of " + place("statics", k) + ": its elements in there may be thrown out; " +
              remedy(object.bounds, *bodies.statics[k], depth) + ", unless it is a foundation");
    }
  }
  warnOfBodies(scene, bodies, log);
}

}  // namespace rubble::demo
