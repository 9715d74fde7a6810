// One row a key; a new key is one row here and a field in scene.h. Rows are read in this order, so that a row
// may look at what those above it have set.
#include "demo/scene_keys.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/hash.h"
#include "demo/key_rows.h"
#include "demo/solid.h"
#include "rubble/limits.h"

namespace rubble::demo {
namespace {

// What an object or the air may be is the library's to say (rubble/limits.h). These are the program's own:
// what Bullet's bodies, the pictures and the run may be. Their lower ends stay above 0 as floats too.
constexpr Limits kRotation = {-3600, 3600};  // [degrees]: ten turns
constexpr Limits kMass = {1e-6, 1e9};        // of Bullet's bodies [kg]
constexpr Limits kRestitution = {0, 1};
constexpr Limits kBulletRate = {1, 1e5};         // [Hz]
constexpr Limits kFrames = {1, 1e6};             // four and a half hours at 60 Hz
constexpr Limits kFps = {1, 1e4};                // [1/s]
constexpr Limits kSeed = {0, 9007199254740991};  // 2^53 - 1: whole numbers that JSON keeps exactly
constexpr double kLowestSun = 1e-3;              // sine of its height; below, shadows have no end
constexpr Limits kAmbient = {0, 10};             // factor on the usual light

template <class T>
Table<T> withPlacement(Table<T> table, std::string meaning = "where its centre is at the start") {
  table.push_back(vector<T>("position", &T::position, limits::kPosition, "m", std::move(meaning)));
  table.push_back(vector<T>("rotation_degrees", &T::rotationDegrees, kRotation, "degrees",
                            "turned about this axis by its length"));
  return table;
}

template <class T>
Table<T> withMotion(Table<T> table) {
  table.push_back(vector<T>("velocity", &T::velocity, limits::kSpeed, "m/s", "at the start"));
  table.push_back(vector<T>("spin", &T::spin, limits::kSpin, "rad/s", "axis times rate at the start"));
  return table;
}

Key<Material> materialPreset() {
  std::string names;
  for (const std::string& name : materialNames()) names += (names.empty() ? "" : ", ") + name;
  return {"preset",
          names,
          "",
          "named set of constants; the keys below change single ones",
          [](Material& target, const Json& json, const Place& place) {
            target = material(readWord(json, materialNames(), place));
          },
          [](const Material& target) { return target.name; }};
}

const Table<Material>& materialKeys() {
  static const Table<Material> table = {
      materialPreset(),
      number<Material>("density", &Material::density, limits::kDensity, "kg/m^3", "of the solid"),
      number<Material>("youngs_modulus", &Material::youngsModulus, limits::kYoungsModulus, "Pa",
                       "E of the pore springs"),
      number<Material>("tensile_strength", &Material::tensileStrength, limits::kStrength, "Pa", "f_t"),
      number<Material>("compressive_strength", &Material::compressiveStrength, limits::kStrength, "Pa", "f_c")
          .must(
              [](const Material& m) {
                return m.compressiveStrength >= m.tensileStrength
                           ? std::string()
                           : "must be at least tensile_strength, " + shown(m.tensileStrength);
              },
              {"tensile_strength", "preset"}),
      number<Material>("breaking_angle", &Material::breakingAngle, limits::kBreakingAngle, "rad",
                       "relative rotation at which a spring breaks under the criterion `stretch`"),
      number<Material>("stretch_threshold", &Material::stretchThreshold, limits::kStretchThreshold, "",
                       "relative stretch at which a spring breaks under the criterion `stretch`"),
      number<Material>("spring_damping", &Material::springDamping, limits::kSpringDamping, "",
                       "damping ratio of the springs at their highest frequency"),
      number<Material>("contact_stiffness", &Material::contactStiffness, limits::kContactStiffness, "",
                       "k_c = this times E h, h the element spacing"),
      number<Material>("contact_damping", &Material::contactDamping, limits::kContactDamping, "",
                       "damping ratio of contacts"),
      number<Material>("friction", &Material::friction, limits::kFriction, "",
                       "Coulomb's coefficient of contacts"),
      number<Material>("restitution", &Material::restitution, limits::kRestitution, "",
                       "of a blow; times that of what it hits"),
      number<Material>("rolling_friction", &Material::rollingFriction, limits::kRollingFriction, "",
                       "resistance of contacts to rolling and twisting, in radii of curvature"),
      number<Material>("bond_work_index", &Material::bondWorkIndex, limits::kBondWorkIndex, "kWh/t",
                       "Bond's Wi"),
      number<Material>("crush_efficiency", &Material::crushEfficiency, limits::kCrushEfficiency, "",
                       "share of Bond's energy that an element's springs must hold to crush it"),
      number<Material>("size_modulus", &Material::sizeModulus, limits::kSizeModulus, "",
                       "m of the Gaudin-Schuhmann distribution of sizes"),
      number<Material>("dust_radius", &Material::dustRadius, limits::kDustRadius, "m",
                       "radius of the largest dust grain"),
      number<Material>("debris_speed", &Material::debrisSpeed, limits::kDebrisSpeed, "",
                       "speed of debris relative to their element, over the element's own"),
  };
  return table;
}

const Table<Model>& modelKeys() {
  static const Table<Model> table = {
      {"preset", "default, paper", "", "reading of the paper; the keys below change single points",
       [](Model& target, const Json& json, const Place& place) {
         target = readWord(json, {"default", "paper"}, place) == "paper" ? Model::paper() : Model();
       },
       [](const Model&) { return std::string("default"); }},
      word<Model, BreakCriterion>(
          "break_criterion", &Model::breakCriterion,
          {{"mohr_coulomb", BreakCriterion::MohrCoulomb}, {"stretch", BreakCriterion::Stretch}},
          "when a spring breaks"),
      flag<Model>("rotational_stiffness", &Model::rotationalStiffness, "springs resist bending and twisting"),
      flag<Model>("contact_beside_spring", &Model::contactBesideSpring,
                  "spring and contact act on a pair together"),
      flag<Model>("coulomb_friction", &Model::coulombFriction, "friction is limited by the normal force"),
      flag<Model>("contact_memory", &Model::contactMemory,
                  "contacts remember what slid and rolled: things stand on slopes and come to rest"),
      flag<Model>("cell_faces", &Model::cellFaces,
                  "rigid bodies touch the faces that are drawn, not spheres"),
      flag<Model>("conserve_debris", &Model::conserveDebris,
                  "debris keep momentum, spin and energy of their element"),
      word<Model, DebrisSizes>("debris_sizes", &Model::debrisSizes,
                               {{"mass", DebrisSizes::Mass}, {"number", DebrisSizes::Number}},
                               "pieces carry equal mass, or eq. (5) to the letter"),
      word<Model, CellJoining>("cell_joining", &Model::cellJoining,
                               {{"transitive", CellJoining::Transitive}, {"direct", CellJoining::Direct}},
                               "which cells are drawn joined at a vertex"),
  };
  return table;
}

std::string thickest(const SceneObject& o) {
  return shown(o.size.minCoeff() / 2);
}

// As 16 hexadecimal digits; of a file that cannot be read, a word.
std::string hashOfFile(const std::filesystem::path& file) {
  std::error_code error;
  std::ifstream stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, error) || !stream) return "unreadable";
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  base::Fnv1a hash;
  for (const char byte : bytes.str()) hash.add(byte);
  std::ostringstream text;
  text << std::hex << hash.value();
  return text.str();
}

bool isBox(const SceneObject& o) {
  return o.mesh.empty() && o.asset.empty();
}

bool isCookedHere(const SceneObject& o) {
  return o.asset.empty();
}

// A file, named from the folder of the scene's file that says so; on the command line from the working
// folder. It is listed with a hash of what is in it, and not at all where there is none.
Key<SceneObject> file(std::string name, std::filesystem::path SceneObject::*member, std::string meaning) {
  return {.name = std::move(name),
          .type = "path from this file's folder",
          .unit = "",
          .meaning = std::move(meaning),
          .read =
              [=](SceneObject& target, const Json& json, const Place& place) {
                if (!json.is_string() || json.get_ref<const std::string&>().empty())
                  place.refuse("is " + shown(json), "must be the name of a file");
                target.*member =
                    std::filesystem::path(place.source()).parent_path() / json.get<std::string>();
              },
          .standard = [](const SceneObject&) { return std::string("none"); },
          .isChoice = true,
          .listNested =
              [=](std::vector<std::string>& lines, const SceneObject& target, const std::string& path) {
                const std::filesystem::path& named = target.*member;
                if (!named.empty()) lines.push_back(path + " = " + named.string() + ", " + hashOfFile(named));
              }};
}

const Table<SceneObject>& objectKeys() {
  static const Table<SceneObject> table = withMotion(withPlacement<SceneObject>(
      {
          file("mesh", &SceneObject::mesh, "closed surface to cook instead of a box: OBJ, OFF, PLY or STL"),
          number<SceneObject>("scale", &SceneObject::scale, kMeshScale, "m", "length of one unit of the mesh")
              .only("meshes", [](const SceneObject& o) { return !o.mesh.empty(); }),
          file("asset", &SceneObject::asset, "cooked by `rubble cook`; keeps its elements and anchors")
              .only("objects without a mesh", [](const SceneObject& o) { return o.mesh.empty(); }),
          word<SceneObject, SceneObject::Shape>("shape", &SceneObject::shape,
                                                {{"box", SceneObject::Shape::Box}}, "form of the solid")
              .only("boxes", isBox),
          vector<SceneObject>("size", &SceneObject::size, limits::kLength, "m",
                              "full edge lengths of the box")
              .only("boxes", isBox)
              .required(),
          whole<SceneObject>("elements", &SceneObject::elements, limits::kElements, "",
                             "how many elements it is cut into")
              .only("boxes and meshes", isCookedHere),
          number<SceneObject>("radius", &SceneObject::radius, limits::kElementRadius, "m",
                              "of the elements; 0 is chosen from `fill`")
              .only("boxes and meshes", isCookedHere)
              .must(
                  [](const SceneObject& o) {
                    return !isBox(o) || o.radius <= o.size.minCoeff() / 2
                               ? std::string()
                               : "must be at most " + thickest(o) + ", half the smallest edge of the box";
                  },
                  {"size", "shape"}),
          number<SceneObject>("fill", &SceneObject::fill, limits::kFill, "",
                              "share of the solid that the spheres fill when `radius` is 0")
              .only("boxes and meshes", isCookedHere),
          Key<SceneObject>{
              "anchor", "[x, y, z], not zero", "", "the flat side that faces this way is tied to the world",
              [](SceneObject& target, const Json& json, const Place& place) {
                target.anchor = readVector(json, limits::kPosition, place);
                if (target.anchor->norm() < 1e-9) place.refuse("has no direction", "must not be [0, 0, 0]");
              },
              [](const SceneObject& o) { return o.anchor ? shown(*o.anchor) : std::string("not tied"); }}
              .only("boxes and meshes", isCookedHere),
          number<SceneObject>("mass_damping", &SceneObject::massDamping, limits::kMassDamping, "1/s",
                              "decay rate of the deformation; the rigid motion is not damped"),
          word<SceneObject, Regime>(
              "regime", &SceneObject::regime,
              {{"elements", Regime::Elements}, {"rigid_until_struck", Regime::RigidUntilStruck}},
              "who moves it: its elements, or Bullet as one rigid body until something strikes it"),
          object<SceneObject, Material>("material", &SceneObject::material, materialKeys(),
                                        "what it is made of"),
          object<SceneObject, Model>("model", &SceneObject::model, modelKeys(), "reading of the paper"),
      },
      "where its centre is at the start; of a mesh or an asset, its own origin"));
  return table;
}

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
