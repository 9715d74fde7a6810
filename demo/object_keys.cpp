// One row a key, in the order of the table; see scene_keys.cpp.
#include "demo/object_keys.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/hash.h"
#include "demo/key_rows.h"
#include "demo/placement_keys.h"
#include "demo/primitives.h"
#include "demo/solid.h"
#include "rubble/asset.h"
#include "rubble/error.h"
#include "rubble/limits.h"

namespace rubble::demo {
namespace {

using Shape = SceneObject::Shape;

constexpr Limits kSegments = {8, 256};                       // more are not seen, and each is drawn
constexpr Limits kPartOfColumn = {0, limits::kLength.high};  // [m]; 0 is chosen
constexpr Limits kCorner = {0, limits::kLength.high};        // of an opening [m]
constexpr Limits kBricks = {1, 256};                         // each is drawn and takes its elements
constexpr Limits kOffset = {0, 1};                           // [a brick and a joint]
constexpr std::size_t kMostOpenings = 64;                    // the blocks of a slab grow with their square

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

bool isShape(const SceneObject& o) {
  return o.mesh.empty() && o.asset.empty();
}

std::function<bool(const SceneObject&)> is(Shape shape) {
  return [shape](const SceneObject& o) { return isShape(o) && o.shape == shape; };
}

bool isRound(const SceneObject& o) {
  if (!isShape(o)) return false;
  return o.shape == Shape::Cylinder || o.shape == Shape::Sphere || o.shape == Shape::Torus ||
         o.shape == Shape::Column;
}

bool isCookedHere(const SceneObject& o) {
  return o.asset.empty();
}

// A ring without a hole is none.
std::string torusSize(const SceneObject& o) {
  constexpr double kThickest = 0.49;  // [x and z]
  const double limit = kThickest * std::min(o.size.x(), o.size.z());
  if (!is(Shape::Torus)(o) || o.size.y() <= limit) return "";
  return "must have a y, the thickness of the ring, of at most " + shown(limit) + ", 0.49 of x and z";
}

std::string shaftLimit(const SceneObject& o) {
  constexpr double kWidest = 0.99;  // [x and z]
  const double limit = kWidest * std::min(o.size.x(), o.size.z());
  return shaftOf(o) <= limit ? "" : "must be at most " + shown(limit) + ", 0.99 of x and z of the size";
}

std::string plinthLimit(const SceneObject& o) {
  constexpr double kHighest = 0.49;  // [y]
  const double limit = kHighest * o.size.y();
  return plinthOf(o) <= limit ? "" : "must be at most " + shown(limit) + ", 0.49 of y of the size";
}

Key<SceneObject> segments() {
  Key<SceneObject> key = whole<SceneObject>("segments", &SceneObject::segments, kSegments, "",
                                            "flat strips around what is round");
  key.type += ", a multiple of 4";  // so that the solid is as wide as its size says, and a column has corners
  return std::move(key).only("cylinder, sphere, torus and column", isRound).must([](const SceneObject& o) {
    return o.segments % 4 == 0 ? std::string() : "must be a multiple of 4, " + kSegments.text();
  });
}

Opening readOpening(const Json& json, const Place& place) {
  requireList(json, place);
  if (json.size() != 4)
    place.refuse("has " + std::to_string(json.size()) + " numbers", "must have 4: [x, y, width, height]");
  const auto number = [&](std::size_t i, const Limits& limits) {
    return readNumber(json[i], limits, place.child(std::to_string(i)));
  };
  return {number(0, kCorner), number(1, kCorner), number(2, limits::kLength), number(3, limits::kLength)};
}

std::string shownOpenings(const SceneObject& o) {
  std::string text;
  for (const Opening& hole : o.openings)
    text += (text.empty() ? "[" : ", [") + shown(hole.left) + ", " + shown(hole.bottom) + ", " +
            shown(hole.width) + ", " + shown(hole.height) + "]";
  return "[" + text + "]";
}

Key<SceneObject> openings() {
  return Key<SceneObject>{"openings",
                          "list of at most " + std::to_string(kMostOpenings) + " [x, y, width, height]",
                          "m",
                          "rectangles through its thickness, from the lower left corner seen from +z; at an "
                          "edge they are doors",
                          [](SceneObject& target, const Json& json, const Place& place) {
                            requireList(json, place);
                            if (json.size() > kMostOpenings)
                              place.refuse("has " + std::to_string(json.size()) + " openings",
                                           "must have at most " + std::to_string(kMostOpenings));
                            for (std::size_t i = 0; i < json.size(); ++i)
                              target.openings.push_back(readOpening(json[i], place.child(std::to_string(i))));
                          },
                          shownOpenings}
      .only("slab", is(Shape::Slab))
      .must([](const SceneObject& o) { return wrongOpening(o.size, o.openings); }, {"size"});
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

// What it was cooked for is what the object is made of, until its own keys say otherwise. A file that does
// not load is refused when it is needed.
void takeMaterial(SceneObject& object, const Place& place) {
  Asset cooked;
  try {
    cooked = load(object.asset);
  } catch (const Error&) {
    return;
  }
  try {
    object.material = cooked.material();
  } catch (const Error& error) {
    place.refuse(std::string("was cooked for a ") + error.what(), "cook it again with another --material");
  }
}

Key<SceneObject> asset() {
  Key<SceneObject> key = file(
      "asset", &SceneObject::asset,
      "cooked by `rubble cook`; keeps its elements, its anchors and the material that it was cooked for");
  key.read = [read = key.read](SceneObject& target, const Json& json, const Place& place) {
    read(target, json, place);
    takeMaterial(target, place);
  };
  return std::move(key).only("objects without a mesh", [](const SceneObject& o) { return o.mesh.empty(); });
}

Key<SceneObject> shape() {
  return word<SceneObject, Shape>("shape", &SceneObject::shape,
                                  {{"box", Shape::Box},
                                   {"cylinder", Shape::Cylinder},
                                   {"sphere", Shape::Sphere},
                                   {"torus", Shape::Torus},
                                   {"column", Shape::Column},
                                   {"slab", Shape::Slab},
                                   {"statue", Shape::Statue},
                                   {"brick_course", Shape::BrickCourse}},
                                  "form of the solid; cylinder, torus and column stand along y")
      .only("shapes", isShape);
}

Key<SceneObject> scale() {
  Key<SceneObject> key =
      number<SceneObject>("scale", &SceneObject::scale, kMeshScale, "m", "length of one unit of the mesh");
  key.read = [read = key.read](SceneObject& target, const Json& json, const Place& place) {
    read(target, json, place);
    target.isScaleGiven = true;
  };
  return std::move(key).only("meshes", [](const SceneObject& o) { return !o.mesh.empty(); });
}

Key<SceneObject> anchor() {
  return Key<SceneObject>{
      "anchor",
      "[x, y, z], not zero",
      "",
      "the flat side that faces this way, in the world as the object stands in it, is tied to it",
      [](SceneObject& target, const Json& json, const Place& place) {
        target.anchor = readVector(json, limits::kPosition, place);
        if (target.anchor->norm() < 1e-9) place.refuse("has no direction", "must not be [0, 0, 0]");
      },
      [](const SceneObject& o) { return o.anchor ? shown(*o.anchor) : std::string("not tied"); }}
      .only("shapes and meshes", isCookedHere);
}

Eigen::AlignedBox3d readBox(const Json& json, const Place& place) {
  requireList(json, place);
  if (json.size() != 2)
    place.refuse("has " + std::to_string(json.size()) + " corners", "must have 2: [[x, y, z], [x, y, z]]");
  Eigen::AlignedBox3d box(readVector(json[0], kMeshPlace, place.child("0")));
  return box.extend(readVector(json[1], kMeshPlace, place.child("1")));
}

std::string shownBox(const Eigen::AlignedBox3d& box) {
  return "[" + shown(Eigen::Vector3d(box.min())) + ", " + shown(Eigen::Vector3d(box.max())) + "]";
}

// Not listed where there is none: references and settings of scenes without one stay those of the scenes.
Key<SceneObject> anchorBox() {
  Key<SceneObject> key = {
      "anchor_box",
      "[[x, y, z], [x, y, z]]",
      "m",
      "two corners of a box, in the mesh's own coordinates times `scale`, or the shape's about its centre: "
      "outer faces of cells whose centroid is in it are tied, too",
      [](SceneObject& target, const Json& json, const Place& place) {
        target.anchorBox = readBox(json, place);
      },
      [](const SceneObject& o) { return o.anchorBox ? shownBox(*o.anchorBox) : std::string("none"); }};
  key.listNested = [](std::vector<std::string>& lines, const SceneObject& target, const std::string& path) {
    if (target.anchorBox) lines.push_back(path + " = " + shownBox(*target.anchorBox));
  };
  return std::move(key).only("shapes and meshes", isCookedHere);
}

// Which bodies there are is known when the whole scene is read. Not listed where there is none, as
// anchor_box.
Key<SceneObject> anchorBody() {
  Key<SceneObject> key = {
      .name = "anchor_body",
      .type = "`impactors.N` or `statics.N`",
      .unit = "",
      .meaning =
          "what its anchors hold to in place of the world: they go with that body, and the object starts "
          "with its motion",
      .read =
          [](SceneObject& target, const Json& json, const Place& place) {
            if (!json.is_string() || json.get_ref<const std::string&>().empty())
              place.refuse("is " + shown(json), "must be impactors.N or statics.N");
            target.anchorBody = json.get<std::string>();
          },
      .standard = [](const SceneObject& o) { return o.anchorBody.empty() ? "none" : o.anchorBody; },
      .isChoice = true};
  key.listNested = [](std::vector<std::string>& lines, const SceneObject& target, const std::string& path) {
    if (!target.anchorBody.empty()) lines.push_back(path + " = " + target.anchorBody);
  };
  return std::move(key).must(
      [](const SceneObject& o) {
        const bool isTied = o.anchor || o.anchorBox || !isCookedHere(o);  // assets bring their own anchors
        return o.anchorBody.empty() || isTied ? std::string()
                                              : "must come with anchors: give anchor or anchor_box";
      },
      {"anchor", "anchor_box"});
}

// What anchors hold to a body starts with that body's motion.
Table<SceneObject> withOwnMotion(Table<SceneObject> table) {
  const std::size_t before = table.size();
  table = withMotion(std::move(table));
  for (std::size_t row = before; row < table.size(); ++row)
    table[row] = std::move(table[row]).only("objects without anchor_body", [](const SceneObject& o) {
      return o.anchorBody.empty();
    });
  return table;
}

}  // namespace

const Table<SceneObject>& objectKeys() {
  static const Table<SceneObject> table = withOwnMotion(withPlacement<SceneObject>(
      {
          file("mesh", &SceneObject::mesh, "closed surface to cook instead of a shape: OBJ, OFF, PLY or STL"),
          scale(),
          flag<SceneObject>("repair", &SceneObject::repair, "mends the mesh first, as `rubble cook --repair`")
              .only("meshes", [](const SceneObject& o) { return !o.mesh.empty(); }),
          asset(),
          vector<SceneObject>("mesh_origin", &SceneObject::meshOrigin, kMeshPlace, "m",
                              "what in the mesh's own coordinates stands at `position`")
              .only("meshes and assets", [](const SceneObject& o) { return !isShape(o); }),
          shape(),
          vector<SceneObject>(
              "size", &SceneObject::size, limits::kLength, "m",
              "full edge lengths of the box, or of the box around the shape; of one brick of a brick_course")
              .only("shapes", isShape)
              .required()
              .must(torusSize, {"shape"}),
          segments(),
          number<SceneObject>("shaft", &SceneObject::shaft, kPartOfColumn, "m",
                              "diameter of the shaft; 0 is 0.6 of the smaller of x and z")
              .only("column", is(Shape::Column))
              .must(shaftLimit, {"size"}),
          number<SceneObject>("plinth", &SceneObject::plinth, kPartOfColumn, "m",
                              "height of the square base, and of the capital; 0 is 0.1 of y")
              .only("column", is(Shape::Column))
              .must(plinthLimit, {"size"}),
          openings(),
          whole<SceneObject>("bricks", &SceneObject::bricks, kBricks, "",
                             "how many lie in a row along x; each is a part of its own")
              .only("brick_course", is(Shape::BrickCourse)),
          number<SceneObject>("joint", &SceneObject::joint, limits::kLength, "m",
                              "width of the gap between two bricks")
              .only("brick_course", is(Shape::BrickCourse)),
          number<SceneObject>(
              "offset", &SceneObject::offset, kOffset, "",
              "of the joints, in bricks with a joint; the ends stay where they are and are cut: 0.5 in "
              "every other row is running bond")
              .only("brick_course", is(Shape::BrickCourse))
              .must([](const SceneObject& o) { return wrongOffset(brickCourseOf(o)); }, {"size", "joint"}),
          whole<SceneObject>("elements", &SceneObject::elements, limits::kElements, "",
                             "how many elements it is cut into")
              .only("shapes and meshes", isCookedHere),
          number<SceneObject>("radius", &SceneObject::radius, limits::kElementRadius, "m",
                              "of the elements; 0 is chosen from `fill`")
              .only("shapes and meshes", isCookedHere)
              .must(
                  [](const SceneObject& o) {
                    return !isShape(o) || o.radius <= o.size.minCoeff() / 2
                               ? std::string()
                               : "must be at most " + thickest(o) + ", half the smallest edge of the box";
                  },
                  {"size", "shape"}),
          number<SceneObject>("fill", &SceneObject::fill, limits::kFill, "",
                              "share of the solid that the spheres fill when `radius` is 0")
              .only("shapes and meshes", isCookedHere),
          anchor(),
          anchorBox(),
          anchorBody(),
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
      "where its centre is at the start; of a mesh or an asset, its `mesh_origin`"));
  return table;
}

}  // namespace rubble::demo
