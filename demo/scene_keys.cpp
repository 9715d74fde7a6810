// One row a key; a new key is one row here and a field in scene.h. Rows are read in this order, so that a row
// may look at what those above it have set.
#include "demo/scene_keys.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "demo/key_rows.h"
#include "demo/object_keys.h"
#include "demo/placement_keys.h"
#include "rubble/limits.h"

namespace rubble::demo {
namespace {

// What an object or the air may be is the library's to say (rubble/limits.h). These are the program's own:
// what Bullet's bodies, the pictures and the run may be. Their lower ends stay above 0 as floats too.
constexpr Limits kMass = {1e-6, 1e9};  // of Bullet's bodies [kg]
constexpr Limits kRestitution = {0, 1};
constexpr Limits kBulletRate = {1, 1e5};         // [Hz]
constexpr Limits kFrames = {1, 1e6};             // four and a half hours at 60 Hz
constexpr Limits kFps = {1, 1e4};                // [1/s]
constexpr Limits kSeed = {0, 9007199254740991};  // 2^53 - 1: whole numbers that JSON keeps exactly
constexpr double kLowestSun = 1e-3;              // sine of its height; below, shadows have no end
constexpr Limits kFragmentBodyElements = {0, 1e7};
constexpr Limits kMaxNewBodies = {1, 1000};
constexpr Limits kAmbient = {0, 10};  // factor on the usual light

// Refuses points on one place, line or plane. Bullet rounds the corners of a hull to 1e-4 of its extent, so a
// thickness below a few of these is none.
void requireVolume(const std::vector<Eigen::Vector3d>& points, const Place& place) {
  constexpr double kThinnest = 1e-3;  // of the length
  const auto farthest = [&](const auto& distance) {
    double most = 0;
    std::size_t which = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const double d = distance(points[i]); d > most) most = d, which = i;
    return std::pair(most, points[which]);
  };
  const Eigen::Vector3d a = points.front();
  const auto [length, b] = farthest([&](const Eigen::Vector3d& p) { return (p - a).norm(); });
  const std::string allowed = "must be a body at least " + shown(kThinnest) +
                              " of its length thick (a plate: give both of its faces)";
  if (!(length >= limits::kLength.low)) place.refuse("is one place", allowed);
  const Eigen::Vector3d along = (b - a) / length;
  const auto [width, c] = farthest([&](const Eigen::Vector3d& p) { return (p - a).cross(along).norm(); });
  if (!(width >= kThinnest * length)) place.refuse("is a line", allowed);
  const Eigen::Vector3d normal = along.cross(c - a).normalized();
  double low = 0, high = 0;
  for (const Eigen::Vector3d& p : points) {
    low = std::min(low, (p - a).dot(normal));
    high = std::max(high, (p - a).dot(normal));
  }
  if (!(high - low >= kThinnest * length)) place.refuse("is flat: all points lie in one plane", allowed);
}

Key<SceneBody> hullPoints() {
  return {"points",
          "list of at least 4 [x, y, z] that span a volume",
          "m",
          "corners of the hull",
          [](SceneBody& target, const Json& json, const Place& place) {
            requireList(json, place);
            for (std::size_t i = 0; i < json.size(); ++i)
              target.points.push_back(readVector(json[i], limits::kPosition, place.child(std::to_string(i))));
            if (target.points.size() < 4)
              place.refuse("has " + shown(double(json.size())) + " points", "must have 4 or more");
            requireVolume(target.points, place);
          },
          [](const SceneBody&) { return std::string(); }};
}

std::function<bool(const SceneBody&)> is(SceneBody::Shape shape) {
  return [shape](const SceneBody& body) { return body.shape == shape; };
}

Key<SceneBody> sphereRadius() {
  return number<SceneBody>("radius", &SceneBody::radius, limits::kLength, "m", "of the sphere")
      .required()
      .only("sphere", is(SceneBody::Shape::Sphere));
}

Key<SceneBody> boxSize() {
  return vector<SceneBody>("size", &SceneBody::size, limits::kLength, "m", "full edge lengths")
      .required()
      .only("box", is(SceneBody::Shape::Box));
}

Table<SceneBody> withSurface(Table<SceneBody> table) {
  table.push_back(
      number<SceneBody>("friction", &SceneBody::friction, limits::kFriction, "", "Bullet's friction"));
  table.push_back(
      number<SceneBody>("restitution", &SceneBody::restitution, kRestitution, "", "Bullet's restitution"));
  return table;
}

const Table<SceneBody>& impactorKeys() {
  using Shape = SceneBody::Shape;
  static const Table<SceneBody> table = withSurface(withMotion(withPlacement<SceneBody>({
      word<SceneBody, Shape>("shape", &SceneBody::shape,
                             {{"sphere", Shape::Sphere}, {"box", Shape::Box}, {"hull", Shape::Hull}},
                             "form of the body")
          .required(),
      sphereRadius(),
      boxSize(),
      hullPoints().required().only("hull", is(Shape::Hull)),
      number<SceneBody>("mass", &SceneBody::mass, kMass, "kg", "of the body").required(),
  })));
  return table;
}

const Table<SceneBody>& staticKeys() {
  using Shape = SceneBody::Shape;
  static const Table<SceneBody> table = withSurface(withPlacement<SceneBody>({
      word<SceneBody, Shape>("shape", &SceneBody::shape, {{"plane", Shape::Plane}, {"box", Shape::Box}},
                             "form of the body")
          .required(),
      boxSize(),
      direction<SceneBody>("normal", &SceneBody::normal, "out of the solid half of space")
          .only("plane", is(Shape::Plane)),
      number<SceneBody>("offset", &SceneBody::offset, limits::kPosition, "m", "along the normal")
          .only("plane", is(Shape::Plane)),
  }));
  return table;
}

const Table<SceneCamera>& cameraKeys() {
  static const Table<SceneCamera> table = {
      vector<SceneCamera>("eye", &SceneCamera::eye, limits::kPosition, "m", "where the camera stands"),
      vector<SceneCamera>("target", &SceneCamera::target, limits::kPosition, "m", "what it looks at")
          .must(
              [](const SceneCamera& c) {
                const bool differ = c.target.cast<float>() != c.eye.cast<float>();
                return differ ? std::string() : "must differ from camera.eye";
              },
              {"eye"}),
      number<SceneCamera>("field_of_view_degrees", &SceneCamera::fieldOfViewDegrees, limits::kFieldOfView,
                          "degrees", "vertical"),
  };
  return table;
}

const Table<SceneLight>& lightKeys() {
  static const Table<SceneLight> table = {
      direction<SceneLight>("direction", &SceneLight::direction, "in which the light travels")
          .must([](const SceneLight& l) {
            return l.direction.normalized().y() < -kLowestSun
                       ? std::string()
                       : "must go down: its y must be below -0.001 of its length";
          }),
      number<SceneLight>("ambient", &SceneLight::ambient, kAmbient, "",
                         "times the usual light of sky and ground"),
  };
  return table;
}

bool isPowerOfTwo(int n) {
  return (n & (n - 1)) == 0;
}

// As the grid sees it, whose corners are floats.
std::string dustBox(const SceneDust& dust) {
  const Eigen::Vector3f size = dust.max.cast<float>() - dust.min.cast<float>();
  const bool holds = limits::kDustSide.hold(size.minCoeff()) && limits::kDustSide.hold(size.maxCoeff());
  return holds ? "" : "must be above dust.min by " + limits::kDustSide.text() + " m in x, y and z";
}

const Table<SceneDust>& dustKeys() {
  static const Table<SceneDust> table = {
      word<SceneDust, DustBackend>(
          "backend", &SceneDust::backend,
          {{"auto", DustBackend::Auto}, {"cpu", DustBackend::Cpu}, {"gl", DustBackend::Gl}},
          "where it is computed; auto is gl on a graphics card, cpu where GL is software or absent"),
      whole<SceneDust>("resolution", &SceneDust::resolution, limits::kDustResolution, "",
                       "cells along each axis, a power of two")
          .must([](const SceneDust& d) {
            return isPowerOfTwo(d.resolution) ? std::string()
                                              : "must be a power of two, " + limits::kDustResolution.text();
          }),
      vector<SceneDust>("min", &SceneDust::min, limits::kPosition, "m",
                        "lower corner of the grid's box; its floor is ground"),
      vector<SceneDust>("max", &SceneDust::max, limits::kPosition, "m", "upper corner")
          .must(dustBox, {"min"}),
      number<SceneDust>("opacity", &SceneDust::opacity, limits::kDustOpacity, "",
                        "times the extinction of real dust, for the eye"),
      number<SceneDust>("vorticity", &SceneDust::vorticity, limits::kVorticity, "",
                        "strength of vorticity confinement"),
      number<SceneDust>("drag", &SceneDust::drag, limits::kDustDrag, "1/s",
                        "decay rate of the air's velocity"),
      whole<SceneDust>("pressure_cycles", &SceneDust::pressureCycles, limits::kPressureCycles, "",
                       "multigrid cycles of the pressure a step"),
  };
  return table;
}

const Table<SceneDebris>& debrisKeys() {
  static const Table<SceneDebris> table = {
      whole<SceneDebris>("budget", &SceneDebris::budget, limits::kMaxDebris, "",
                         "pieces alive at one time; older resting ones go first"),
  };
  return table;
}

// Not listed where there are none: what has been kept of scenes without stays theirs.
Key<Scene> ofFragmentBodies(const char* name, std::uint32_t Scene::*member, const Limits& limits,
                            const char* meaning) {
  Key<Scene> key = whole<Scene>(name, member, limits, "", meaning);
  key.listNested = [=](std::vector<std::string>& lines, const Scene& scene, const std::string& path) {
    if (scene.fragmentBodyElements > 0) lines.push_back(path + " = " + std::to_string(scene.*member));
  };
  return key;
}

const Table<Scene>& allKeys() {
  static const Table<Scene> table = {
      list<Scene, SceneObject>("objects", &Scene::objects, objectKeys(), "what can break"),
      list<Scene, SceneBody>("impactors", &Scene::impactors, impactorKeys(), "moving rigid bodies"),
      list<Scene, SceneBody>("statics", &Scene::statics, staticKeys(), "rigid bodies that never move"),
      vector<Scene>("gravity", &Scene::gravity, limits::kGravity, "m/s^2", "y is up"),
      number<Scene>("bullet_rate", &Scene::bulletRate, kBulletRate, "Hz", "Bullet's ticks"),
      whole<Scene>("frames", &Scene::frames, kFrames, "", "length of the run"),
      number<Scene>("fps", &Scene::fps, kFps, "1/s", "frames in a second")
          .must(
              [](const Scene& s) {
                return s.fps <= s.bulletRate ? std::string()
                                             : "must be at most bullet_rate, " + shown(s.bulletRate);
              },
              {"bullet_rate"}),
      whole<Scene>("seed", &Scene::seed, kSeed, "", "of the packing and of the debris' sizes"),
      word<Scene, Precision>("precision", &Scene::precision,
                             {{"float", Precision::Float}, {"double", Precision::Double}},
                             "of the elements' state"),
      whole<Scene>("max_substeps_per_frame", &Scene::maxSubstepsPerFrame, limits::kMaxSubstepsPerFrame, "",
                   "a scene that needs more is refused"),
      number<Scene>("substep_safety", &Scene::substepSafety, limits::kSubstepSafety, "",
                    "share of the stable substep that is used"),
      ofFragmentBodies("fragment_body_elements", &Scene::fragmentBodyElements, kFragmentBodyElements,
                       "fragments of so many elements become bodies of their own; 0: none does"),
      ofFragmentBodies("max_new_bodies", &Scene::maxNewBodies, kMaxNewBodies,
                       "of those in a tick of Bullet's; the others wait"),
      flag<Scene>("sleep", &Scene::sleep, "bodies at rest are put to sleep"),
      flag<Scene>("breaking", &Scene::breaking, "springs may break"),
      flag<Scene>("crushing", &Scene::crushing, "elements may be crushed"),
      whole<Scene>("max_events", &Scene::maxEvents, limits::kMaxEvents, "",
                   "events kept a frame; further ones are dropped with a warning"),
      object<Scene, SceneCamera>("camera", &Scene::camera, cameraKeys(), "of the pictures"),
      object<Scene, SceneLight>("light", &Scene::light, lightKeys(), "the sun"),
      part<Scene, SceneDust>("dust", &Scene::dust, dustKeys(),
                             "the dust grid; without this object there is none"),
      part<Scene, SceneDebris>("debris", &Scene::debris, debrisKeys(),
                               "debris particles; without this object there are none"),
  };
  return table;
}

}  // namespace

const Table<Scene>& sceneKeys() {
  return allKeys();
}

std::vector<std::string> listScene(const Scene& scene) {
  std::vector<std::string> lines;
  listValues(allKeys(), lines, scene, "");
  return lines;
}

std::string describeKeys() {
  std::vector<KeyLine> lines;
  describe(allKeys(), lines, "");
  std::string text = "| key | type and limits | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const KeyLine& line : lines) {
    text += "| `" + line.path + "` | " + line.type + " | " + line.unit + " | " + line.standard + " | " +
            line.meaning + " |\n";
  }
  return text;
}

}  // namespace rubble::demo
