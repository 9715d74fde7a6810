// Depths are those of the contacts: elements are spheres to one another, and bodies of Bullet are what the
// plugin makes of them. The spheres lie inside of the solid, so no overlap is told that is none.
#include "demo/overlaps.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "bullet/rigid_proxies.h"
#include "demo/input_error.h"
#include "edem/grid.h"

namespace rubble::demo {
namespace {

// Places are rounded, and spheres of a packing may protrude by a hundredth.
constexpr double kTouching = 0.25;  // [radius of an element]
constexpr double kStanding = 1;     // [radius of an element] in a static body

std::string place(const char* list, std::size_t index) {
  return std::string(list) + "." + std::to_string(index);
}

// Three digits are enough to move something by.
std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", length);
  return text;
}

// An object in the world's frame.
struct Elements {
  explicit Elements(const StandingObject& object) : radius(object.asset->radius) {
    for (const Eigen::Vector3d& centre : object.asset->positions) centres.push_back(object.pose * centre);
    for (const CellVertex& vertex : object.asset->vertices)
      vertices.push_back(object.pose * vertex.position.cast<double>());
    for (const Eigen::Vector3d& centre : centres) bounds.extend(centre);
    const Eigen::Vector3d around = Eigen::Vector3d::Constant(radius);
    bounds = {bounds.min() - around, bounds.max() + around};
    for (const Eigen::Vector3d& vertex : vertices) bounds.extend(vertex);
  }
  double radius;  // [m]
  std::vector<Eigen::Vector3d> centres, vertices;
  Eigen::AlignedBox3d bounds;
};

// How deep the object reaches into the collider of a body at `pose` [m]; 0 and less where they are apart.
double depthIn(edem::Collider collider, const Eigen::Isometry3d& pose, const Elements& object) {
  collider.rounding = 0;  // of hulls; what the scene says is their corners
  const Eigen::Isometry3d toBody = pose.inverse(Eigen::Isometry);
  double deepest = 0;
  for (const Eigen::Vector3d& centre : object.centres)
    deepest = std::max(deepest, object.radius - edem::nearest(collider, toBody * centre).distance);
  for (const Eigen::Vector3d& vertex : object.vertices)
    deepest = std::max(deepest, -edem::nearest(collider, toBody * vertex).distance);
  return deepest;
}

double depthIn(const btRigidBody& body, const Elements& object, bullet::RigidProxies& proxies) {
  const edem::RigidProxy proxy = proxies.make(body);
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
  double nearest = reach;
  for (const Eigen::Vector3d& centre : a.centres) {
    if (b.bounds.squaredExteriorDistance(centre) > reach * reach) continue;
    grid.visitBox(centre - around, centre + around, [&](std::uint32_t other) {
      nearest = std::min(nearest, (b.centres[other] - centre).norm());
    });
  }
  return reach - nearest;
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
      log(LogLevel::Warning, scene.blamed(name, {place("statics", k)}) + ": " + name + ": starts " +
                                 metres(depth) + " inside of " + place("statics", k) +
                                 ": its elements in there may be thrown out; lift it by as much, unless it "
                                 "is a foundation");
    }
  }
}

}  // namespace rubble::demo
